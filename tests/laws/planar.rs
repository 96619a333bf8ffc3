//! One plane above another: percentage-closer filtering, variance shadow maps and the closed form agree.

use shadetree::compile::Compiled;
use shadetree::reference::{Taps, Weights, box_ramp, edge_visibility, kernel};
use shadetree::render::Gpu;

use super::lamp::{CLOSED_FORM, Lamp, PLAIN, Plate, SIDE, STEP, layers, pcf, sampled, under, vsm};
use crate::stage::{Stage, gpu, grain};

/// A plate 1 m above the ground.
fn half_plane(edge: f64, angle: f64) -> [Plate; 1] {
    [Plate { height: 1.0, edge, angle }]
}

/// Pixels of `shader` with their distance in texels to the edge, which counts as lying on a boundary of texels.
fn ramp(gpu: &mut Gpu, lamp: Lamp, stage: &Stage, edge: f64, shader: &Compiled) -> Vec<(f64, f64)> {
    let values = stage.look(gpu, shader);
    stage.on_ground(&values).map(|(p, v)| (lamp.at(p).0 - SIDE / 2.0 - edge.round(), v)).collect()
}

pub(super) fn worst(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn filtered_comparison_variance_and_the_closed_form_agree_on_a_straight_edge() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        for (name, weights) in Weights::ALL {
            for width in [1, 3, 5, 7, 9, 11] {
                let kernel = kernel(weights, width);
                let variance = vsm(lamp, name, width, PLAIN);
                let compared = (width <= 9).then(|| pcf(lamp, name, width, "bilinear"));
                for edge in [4.0, 4.3] {
                    let what = format!("{name} {width}, edge {edge}");
                    let stage = under(lamp, &half_plane(edge, 0.0), 16.0, (320, 2));
                    let vsm = ramp(&mut gpu, lamp, &stage, edge, &variance);
                    let off = worst(vsm.iter().map(|(x, v)| (*v, edge_visibility(&kernel, *x))));
                    assert!(off < sampled(&gpu), "{what}: variance is off by {off}");
                    if weights == Weights::Box {
                        let off = worst(vsm.iter().map(|(x, v)| (*v, box_ramp(width as f64, *x))));
                        assert!(off < sampled(&gpu), "{what}: variance is off the ramp by {off}");
                    }
                    let Some(compared) = &compared else { continue };
                    let pcf = ramp(&mut gpu, lamp, &stage, edge, compared);
                    let off = worst(pcf.iter().map(|(x, v)| (*v, edge_visibility(&kernel, *x))));
                    assert!(off < CLOSED_FORM, "{what}: comparison is off by {off}");
                    let off = worst(vsm.iter().zip(&pcf).map(|(a, b)| (a.1, b.1)));
                    assert!(off < STEP, "{what}: variance and comparison differ by {off}");
                }
            }
        }
    }
}

/// An edge across the texels: every texel of the kernel is on one side or the other, as in float64.
#[test]
fn a_turned_edge_is_filtered_as_in_float64() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        for (angle, edge) in [(0.3, 5.13), (-0.9, -7.4), (2.0, 3.3)] {
            let plates = half_plane(edge, angle);
            let truth = layers(lamp, &plates);
            let stage = under(lamp, &plates, 24.0, (96, 24));
            for (width, weights) in
                [(1, Weights::Box), (3, Weights::Tent), (5, Weights::Gaussian), (7, Weights::Box), (9, Weights::Tent)]
            {
                let name = Weights::ALL.iter().find(|(_, w)| *w == weights).expect("listed").0;
                let kernel = kernel(weights, width);
                let compared = stage.look(&mut gpu, &pcf(lamp, name, width, "bilinear"));
                let variance = stage.look(&mut gpu, &vsm(lamp, name, width, PLAIN));
                let what = format!("{lamp:?} {name} {width} at {angle}");
                let off = worst(variance.iter().copied().zip(compared.iter().copied()));
                assert!(off < STEP, "{what}: variance and comparison differ by {off}");
                let mut judged = 0;
                for (point, lit) in stage.on_ground(&compared) {
                    let at = lamp.at(point);
                    // Rasterisers place vertices on a grid of 1/256 texel: texels that near the edge may go either way.
                    if truth.margin(at.0, at.1, width as i64 / 2 + 1) > 0.01 {
                        let expected = truth.lit(&kernel, Taps::Bilinear, at);
                        assert!((lit - expected).abs() < CLOSED_FORM, "{what} at {at:?}: {lit} is not {expected}");
                        judged += 1;
                    }
                }
                assert!(judged * 2 > compared.len(), "{what}: {judged} pixels");
            }
        }
    }
}

/// Nearest taps: as many steps as the kernel has texels.
#[test]
fn nearest_taps_and_the_hard_shadow_make_stairs() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        let plates = half_plane(4.3, 0.0);
        let truth = layers(lamp, &plates);
        let stage = under(lamp, &plates, 12.0, (300, 2));
        for width in [1, 3, 5, 7, 9] {
            let shader =
                if width == 1 { lamp.shadow("hard_shadow", "", "") } else { pcf(lamp, "box", width, "nearest") };
            let values = stage.look(&mut gpu, &shader);
            let kernel = kernel(Weights::Box, width);
            for (point, lit) in stage.on_ground(&values) {
                let at = lamp.at(point);
                // On the boundary of two texels either is the nearest.
                if (at.0 - at.0.round()).abs() > 1e-3 && (at.1 - at.1.round()).abs() > 1e-3 {
                    let expected = truth.lit(&kernel, Taps::Nearest, at);
                    assert!(
                        (lit - expected).abs() < grain(&gpu),
                        "{lamp:?} {width} at {at:?}: {lit} is not {expected}"
                    );
                }
            }
        }
    }
}

/// The sampler's own blend of comparisons, whose weights devices may round to 1/256.
#[test]
fn hardware_taps_agree_with_taps_in_the_shader() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        for width in [1, 3, 5, 7, 9] {
            let stage = under(lamp, &half_plane(4.3, 0.2), 16.0, (160, 8));
            let shader = stage.look(&mut gpu, &pcf(lamp, "gaussian", width, "bilinear"));
            let sampler = stage.look(&mut gpu, &pcf(lamp, "gaussian", width, "hardware"));
            let off = worst(shader.into_iter().zip(sampler));
            assert!(off < STEP, "{lamp:?} {width}: {off}");
        }
        for (kind, params) in [("disc_shadow", "\"radius\": 4"), ("adaptive_pcf_shadow", "\"width\": 4")] {
            let stage = under(lamp, &half_plane(4.3, 0.2), 16.0, (160, 8));
            let mut look =
                |taps: &str| stage.look(&mut gpu, &lamp.shadow(kind, params, &format!("\"taps\": \"{taps}\"")));
            let off = worst(look("bilinear").into_iter().zip(look("hardware")));
            assert!(off < STEP, "{lamp:?} {kind}: {off}");
        }
    }
}

/// Where the picture magnifies the map, mips have nothing to do. Devices choose their own kernel for anisotropic
/// sampling, and lavapipe's is a little wider than its bilinear one even then: by less than an eighth of a texel, over
/// which this blur changes by at most 0.04.
#[test]
fn mips_change_nothing_under_magnification() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        let stage = under(lamp, &half_plane(4.3, 0.2), 16.0, (160, 8));
        let plain = stage.look(&mut gpu, &vsm(lamp, "gaussian", 5, PLAIN));
        for (filter, anisotropy, most) in
            [("linear", 1, sampled(&gpu)), ("trilinear", 1, sampled(&gpu)), ("trilinear", 16, 0.04)]
        {
            let rest = format!("\"mips\": \"on\", \"filter\": \"{filter}\", \"anisotropy\": \"{anisotropy}\"");
            let mipped = stage.look(&mut gpu, &vsm(lamp, "gaussian", 5, &rest));
            let off = worst(plain.iter().copied().zip(mipped));
            assert!(off < most, "{lamp:?} {filter} {anisotropy}: {off}");
        }
    }
}
