//! Triangles of the primitive shapes.
//!
//! Every one is built of patches: a grid over (u, v) with v down, seen from outside, so winding and the bitangent's
//! sign are the same everywhere.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use glam::{DVec2, DVec3, Vec4};

use super::Mesh;

/// Quads on each half of a rounded edge.
const BEVEL_STEPS: u32 = 4;

/// A point of a patch.
struct Point {
    position: DVec3,
    normal: DVec3,
    tangent: DVec3,
    texcoord: DVec2,
}

impl Mesh {
    fn add(&mut self, point: &Point) -> u32 {
        let index = self.positions.len() as u32;
        self.positions.push(point.position.as_vec3());
        self.normals.push(point.normal.as_vec3());
        self.texcoords.push(point.texcoord.as_vec2());
        // With v down, normal x tangent points against +v.
        self.tangents.push(point.tangent.as_vec3().extend(-1.0));
        self.colors.push(Vec4::ONE);
        index
    }

    /// Adds a grid of `columns` by `rows` quads; `at` is asked with whole column and row numbers.
    fn patch(&mut self, columns: u32, rows: u32, at: impl Fn(u32, u32) -> Point) {
        let first = self.positions.len() as u32;
        for row in 0..=rows {
            for column in 0..=columns {
                self.add(&at(column, row));
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let a = first + row * (columns + 1) + column;
                let (b, c) = (a + 1, a + columns + 1);
                self.triangle(a, c, b);
                self.triangle(b, c, c + 1);
            }
        }
    }

    /// Adds a triangle, unless it has collapsed to a line as at the poles of a ball.
    fn triangle(&mut self, a: u32, b: u32, c: u32) {
        let [p, q, r] = [a, b, c].map(|i| self.positions[i as usize]);
        if p != q && q != r && r != p {
            self.indices.extend([a, b, c]);
        }
    }
}

/// See [`super::Shape::Plane`].
pub(super) fn plane(size: [f64; 2], segments: [u32; 2]) -> Mesh {
    let mut mesh = Mesh::default();
    mesh.patch(segments[0], segments[1], |column, row| {
        let texcoord = DVec2::new(ratio(column, segments[0]), ratio(row, segments[1]));
        Point {
            position: DVec3::new((texcoord.x - 0.5) * size[0], 0.0, (texcoord.y - 0.5) * size[1]),
            normal: DVec3::Y,
            tangent: DVec3::X,
            texcoord,
        }
    });
    mesh
}

/// See [`super::Shape::Box`].
///
/// A point of a rounded box is the nearest point of the box shrunk by the radius, moved out by the radius. Within the
/// rim of a face, grid lines are placed at equal angles of the quarter circle, of which each face holds one half.
pub(super) fn cuboid(size: [f64; 3], bevel: f64) -> Mesh {
    let half = DVec3::from_array(size) * 0.5;
    let bevel = bevel.clamp(0.0, half.min_element());
    let core = half - DVec3::splat(bevel);
    let mut mesh = Mesh::default();
    // Normal and +u of each face; +v is tangent x normal.
    let faces = [
        (DVec3::X, DVec3::NEG_Z),
        (DVec3::NEG_X, DVec3::Z),
        (DVec3::Y, DVec3::X),
        (DVec3::NEG_Y, DVec3::X),
        (DVec3::Z, DVec3::X),
        (DVec3::NEG_Z, DVec3::NEG_X),
    ];
    for (normal, tangent) in faces {
        let down = tangent.cross(normal);
        let (half_u, half_v) = ((half * tangent).length(), (half * down).length());
        let (lines_u, lines_v) = (rim_lines(half_u, bevel), rim_lines(half_v, bevel));
        mesh.patch(lines_u.len() as u32 - 1, lines_v.len() as u32 - 1, |column, row| {
            let (u, v) = (lines_u[column as usize], lines_v[row as usize]);
            let outer = normal * half + tangent * u + down * v;
            let inner = outer.clamp(-core, core);
            let out = if bevel > 0.0 { (outer - inner).normalize() } else { normal };
            Point {
                position: if bevel > 0.0 { inner + out * bevel } else { outer },
                normal: out,
                tangent: (tangent - out * out.dot(tangent)).normalize(),
                texcoord: DVec2::new(u / half_u + 1.0, v / half_v + 1.0) * 0.5,
            }
        });
    }
    mesh
}

/// Where the grid lines of a face lie along one axis, from -half to half.
fn rim_lines(half: f64, bevel: f64) -> Vec<f64> {
    if bevel <= 0.0 {
        return vec![-half, half];
    }
    let core = half - bevel;
    let offsets = (0..=BEVEL_STEPS).map(|i| bevel * (FRAC_PI_4 * ratio(i, BEVEL_STEPS)).tan());
    let right: Vec<f64> = offsets.map(|x| core + x).collect();
    right.iter().rev().map(|x| -x).chain(right.iter().copied()).collect()
}

/// See [`super::Shape::Sphere`].
pub(super) fn sphere(radius: f64, segments: u32) -> Mesh {
    let rows = (segments / 2).max(2);
    let mut mesh = Mesh::default();
    mesh.patch(segments, rows, |column, row| {
        let (u, v) = (ratio(column, segments), ratio(row, rows));
        let (around, tangent) = around_y(column, segments);
        let latitude = FRAC_PI_2 - PI * v;
        // Exactly zero at the poles, so that their points coincide.
        let across = if row == 0 || row == rows { 0.0 } else { latitude.cos() };
        let normal = (around * across).with_y(latitude.sin());
        Point { position: normal * radius, normal, tangent, texcoord: DVec2::new(u, v) }
    });
    mesh
}

/// See [`super::Shape::Cylinder`].
pub(super) fn cylinder(radius: f64, height: f64, capped: bool, segments: u32) -> Mesh {
    let mut mesh = Mesh::default();
    mesh.patch(segments, 1, |column, row| {
        let (normal, tangent) = around_y(column, segments);
        Point {
            position: normal * radius + DVec3::Y * height * (0.5 - f64::from(row)),
            normal,
            tangent,
            texcoord: DVec2::new(ratio(column, segments), f64::from(row)),
        }
    });
    if capped {
        for side in [1.0, -1.0] {
            let cap = |at: DVec3| Point {
                position: at * radius + DVec3::Y * height * 0.5 * side,
                normal: DVec3::Y * side,
                tangent: DVec3::X,
                texcoord: DVec2::new(0.5 + 0.5 * at.x, 0.5 + 0.5 * at.z * side),
            };
            let center = mesh.add(&cap(DVec3::ZERO));
            for column in 0..segments {
                mesh.add(&cap(around_y(column, segments).0));
            }
            for column in 0..segments {
                let (a, b) = (center + 1 + column, center + 1 + (column + 1) % segments);
                if side > 0.0 { mesh.triangle(center, a, b) } else { mesh.triangle(center, b, a) }
            }
        }
    }
    mesh
}

/// See [`super::Shape::Torus`].
pub(super) fn torus(major: f64, minor: f64, segments: u32) -> Mesh {
    let sides = (segments / 2).max(3);
    let mut mesh = Mesh::default();
    mesh.patch(segments, sides, |column, row| {
        let (around, tangent) = around_y(column, segments);
        let v = ratio(row, sides);
        // v runs over the top: from the inside (0) by the top and the outside (1/2) to the bottom.
        let (sin, cos) = (PI - TAU * ratio(row % sides, sides)).sin_cos();
        let normal = around * cos + DVec3::Y * sin;
        Point {
            position: around * major + normal * minor,
            normal,
            tangent,
            texcoord: DVec2::new(ratio(column, segments), v),
        }
    });
    mesh
}

/// Unit vector away from the y axis, and the unit tangent of growing u. u = 0.5 is at +z; the seam is at -z.
fn around_y(column: u32, segments: u32) -> (DVec3, DVec3) {
    // The last column is the first one again, to the bit.
    let (sin, cos) = (TAU * ratio(column % segments, segments) - PI).sin_cos();
    (DVec3::new(sin, 0.0, cos), DVec3::new(cos, 0.0, -sin))
}

fn ratio(part: u32, whole: u32) -> f64 {
    f64::from(part) / f64::from(whole)
}
