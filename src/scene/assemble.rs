//! Loose triangles to a mesh: what is missing is computed, equal corners are joined.

use std::collections::HashMap;

use glam::{DVec2, DVec3, Vec4};

use super::Mesh;

/// Faces that meet at a greater angle have an edge between them: cosine of 40 degrees.
const CREASE_COSINE: f64 = 0.766_044_443;
/// A position with more triangles than this is not smoothed: looking at every pair would take too long.
const MAX_FAN: usize = 256;

/// A corner of a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Index of its position.
    pub(super) position: usize,
    /// Texture coordinate, v down, if given.
    pub(super) texcoord: Option<DVec2>,
    /// Unit normal, if given.
    pub(super) normal: Option<DVec3>,
}

/// The mesh of triangles over positions with colours. Triangles without area are dropped.
pub(super) fn assemble(positions: &[(DVec3, Vec4)], triangles: &[[Corner; 3]]) -> Mesh {
    let faces: Vec<(&[Corner; 3], DVec3)> = triangles
        .iter()
        .filter_map(|t| {
            let [a, b, c] = t.map(|corner| positions[corner.position].0);
            // An f32 mesh cannot hold a sliver thinner than its own rounding.
            let (u, v) = (b - a, c - a);
            let normal = u.try_normalize()?.cross(v.try_normalize()?);
            (normal.length() > 1e-9).then(|| (t, normal.normalize()))
        })
        .collect();
    let smooth = SmoothNormals::new(positions, &faces);
    let mut mesh = Mesh::default();
    let mut known = HashMap::new();
    let mut gradients: Vec<(DVec3, DVec3)> = Vec::new();
    for (index, (corners, face)) in faces.iter().enumerate() {
        let points = corners.map(|c| positions[c.position].0);
        let texcoords: [DVec2; 3] =
            std::array::from_fn(|i| corners[i].texcoord.unwrap_or_else(|| project(points[i], *face)));
        let (along_u, along_v, mirrored) = gradient(points, texcoords);
        for i in 0..3 {
            let normal = corners[i].normal.unwrap_or_else(|| smooth.at(index, i)).as_vec3();
            let texcoord = texcoords[i].as_vec2();
            let bits = |x: f32| (x + 0.0).to_bits();
            let key = (corners[i].position, normal.to_array().map(bits), texcoord.to_array().map(bits), mirrored);
            let vertex = *known.entry(key).or_insert_with(|| {
                let (position, color) = positions[corners[i].position];
                mesh.positions.push(position.as_vec3());
                mesh.normals.push(normal);
                mesh.texcoords.push(texcoord);
                mesh.colors.push(color);
                gradients.push((DVec3::ZERO, DVec3::ZERO));
                mesh.positions.len() as u32 - 1
            });
            let sums = &mut gradients[vertex as usize];
            *sums = (sums.0 + along_u, sums.1 + along_v);
            mesh.indices.push(vertex);
        }
    }
    mesh.tangents = mesh.normals.iter().zip(gradients).map(|(n, (u, v))| tangent(n.as_dvec3(), u, v)).collect();
    mesh
}

/// Directions of growing u and v over a triangle, weighted by its area, and whether the texture is seen mirrored.
fn gradient(p: [DVec3; 3], t: [DVec2; 3]) -> (DVec3, DVec3, bool) {
    let (e, f) = (p[1] - p[0], p[2] - p[0]);
    let (s, r) = (t[1] - t[0], t[2] - t[0]);
    let determinant = s.x * r.y - r.x * s.y;
    let area = e.cross(f).length();
    let scaled = |v: DVec3| v.normalize_or_zero() * area * determinant.signum();
    if determinant == 0.0 {
        return (DVec3::ZERO, DVec3::ZERO, false);
    }
    // With v down, a texture that is not mirrored runs clockwise over a counter-clockwise triangle.
    (scaled(e * r.y - f * s.y), scaled(f * s.x - e * r.x), determinant > 0.0)
}

/// The part of `u` orthogonal to the normal; any direction that is, if there is none. w as [`Mesh::tangents`] says.
fn tangent(normal: DVec3, u: DVec3, v: DVec3) -> Vec4 {
    let flat = u - normal * normal.dot(u);
    // Compared with its own length: rounding leaves a remainder when u runs along the normal.
    let unit = if flat.length() > 1e-6 * u.length() { flat.try_normalize() } else { None };
    let tangent = unit.unwrap_or_else(|| normal.any_orthonormal_vector());
    let side = if normal.cross(tangent).dot(v) > 0.0 { 1.0 } else { -1.0 };
    tangent.as_vec3().extend(side)
}

/// The place in a picture laid flat along the axis that the face looks along most, one picture per metre, v down.
fn project(p: DVec3, face: DVec3) -> DVec2 {
    let n = face.abs();
    if n.y >= n.x && n.y >= n.z {
        DVec2::new(p.x, p.z * face.y.signum())
    } else if n.x >= n.z {
        DVec2::new(-p.z * face.x.signum(), -p.y)
    } else {
        DVec2::new(p.x * face.z.signum(), -p.y)
    }
}

/// Normals by averaging over the neighbours of a corner that do not bend away too far.
struct SmoothNormals<'a> {
    faces: &'a [(&'a [Corner; 3], DVec3)],
    /// Where the list of each position begins in `around`.
    starts: Vec<usize>,
    /// Faces and their angles at the position, grouped by position.
    around: Vec<(u32, f64)>,
}

impl<'a> SmoothNormals<'a> {
    fn new(positions: &[(DVec3, Vec4)], faces: &'a [(&'a [Corner; 3], DVec3)]) -> Self {
        let mut starts = vec![0; positions.len() + 1];
        for corner in faces.iter().flat_map(|f| f.0) {
            starts[corner.position + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut around = vec![(0, 0.0); faces.len() * 3];
        for (index, (corners, _)) in faces.iter().enumerate() {
            let p = corners.map(|c| positions[c.position].0);
            for i in 0..3 {
                let slot = &mut next[corners[i].position];
                around[*slot] = (index as u32, (p[(i + 1) % 3] - p[i]).angle_between(p[(i + 2) % 3] - p[i]));
                *slot += 1;
            }
        }
        Self { faces, starts, around }
    }

    fn at(&self, face: usize, corner: usize) -> DVec3 {
        let (corners, own) = self.faces[face];
        let position = corners[corner].position;
        let fan = &self.around[self.starts[position]..self.starts[position + 1]];
        if fan.len() > MAX_FAN {
            return own;
        }
        let near = fan.iter().map(|(f, angle)| (self.faces[*f as usize].1, angle));
        near.filter(|(n, _)| n.dot(own) > CREASE_COSINE).map(|(n, angle)| n * *angle).sum::<DVec3>().normalize_or(own)
    }
}
