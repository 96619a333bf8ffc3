//! Wavefront OBJ text to triangles.
//!
//! Read here and not by a crate, because every mistake is to be reported at its line; tests hold it against `tobj`.
//! `v` (with colour), `vt`, `vn` and `f` count; names, groups, materials, lines and points are passed over. Files give
//! v upwards; a mesh has it downwards.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec4};

use super::Mesh;
use super::assemble::{Corner, assemble};
use crate::diagnostic::{Diagnostic, Place, SourceText, Span};

/// Most positions, texture coordinates, normals, or triangles of a file.
pub const MAX_OBJ_ELEMENTS: usize = 4_000_000;
/// Most corners of a polygon.
const MAX_CORNERS: usize = 1024;
/// Most mistakes that one file is told of.
const MAX_ERRORS: usize = 20;

struct Reader<'a> {
    source: &'a Arc<SourceText>,
    positions: Vec<(DVec3, Vec4)>,
    texcoords: Vec<DVec2>,
    normals: Vec<DVec3>,
    corners: Vec<[Corner; 3]>,
    errors: Vec<Diagnostic>,
}

/// The mesh of an OBJ text.
///
/// Polygons are taken to be convex. Where normals are missing, faces that meet at less than 40 degrees are smooth
/// (weighted by their angle at the corner). Where texture coordinates are missing, they are the object-space metres
/// seen along the axis that the face looks along most. Tangents follow the gradient of u (Lengyel 2001), summed over
/// the triangles of a vertex and made orthogonal to its normal; mirrored parts do not share vertices.
///
/// # Errors
/// What is wrong with the text, at most 20 mistakes, each at its line.
pub fn from_obj(source: &Arc<SourceText>) -> Result<Mesh, Vec<Diagnostic>> {
    let mut reader = Reader {
        source,
        positions: Vec::new(),
        texcoords: Vec::new(),
        normals: Vec::new(),
        corners: Vec::new(),
        errors: Vec::new(),
    };
    let mut start = 0;
    for line in source.text.split('\n') {
        reader.line(start, line);
        start += line.len() + 1;
        if reader.errors.len() >= MAX_ERRORS {
            return Err(reader.errors);
        }
    }
    if !reader.errors.is_empty() {
        return Err(reader.errors);
    }
    let mesh = assemble(&reader.positions, &reader.corners);
    if mesh.indices.is_empty() {
        let place = Place::file(source.name.clone());
        return Err(vec![
            Diagnostic::error("ST0424", "the OBJ file has no face with an area", place)
                .help("export the model with its faces (lines that begin with `f`)"),
        ]);
    }
    Ok(mesh)
}

impl Reader<'_> {
    fn line(&mut self, start: usize, line: &str) {
        let content = line.split('#').next().unwrap_or_default();
        let mut words = content.split_whitespace();
        let keyword = words.next().unwrap_or_default();
        let outcome = match keyword {
            "v" => self.position(words),
            "vt" => numbers::<2>(words, 1).map(|n| self.texcoords.push(DVec2::new(n[0], 1.0 - n[1]))),
            "vn" => numbers::<3>(words, 3).map(|n| self.normals.push(DVec3::from_array(n))),
            "f" => self.face(words),
            _ => return,
        };
        let full = [self.positions.len(), self.texcoords.len(), self.normals.len(), self.corners.len()];
        let outcome = outcome.and_then(|()| {
            if full.iter().any(|n| *n > MAX_OBJ_ELEMENTS) {
                return Err(("ST0423", format!("the OBJ file has more than {MAX_OBJ_ELEMENTS} elements of a kind")));
            }
            Ok(())
        });
        if let Err((code, message)) = outcome {
            let lead = line.len() - line.trim_start().len();
            let span = Span::new(self.source, start + lead..start + line.trim_end().len().max(lead));
            let help = match code {
                "ST0420" => "a position is `v X Y Z`, a texture coordinate `vt U V`, a normal `vn X Y Z`",
                "ST0421" => "a corner is `V`, `V/VT`, `V//VN` or `V/VT/VN`; counting begins at 1, or at -1 backwards",
                "ST0422" => "a face is `f` with 3 to 1024 corners",
                _ => "export the model with fewer triangles, or in parts",
            };
            self.errors.push(Diagnostic::error(code, message, Place::span(span)).help(help));
            if code == "ST0423" {
                self.positions.clear();
                self.texcoords.clear();
                self.normals.clear();
                self.corners.clear();
            }
        }
    }

    /// `v x y z`, `v x y z w`, or `v x y z r g b`.
    fn position<'t>(&mut self, words: impl Iterator<Item = &'t str>) -> Result<(), (&'static str, String)> {
        let words: Vec<&str> = words.take(8).collect();
        let n = numbers::<7>(words.iter().copied(), 3)?;
        let color = if words.len() >= 6 { [n[3], n[4], n[5]] } else { [1.0; 3] };
        self.positions.push((DVec3::new(n[0], n[1], n[2]), DVec3::from_array(color).as_vec3().extend(1.0)));
        Ok(())
    }

    /// `f p p p ...` where p is `v`, `v/vt`, `v//vn` or `v/vt/vn`; indices begin at 1 or count back from -1.
    fn face<'t>(&mut self, words: impl Iterator<Item = &'t str>) -> Result<(), (&'static str, String)> {
        let mut polygon = Vec::new();
        for word in words {
            if polygon.len() == MAX_CORNERS {
                return Err(("ST0422", format!("a face has more than {MAX_CORNERS} corners")));
            }
            let mut parts = word.split('/');
            let mut index = |count: usize, what: &str| match parts.next() {
                None | Some("") => Ok(None),
                Some(text) => resolve(text, count, what).map(Some),
            };
            let position = index(self.positions.len(), "positions (`v`)")?;
            let texcoord = index(self.texcoords.len(), "texture coordinates (`vt`)")?;
            let normal = index(self.normals.len(), "normals (`vn`)")?;
            let Some(position) = position else {
                return Err(("ST0421", format!("the corner `{word}` names no position")));
            };
            polygon.push(Corner {
                position,
                texcoord: texcoord.map(|i| self.texcoords[i]),
                normal: normal.and_then(|i| self.normals[i].try_normalize()),
            });
        }
        if polygon.len() < 3 {
            return Err(("ST0422", format!("a face needs at least 3 corners, this one has {}", polygon.len())));
        }
        for pair in polygon[1..].windows(2) {
            self.corners.push([polygon[0], pair[0], pair[1]]);
        }
        Ok(())
    }
}

/// Finite numbers, at least `needed`; missing ones are 0.
fn numbers<'t, const N: usize>(
    words: impl Iterator<Item = &'t str>,
    needed: usize,
) -> Result<[f64; N], (&'static str, String)> {
    let mut result = [0.0; N];
    let mut count = 0;
    for (slot, word) in result.iter_mut().zip(words) {
        match word.parse::<f32>() {
            Ok(x) if x.is_finite() => *slot = x.into(),
            _ => return Err(("ST0420", format!("`{word}` is not a finite number"))),
        }
        count += 1;
    }
    if count < needed {
        return Err(("ST0420", format!("expected at least {needed} numbers, found {count}")));
    }
    Ok(result)
}

/// An index of the file to one from 0.
fn resolve(text: &str, count: usize, what: &str) -> Result<usize, (&'static str, String)> {
    let number: i64 = text.parse().map_err(|_| ("ST0421", format!("`{text}` is not an index")))?;
    let index = if number < 0 { count as i64 + number } else { number - 1 };
    match usize::try_from(index) {
        Ok(index) if index < count => Ok(index),
        _ => Err(("ST0421", format!("the index {number} is out of range: {count} {what} come before this line"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn read(text: &str) -> Result<Mesh, Vec<Diagnostic>> {
        from_obj(&SourceText::new("a.obj", text))
    }

    const CUBE: &str = "
o cube
v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf -5 -1 -2 -6 # the top, from the end\nf 2 3 7 6\nf 1 5 8 4
";

    #[test]
    fn a_cube_without_normals_gets_flat_faces_and_square_texels() {
        let mesh = read(CUBE).unwrap();
        crate::scene::checks::check(&mesh);
        assert!((crate::scene::checks::volume(&mesh) - 8.0).abs() < 1e-6);
        assert_eq!((mesh.positions.len(), mesh.indices.len()), (24, 36));
        assert!(mesh.normals.iter().all(|n| n.abs().max_element() > 0.999_99));
    }

    #[test]
    fn a_ball_without_normals_is_smooth() {
        let ball = crate::scene::primitive::sphere(1.0, 32);
        let mut text = String::new();
        for p in &ball.positions {
            text += &format!("v {} {} {}\n", p.x, p.y, p.z);
        }
        // Weld the seam by position, as an exporter would.
        let first =
            |i: u32| ball.positions.iter().position(|p| p.distance(ball.positions[i as usize]) < 1e-6).unwrap() + 1;
        for t in ball.indices.chunks(3) {
            text += &format!("f {} {} {}\n", first(t[0]), first(t[1]), first(t[2]));
        }
        let mesh = read(&text).unwrap();
        crate::scene::checks::check(&mesh);
        for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
            assert!(n.dot(p.normalize()) > 0.999, "{p} {n}");
        }
    }

    #[test]
    fn agrees_with_tobj() {
        let text = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0.5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nvn 0 1 1\n\
                    f 1/1/1 2/2/1 3/3/1 4/4/2\nf 1/1/2 3/3/1 2/2/1\n";
        let ours = read(text).unwrap();
        let options = tobj::LoadOptions { single_index: true, triangulate: true, ..Default::default() };
        let (models, _) =
            tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| Err(tobj::LoadError::GenericFailure)).unwrap();
        let theirs = &models[0].mesh;
        assert_eq!(ours.indices.len(), theirs.indices.len());
        for (&a, &b) in ours.indices.iter().zip(&theirs.indices) {
            let (a, b) = (a as usize, b as usize);
            assert_eq!(ours.positions[a].to_array(), theirs.positions[3 * b..3 * b + 3]);
            assert!((ours.normals[a] - Vec3::from_slice(&theirs.normals[3 * b..]).normalize()).length() < 1e-6);
            let uv = &theirs.texcoords[2 * b..];
            assert_eq!(ours.texcoords[a].to_array(), [uv[0], 1.0 - uv[1]]);
        }
    }

    #[test]
    fn mirrored_parts_have_tangents_of_their_own() {
        let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv -1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                    f 1/1 2/2 3/3\nf 1/1 5/4 4/2\n";
        let mesh = read(text).unwrap();
        assert_eq!(mesh.tangents[0], Vec4::new(1.0, 0.0, 0.0, -1.0));
        assert_eq!(mesh.tangents[3], Vec4::new(-1.0, 0.0, 0.0, 1.0));
    }

    #[test]
    fn every_mistake_is_reported_at_its_line() {
        let text = "v 0 0 0\nv 1 nan 0\nv 1 0\nvt\nf 1 2\nf 1 2 9\nf 0 1 1\nf 1//1 1 1\n  f a b c\n";
        let errors = read(text).unwrap_err();
        let found: Vec<_> = errors.iter().map(|e| (e.code, e.place.span.as_ref().unwrap().line_column())).collect();
        let expected = [
            ("ST0420", (2, 1)),
            ("ST0420", (3, 1)),
            ("ST0420", (4, 1)),
            ("ST0421", (5, 1)),
            ("ST0421", (6, 1)),
            ("ST0421", (7, 1)),
            ("ST0421", (8, 1)),
            ("ST0421", (9, 3)),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn hostile_texts_do_not_panic() {
        let big = "v 3e38 -3e38 3e38\nv -3e38 3e38 1e-45\nv 0 0 3e38\nf 1 2 3\n";
        assert!(read(big).unwrap().normals.iter().all(|n| n.is_normalized()));
        for text in [
            "",
            "f",
            "f /// // /",
            "v",
            "\u{feff}v 1",
            "f 9223372036854775807 -9223372036854775808 1",
            "v 0 0 0\nf 1 1 1",
        ] {
            assert!(read(text).is_err(), "{text:?}");
        }
        let many = format!("v 0 0 0\nf {}", "1 ".repeat(5000));
        assert_eq!(read(&many).unwrap_err()[0].code, "ST0422");
        assert_eq!(read(&"f x\n".repeat(1000)).unwrap_err().len(), 20);
    }
}
