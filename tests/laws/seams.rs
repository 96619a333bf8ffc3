//! A shadow that runs over the edge between two faces of a point light's cube.

use glam::{DMat4, DVec3};
use shadetree::reference::{Layer, Layers, Taps, Weights, kernel};

use super::lamp::CLOSED_FORM;
use super::percentage::texel_of;
use crate::stage::{Item, Stage, View, gpu, light, visibility};

/// From a light at (0, 2, 0), the ground passes from the face that looks down to the one along +x at x = 2.
const SEAM: f64 = 2.0;
/// Texels of a face, and metres per texel across the shadow's edge, at the seam on the ground, in both faces: a face is
/// wider than a right angle by 1/16.
const SIDE: f64 = 512.0;
const TEXEL: f64 = 2.0 * 2.0 * 1.0625 / SIDE;
/// The plate above the ground ends at this z; its shadow, at twice that.
const EDGE: f64 = 0.1;
const HEIGHT: f64 = 1.0;

fn stage() -> Stage {
    let plate = DMat4::from_translation(DVec3::new(2.0, HEIGHT, EDGE - 3.0));
    let view = View::down((SEAM, 2.0 * EDGE), 0.5, 0.36, (240, 120));
    Stage::new(vec![Item::plane([16.0, 16.0], DMat4::IDENTITY), Item::plane([12.0, 6.0], plate)], view)
}

const POINT: &str = "\"position\": (0, 2, 0), \"near\": 0.3, \"range\": 8, \"radius\": 0.1";

/// A light at the same place that looks straight at the seam, with texels of the same size there:
/// 2 sqrt(2) metres away, 2 sqrt(2) tan(angle) 2 / 512 = TEXEL.
fn spot() -> String {
    let angle = (1.0625 / 2.0_f64.sqrt()).atan().to_degrees();
    format!(
        "\"position\": (0, 2, 0), \"direction\": (1, -1, 0), \"outer_angle\": {angle}, \"near\": 0.3, \"range\": 8, \"radius\": 0.1"
    )
}

/// Filtered comparison is, on both sides of the seam, the exhaustive filter in float64 of the face that sees the point.
#[test]
fn both_faces_at_a_seam_filter_as_in_float64() {
    let Some(mut gpu) = gpu() else { return };
    let stage = stage();
    for (name, weights, width) in [("gaussian", Weights::Gaussian, 5), ("box", Weights::Box, 9)] {
        let options = format!("\"size\": \"512\", \"width\": \"{width}\", \"weights\": \"{name}\"");
        let shader = visibility(&light("point_light", POINT, "pcf_shadow", "", &options));
        let map = gpu.map(&stage.job(&shader), "light/lamp", 0).expect("renders");
        let values = stage.look(&mut gpu, &shader);
        let kernel = kernel(weights, width);
        let face = |axis: DVec3| {
            let space = *map
                .spaces
                .iter()
                .find(|s| s.world_to_light.row(2).truncate().as_dvec3().dot(axis) > 0.99)
                .expect("a face");
            // The plate's edge is a line on the map, lit on the side of the shadow's far end.
            let at = |x: f64, z: f64| texel_of(&space, SIDE, DVec3::new(x, HEIGHT, z));
            let ((ax, ay), (bx, by), (ox, oy)) = (at(0.9, EDGE), at(1.1, EDGE), at(1.0, EDGE - 0.5));
            let (nx, ny) = (by - ay, ax - bx);
            let size = (nx * nx + ny * ny).sqrt() * if nx * (ox - ax) + ny * (oy - ay) > 0.0 { -1.0 } else { 1.0 };
            let side = [nx / size, ny / size, (nx * ax + ny * ay) / size];
            (space, Layers { receiver: 0.8, layers: vec![Layer { depth: 0.3, sides: vec![side] }] })
        };
        let faces = [face(DVec3::NEG_Y), face(DVec3::X)];
        let mut judged = [0, 0];
        for (point, lit) in stage.on_ground(&values) {
            if (point.x - SEAM).abs() < 1e-4 {
                continue;
            }
            let side = usize::from(point.x > SEAM);
            let (space, truth) = &faces[side];
            let at = texel_of(space, SIDE, point);
            if truth.margin(at.0, at.1, width as i64 / 2 + 1) > 0.01 {
                let expected = truth.lit(&kernel, Taps::Bilinear, at);
                assert!((lit - expected).abs() < CLOSED_FORM, "{name} {width} at {point}: {lit} is not {expected}");
                judged[side] += 1;
            }
        }
        assert!(judged.iter().all(|n| *n > 3000), "{judged:?}");
    }
}

/// Mean visibility by row, of the columns with x between the ends.
fn rows(stage: &Stage, values: &[f64], from: f64, to: f64) -> Vec<f64> {
    let width = stage.view.size.0 as usize;
    let points: Vec<_> = stage.on_ground(values).collect();
    points
        .chunks(width)
        .map(|row| {
            let within: Vec<f64> = row.iter().filter(|(p, _)| p.x > from && p.x < to).map(|(_, v)| *v).collect();
            within.iter().sum::<f64>() / within.len() as f64
        })
        .collect()
}

/// Every method: right before and right behind the seam the edge looks the same, and as under the light that looks at the
/// seam. Steps of texels move an edge by up to half a texel on each side, which is one together, over which a shadow
/// changes by at most its steepest slope; within 5 cm of the seam, texels grow by a fortieth, which moves the rim of the
/// kernel by an eighth of a texel at most.
#[test]
fn no_shadow_jumps_at_a_seam() {
    let Some(mut gpu) = gpu() else { return };
    let stage = stage();
    let plain = "\"mips\": \"off\", \"filter\": \"linear\", \"anisotropy\": \"1\"";
    // The slope is per texel: the largest weight of a kernel, or 2 / pi per half width of a penumbra or disc.
    let gaussian = kernel(Weights::Gaussian, 5)[2];
    let penumbra = 2.0 / std::f64::consts::PI * TEXEL / 0.1;
    for (kind, params, options, slope) in [
        ("pcf_shadow", "", "\"width\": \"5\"".to_owned(), gaussian),
        ("pcf_shadow", "", "\"width\": \"9\", \"weights\": \"box\", \"taps\": \"hardware\"".to_owned(), 1.0 / 9.0),
        ("disc_shadow", "\"radius\": 6", "\"count\": \"64\"".to_owned(), 2.0 / std::f64::consts::PI / 6.0),
        ("adaptive_pcf_shadow", "\"width\": 5", String::new(), 1.0 / 5.0),
        ("pcss_shadow", "", "\"filter\": \"64\", \"search\": \"32\"".to_owned(), penumbra),
        ("variance_shadow", "\"bleeding_reduction\": 0", format!("\"width\": \"5\", {plain}"), gaussian),
    ] {
        let options = format!("\"size\": \"512\", {options}");
        let mut look = |kind_of_light: &str, lamp: &str| {
            stage.look(&mut gpu, &visibility(&light(kind_of_light, lamp, kind, params, &options)))
        };
        let (bulb, spot) = (look("point_light", POINT), look("spot_light", &spot()));
        let before = rows(&stage, &bulb, SEAM - 0.05, SEAM);
        let behind = rows(&stage, &bulb, SEAM, SEAM + 0.05);
        let straight = rows(&stage, &spot, SEAM - 0.05, SEAM + 0.05);
        // Noise of a mean over some 33 columns: half a sample of 64.
        let bound = 1.125 * slope + 1.0 / 128.0;
        for (what, a, b) in
            [("the other face", &before, &behind), ("a spot", &before, &straight), ("a spot", &behind, &straight)]
        {
            let off = super::planar::worst(a.iter().copied().zip(b.iter().copied()));
            assert!(off < bound, "{kind} {options} against {what}: {off}, bound {bound}");
        }
        assert!(before.iter().any(|v| *v > 0.9) && before.iter().any(|v| *v < 0.1), "{kind}: {before:?}");
    }
}
