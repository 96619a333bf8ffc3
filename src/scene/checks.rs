//! What must hold of every mesh.

use glam::DVec3;

use super::Mesh;
use super::primitive;

/// Lists of equal length, indices in range, unit normals that agree with the winding, orthonormal tangents along +u.
pub(super) fn check(mesh: &Mesh) {
    let n = mesh.positions.len();
    assert_eq!([mesh.normals.len(), mesh.texcoords.len(), mesh.tangents.len(), mesh.colors.len()], [n; 4]);
    assert!(mesh.indices.len().is_multiple_of(3) && mesh.indices.iter().all(|i| (*i as usize) < n));
    for (normal, tangent) in mesh.normals.iter().zip(&mesh.tangents) {
        assert!((normal.length() - 1.0).abs() < 1e-5, "{normal}");
        assert!((tangent.truncate().length() - 1.0).abs() < 1e-5, "{tangent}");
        assert!(normal.dot(tangent.truncate()).abs() < 1e-5 && tangent.w.abs() == 1.0, "{normal} {tangent}");
    }
    for triangle in mesh.indices.chunks(3) {
        let [a, b, c] = [0, 1, 2].map(|i| triangle[i] as usize);
        let [p, q, r] = [a, b, c].map(|i| mesh.positions[i].as_dvec3());
        let face = (q - p).cross(r - p).normalize();
        for i in [a, b, c] {
            assert!(face.dot(mesh.normals[i].as_dvec3()) > 0.5, "winding at {}", mesh.positions[i]);
        }
        // u grows along the tangent and v along the bitangent.
        let mid = |x: f32, y: f32, z: f32| f64::from(x + y + z) / 3.0;
        let (s, t) = (mesh.texcoords[b] - mesh.texcoords[a], mesh.texcoords[c] - mesh.texcoords[a]);
        let det = f64::from(s.x * t.y - t.x * s.y);
        let along_u = ((q - p) * f64::from(t.y) - (r - p) * f64::from(s.y)) / det;
        let along_v = ((r - p) * f64::from(s.x) - (q - p) * f64::from(t.x)) / det;
        let tangent = mesh.tangents[a] + mesh.tangents[b] + mesh.tangents[c];
        let normal = mesh.normals[a] + mesh.normals[b] + mesh.normals[c];
        let bitangent = normal.cross(tangent.truncate()).as_dvec3()
            * mid(mesh.tangents[a].w, mesh.tangents[b].w, mesh.tangents[c].w);
        assert!(along_u.dot(tangent.truncate().as_dvec3()) > 0.0, "tangent at {p}");
        assert!(along_v.dot(bitangent) > 0.0, "bitangent at {p}");
    }
}

/// Signed volume that the triangles enclose, m^3 (divergence theorem).
pub(super) fn volume(mesh: &Mesh) -> f64 {
    let at = |i: u32| mesh.positions[i as usize].as_dvec3();
    mesh.indices.chunks(3).map(|t| at(t[0]).dot(at(t[1]).cross(at(t[2]))) / 6.0).sum()
}

/// Whether every edge, by position, is used once in each direction.
fn closed(mesh: &Mesh) -> bool {
    let key = |i: u32| mesh.positions[i as usize].to_array().map(|x| (x * 65536.0).round() as i64);
    let mut edges = std::collections::BTreeMap::new();
    for t in mesh.indices.chunks(3) {
        for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            *edges.entry((key(a), key(b))).or_insert(0) += 1;
            *edges.entry((key(b), key(a))).or_insert(0) -= 1;
        }
    }
    edges.values().all(|n| *n == 0)
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() < tolerance, "{a} is not {b}");
}

#[test]
fn a_plane_faces_up_and_has_its_area() {
    let mesh = primitive::plane([3.0, 2.0], [4, 5]);
    check(&mesh);
    assert_eq!(mesh.indices.len(), 3 * 2 * 20);
    assert!(mesh.normals.iter().all(|n| n.y == 1.0));
    let area: f64 = mesh
        .indices
        .chunks(3)
        .map(|t| {
            let [a, b, c] = [0, 1, 2].map(|i| mesh.positions[t[i] as usize].as_dvec3());
            (b - a).cross(c - a).y / 2.0
        })
        .sum();
    close(area, 6.0, 1e-6);
}

#[test]
fn boxes_are_closed_and_have_their_volume() {
    let sharp = primitive::cuboid([1.0, 2.0, 3.0], 0.0);
    check(&sharp);
    assert!(closed(&sharp));
    close(volume(&sharp), 6.0, 1e-6);
    let (size, r) = (DVec3::new(1.0, 2.0, 3.0), 0.2);
    let round = primitive::cuboid(size.to_array(), r);
    check(&round);
    assert!(closed(&round));
    // Steiner's formula: core, six slabs, twelve quarter cylinders, eight eighths of a ball.
    let core = size - 2.0 * r;
    let slabs = 2.0 * r * (core.x * core.y + core.y * core.z + core.z * core.x);
    let pi = std::f64::consts::PI;
    let exact = core.x * core.y * core.z + slabs + pi * r * r * core.element_sum() + 4.0 / 3.0 * pi * r.powi(3);
    close(volume(&round), exact, 0.01);
    let ball = primitive::cuboid([2.0; 3], 1.0);
    close(volume(&ball), 4.0 / 3.0 * pi, 0.08);
}

#[test]
fn round_shapes_are_closed_and_have_the_volume_of_their_polyhedra() {
    let pi = std::f64::consts::PI;
    let sphere = primitive::sphere(2.0, 64);
    check(&sphere);
    assert!(closed(&sphere));
    let exact = 4.0 / 3.0 * pi * 8.0;
    assert!(volume(&sphere) < exact && volume(&sphere) > 0.994 * exact);
    for n in [3, 4, 48] {
        let cylinder = primitive::cylinder(0.5, 3.0, true, n);
        assert!(closed(&cylinder));
        let n = f64::from(n);
        close(volume(&cylinder), n / 2.0 * (2.0 * pi / n).sin() * 0.25 * 3.0, 1e-5);
    }
    check(&primitive::cylinder(0.5, 3.0, true, 48));
    let torus = primitive::torus(2.0, 0.5, 64);
    check(&torus);
    assert!(closed(&torus));
    let exact = 2.0 * pi * pi * 2.0 * 0.25;
    assert!(volume(&torus) < exact && volume(&torus) > 0.985 * exact, "{} {exact}", volume(&torus));
}

#[test]
fn an_open_cylinder_is_open() {
    let tube = primitive::cylinder(1.0, 1.0, false, 16);
    check(&tube);
    assert!(!closed(&tube));
}
