//! The same laws in every format of moments, and the same numbers on every adapter.

use glam::{DMat4, DVec3};
use shadetree::reference::{Weights, edge_visibility, kernel};
use shadetree::render::{AdapterOptions, Gpu, RenderError, adapters};

use super::lamp::{CLOSED_FORM, Lamp, PLAIN, Plate, SIDE, STEP, pcf, under, vsm};
use super::planar::worst;
use crate::stage::{Item, Stage, View, gpu, open, skipped, visibility};

/// A format, how far its rounding moves mean square - mean^2 of a flat depth z at most, and a minimum variance for it.
type Format = (&'static str, fn(f64) -> f64, f64);

/// Stores of half floats may truncate, which doubles the unit; and near 0 halves have a fixed step of 2^-24.
const FORMATS: [Format; 3] = [
    ("rg32float", |z| 3.0 * z * z / 16_777_216.0, 1e-6),
    ("rg16unorm", |z| (1.0 + 2.0 * z) / 131_072.0, 2e-5),
    ("rg16float", |z| 2.0 * 3.0 * z * z / 2048.0 + 1.0 / 16_777_216.0, 1e-4),
];

/// Whether the adapter makes maps in a format; says so if not.
fn able(gpu: &Gpu, format: &str) -> bool {
    let known = gpu.adapter().formats.iter().find(|(name, _)| name == format);
    let able = known.is_some_and(|(_, able)| able.renderable && able.filterable);
    if !able {
        skipped(&format!("{} cannot render and filter {format}", gpu.adapter()));
    }
    able
}

/// A plane that runs through the whole range of the map: every texel is a flat depth of its own.
#[test]
fn rounding_of_moments_stays_in_bounds() {
    let Some(mut gpu) = gpu() else { return };
    for (format, bound, _) in FORMATS {
        if !able(&gpu, format) {
            continue;
        }
        let (kind, lamp) = Lamp::Sun.kind();
        let options = format!(
            "\"size\": \"256\", \"width\": \"1\", \"slope_variance\": \"off\", \"format\": \"{format}\", {PLAIN}"
        );
        let shader = visibility(&crate::stage::light(kind, lamp, "variance_shadow", "", &options));
        let ramp = Item::plane([4.0, 4.0], DMat4::from_rotation_z(0.5));
        let stage = Stage::new(vec![ramp], View::down((0.0, 0.0), 2.0, 1.0, (4, 4)));
        let map = gpu.map(&stage.job(&shader), "light/lamp", 0).expect("renders");
        assert_eq!(map.format, format);
        let (mut near, mut far, mut most) = (1.0_f64, 0.0_f64, 0.0_f64);
        for [mean, square, ..] in &map.pixels {
            let (mean, square) = (f64::from(*mean), f64::from(*square));
            let off = (square - mean * mean).abs();
            assert!(off <= bound(mean), "{format} at {mean}: {off} is over {}", bound(mean));
            (near, far, most) = (near.min(mean), far.max(mean), most.max(off));
        }
        assert!(near < 0.05 && far > 0.95, "depths from {near} to {far}");
        assert!(most > 0.0, "{format} rounds");
    }
}

/// With the minimum variance of its format, what is lit is lit and what is dark leaks by the law alone.
#[test]
fn every_format_keeps_lit_and_dark_apart() {
    let Some(mut gpu) = gpu() else { return };
    for (format, bound, least) in FORMATS {
        if !able(&gpu, format) {
            continue;
        }
        for lamp in Lamp::BOTH {
            let (kernel, edge) = (kernel(Weights::Gaussian, 5), 4.0);
            let stage = {
                let mut stage = under(lamp, &[Plate { height: 1.0, edge, angle: 0.0 }], 16.0, (160, 2));
                stage.set("light/shadow.minimum_variance", &[least]);
                stage
            };
            let values = stage.look(&mut gpu, &vsm(lamp, "gaussian", 5, &format!("{PLAIN}, \"format\": \"{format}\"")));
            let gap = lamp.depth(0.0) - lamp.depth(1.0);
            // Blurring along two axes rounds three times.
            let variance = least + 3.0 * bound(lamp.depth(1.0));
            let leak = variance / (variance + gap * gap);
            for (point, value) in stage.on_ground(&values) {
                let truth = edge_visibility(&kernel, lamp.at(point).0 - SIDE / 2.0 - edge);
                let what = format!("{format} {lamp:?}: {value} is not {truth}");
                if truth == 1.0 {
                    assert!(value > 1.0 - STEP, "{what}");
                } else if truth == 0.0 {
                    assert!(value <= leak + 1e-6, "{what}, and {leak} may leak");
                } else {
                    // Between: the leak, and what rounding of the mean does to the slope of the bound.
                    assert!((value - truth).abs() < leak + STEP, "{what}");
                }
            }
        }
    }
}

/// OpenGL and Vulkan agree to less than one 8-bit step, and so do both with the closed form.
#[test]
fn adapters_agree() {
    let Some(mut first) = gpu() else { return };
    let gl = AdapterOptions { backends: Some("gl".into()), ..AdapterOptions::default() };
    if first.adapter().backend == "gl" || adapters(&gl).is_ok_and(|found| found.is_empty()) {
        return skipped("there is no second backend to compare with");
    }
    let Some(mut second) = open(gl.backends) else { return };
    for lamp in Lamp::BOTH {
        let stage = under(lamp, &[Plate { height: 1.0, edge: 4.0, angle: 0.0 }], 16.0, (160, 4));
        for (shader, bar) in [
            (pcf(lamp, "gaussian", 5, "bilinear"), CLOSED_FORM),
            (pcf(lamp, "gaussian", 5, "hardware"), STEP),
            (pcf(lamp, "box", 3, "nearest"), f64::INFINITY),
            (vsm(lamp, "gaussian", 5, PLAIN), STEP),
            (vsm(lamp, "gaussian", 5, "\"anisotropy\": \"1\""), STEP),
        ] {
            let (a, b) = match (stage_values(&stage, &mut first, &shader), stage_values(&stage, &mut second, &shader)) {
                (Ok(a), Ok(b)) => (a, b),
                (Err(error), _) | (_, Err(error)) => panic!("{error}"),
            };
            let off = worst(a.iter().copied().zip(b.iter().copied()));
            assert!(off < STEP, "{lamp:?}: {off} between {} and {}", first.adapter(), second.adapter());
            let kernel = kernel(Weights::Gaussian, 5);
            for (point, value) in stage.on_ground(&b) {
                let truth = edge_visibility(&kernel, lamp.at(point).0 - SIDE / 2.0 - 4.0);
                assert!((value - truth).abs() < bar, "{lamp:?} at {point}: {value} is not {truth}");
            }
        }
    }
}

fn stage_values(stage: &Stage, gpu: &mut Gpu, shader: &shadetree::compile::Compiled) -> Result<Vec<f64>, RenderError> {
    let frame = gpu.render(&stage.job(shader))?;
    Ok(frame.pixels.iter().map(|p| f64::from(p[0])).collect())
}
