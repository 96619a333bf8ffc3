//! Methods in 16 bits, and blurs as wide in metres in every view of a light.

use glam::{DMat4, DVec3};
use shadetree::compile::Compiled;
use shadetree::reference::{Weights, edge_visibility, kernel};
use shadetree::render::Gpu;

use super::lamp::{Lamp, PLAIN, Plate, SIDE, STEP, under};
use crate::stage::{Item, Stage, View, gpu, skipped, visibility};

/// Whether an adapter makes and filters a format; says so if not.
fn able(gpu: &Gpu, format: &str) -> bool {
    let found = gpu.adapter().formats.iter().find(|(name, _)| name == format);
    let able = found.is_some_and(|(_, able)| able.renderable && able.filterable);
    if !able {
        skipped(&format!("{} cannot render and filter {format}", gpu.adapter()));
    }
    able
}

/// Pixels under the edge of a plate 1 m up with their truth.
fn edge(gpu: &mut Gpu, lamp: Lamp, shader: &Compiled) -> Vec<(f64, f64)> {
    let stage = under(lamp, &[Plate { height: 1.0, edge: 4.0, angle: 0.0 }], 16.0, (160, 2));
    let kernel = kernel(Weights::Gaussian, 5);
    let values = stage.look(gpu, shader);
    let truth = |p: DVec3| edge_visibility(&kernel, lamp.at(p).0 - SIDE / 2.0 - 4.0);
    stage.on_ground(&values).map(|(p, v)| (v, truth(p))).collect()
}

/// Halves that may truncate lose 2^-10 of a number each time that they are stored: thrice, in drawing and two blurs.
const HALF_LOSS: f64 = 3.0 / 1024.0;

/// An exponent of 11 in halves: lit but for what storing loses, and in the umbra what an exponent of 11 leaks.
#[test]
fn exponentials_fit_halves() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu, "r16float") {
        return;
    }
    for lamp in Lamp::BOTH {
        for (format, exponent) in [("float16", "11"), ("auto", "80")] {
            // Halves are given at most 11.08.
            let c = f64::min(exponent.parse().expect("a number"), 11.08);
            let leak = (-c * (lamp.depth(0.0) - lamp.depth(1.0))).exp();
            let options = format!("\"format\": \"{format}\", \"exponent\": \"{exponent}\", {PLAIN}");
            let shader = lamp.shadow("exponential_shadow", "", &options);
            for (value, truth) in edge(&mut gpu, lamp, &shader) {
                let law = truth + (1.0 - truth) * leak;
                assert!((value - law).abs() < HALF_LOSS + 1e-3, "{lamp:?} {format}: {value} is not {law}");
            }
        }
    }
}

/// Exponents of 5.54 in halves: what storing loses of the receiver stays within the minimum variance, which leaks by its law.
#[test]
fn warped_variance_fits_halves() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu, "rgba16float") || !able(&gpu, "rg16float") {
        return;
    }
    for lamp in Lamp::BOTH {
        for (warps, format) in [("one", "float16"), ("two", "float16"), ("two", "auto")] {
            let options = format!("\"warps\": \"{warps}\", \"format\": \"{format}\", {PLAIN}");
            let shader = lamp.shadow("exponential_variance_shadow", "", &options);
            // The warp's own rounding, over the square of its slope, is variance as well.
            let variance = 3e-5 + 2.0 * HALF_LOSS / (11.08 * 11.08);
            let behind = (1.0 - (-11.08 * (lamp.depth(0.0) - lamp.depth(1.0))).exp()) / 11.08;
            let leak = variance / (variance + behind * behind);
            for (value, truth) in edge(&mut gpu, lamp, &shader) {
                let what = format!("{lamp:?} {warps} {format}: {value} is not {truth}, leak {leak}");
                if truth == 1.0 {
                    assert!(value > 1.0 - STEP, "{what}");
                } else {
                    assert!((value - truth).abs() < leak + STEP, "{what}");
                }
            }
        }
    }
}

/// Four moments of 16 bits, mixed to use them: one occluder is off by less than an 8-bit step rms (a float64 model: 0.002).
#[test]
fn four_moments_fit_16_bits() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu, "rgba16unorm") {
        return;
    }
    for lamp in Lamp::BOTH {
        for format in ["unorm16", "auto"] {
            let options = format!("\"format\": \"{format}\", {PLAIN}");
            let shader = lamp.shadow("moment_shadow", "\"bleeding_reduction\": 0", &options);
            let pixels = edge(&mut gpu, lamp, &shader);
            let rms = (pixels.iter().map(|(a, b)| (a - b).powi(2)).sum::<f64>() / pixels.len() as f64).sqrt();
            assert!(rms < STEP, "{lamp:?} {format}: {rms}");
        }
    }
}

/// Where on a row visibility rises through a quarter and three quarters.
fn quarters(row: &[(f64, f64)]) -> Option<f64> {
    let cross = |level: f64| {
        let pair = row.windows(2).find(|w| w[0].1 <= level && w[1].1 > level)?;
        Some(pair[0].0 + (pair[1].0 - pair[0].0) * (level - pair[0].1) / (pair[1].1 - pair[0].1))
    };
    Some(cross(0.75)? - cross(0.25)?)
}

/// Four splits of a wide view, zoomed by very different amounts: the shadow of a long edge is as soft in all of them, in
/// metres, to a texel of the coarsest.
#[test]
fn blurs_are_as_wide_in_every_split() {
    let Some(mut gpu) = gpu() else { return };
    let graph = format!(
        "Graph(version: 1, nodes: {{\"lamp\": (kind: \"directional_light\", params: {{\"direction\": (0, -1, 0)}}, options: \
         {{\"splits\": \"4\"}}), \"shadow\": (kind: \"variance_shadow\", params: {{\"bleeding_reduction\": 0}}, options: \
         {{\"size\": \"256\", \"width\": \"9\", \"weights\": \"box\", {PLAIN}}})}}, links: [\"lamp -> shadow\"])"
    );
    let shader = visibility(&graph);
    let ground = Item::plane([30.0, 60.0], DMat4::IDENTITY);
    let plate = Item::plane([30.0, 60.0], DMat4::from_translation(DVec3::new(-15.0, 1.0, 0.0)));
    let view = View {
        position: DVec3::new(0.2, 0.6, 20.0),
        target: DVec3::new(0.2, 0.0, 18.0),
        up: DVec3::Y,
        half_height: 0.22,
        size: (200, 40),
    };
    let stage = Stage::new(vec![ground, plate], view);
    let values = stage.look(&mut gpu, &shader);
    let points: Vec<(DVec3, f64)> = stage.on_ground(&values).collect();
    let mut widths: Vec<(f64, f64)> = Vec::new();
    for row in points.chunks(200) {
        let line: Vec<(f64, f64)> = row.iter().map(|(p, v)| (p.x, *v)).collect();
        widths.extend(quarters(&line).map(|w| (20.0 - row[0].0.z, w)));
    }
    let (nearest, farthest) =
        (widths.iter().map(|w| w.0).fold(f64::INFINITY, f64::min), widths.iter().map(|w| w.0).fold(0.0, f64::max));
    assert!(widths.len() > 10 && nearest < 2.0 && farthest > 6.0, "from {nearest} to {farthest} m: {widths:?}");
    let (least, most) =
        (widths.iter().map(|w| w.1).fold(f64::INFINITY, f64::min), widths.iter().map(|w| w.1).fold(0.0, f64::max));
    // Half of a box of 9 texels, give or take one of them for the tent of the sampler and the grid.
    assert!(most / least < (4.5 + 0.5) / (4.5 - 0.5), "{least} to {most}: {widths:?}");
}
