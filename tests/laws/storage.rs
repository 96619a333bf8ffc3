//! How moments are stored, sampled and drawn: every way gives the closed form of a straight edge, or what is known to be
//! lost.

use shadetree::compile::Compiled;
use shadetree::reference::{Taps, Weights, edge_visibility, kernel, reduce_bleeding, worst_bleeding};
use shadetree::render::Gpu;

use super::lamp::{Lamp, PLAIN, Plate, SIDE, STEP, layers, sampled, under, vsm};
use crate::stage::{gpu, skipped};

const EDGE: [Plate; 1] = [Plate { height: 1.0, edge: 4.0, angle: 0.0 }];

/// Pixels under a plate with their distance in texels to its edge.
fn ramp(gpu: &mut Gpu, lamp: Lamp, shader: &Compiled) -> Vec<(f64, f64)> {
    let stage = under(lamp, &EDGE, 24.0, (160, 2));
    let values = stage.look(gpu, shader);
    stage.on_ground(&values).map(|(p, v)| (lamp.at(p).0 - SIDE / 2.0 - 4.0, v)).collect()
}

fn worst(ramp: &[(f64, f64)], truth: impl Fn(f64) -> f64) -> f64 {
    ramp.iter().map(|(x, v)| (v - truth(*x)).abs()).fold(0.0, f64::max)
}

/// Whether an adapter makes and filters a format; says so if not.
fn able(gpu: &Gpu, format: &str) -> bool {
    let found = gpu.adapter().formats.iter().find(|(name, _)| name == format);
    let able = found.is_some_and(|(_, able)| able.renderable && able.filterable);
    if !able {
        skipped(&format!("{} cannot render and filter {format}", gpu.adapter()));
    }
    able
}

/// Widths to 25 texels, in halves, signed, by loads, through every metric: one plane above another has the closed form. In
/// perspective neither z / w nor radial depth changes the order of things; one occluder at a depth of its own is exact.
#[test]
fn every_way_of_storing_variance_gives_the_closed_form() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        for (options, width, bar) in [
            ("\"format\": \"split\"", 5, STEP),
            ("\"format\": \"split\", \"range\": \"signed\"", 9, STEP),
            ("\"range\": \"signed\"", 5, STEP),
            ("\"sampling\": \"manual\"", 5, sampled(&gpu)),
            ("\"sampling\": \"hardware\"", 5, sampled(&gpu)),
            ("\"samples\": \"4\"", 5, STEP),
            ("\"least\": \"bias\"", 5, STEP),
            ("\"metric\": \"zw\"", 5, STEP),
            ("\"cull\": \"back\"", 15, sampled(&gpu)),
            ("", 25, sampled(&gpu)),
        ] {
            if options.contains("split") && !able(&gpu, "rgba16float") {
                continue;
            }
            for (name, weights) in Weights::ALL {
                let kernel = kernel(weights, width);
                let ramp = ramp(
                    &mut gpu,
                    lamp,
                    &vsm(lamp, name, width, &format!("{options}{}{PLAIN}", if options.is_empty() { "" } else { ", " })),
                );
                let off = worst(&ramp, |x| edge_visibility(&kernel, x));
                assert!(off < bar, "{lamp:?} {name} {width} {options}: {off}");
            }
        }
    }
}

/// Blocks of d texels are averaged first: a box of d texels, and then the blur in texels of d.
#[test]
fn downsampling_widens_the_blur() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        for scale in [2, 4] {
            let options = format!("\"downsample\": \"{scale}\", {PLAIN}");
            // The edge lies on a block's, so that blocks are of one kind.
            let kernel = kernel(Weights::Box, 3);
            let ramp = ramp(&mut gpu, lamp, &vsm(lamp, "box", 3, &options));
            let off = worst(&ramp, |x| edge_visibility(&kernel, x / f64::from(scale)));
            assert!(off < sampled(&gpu), "{lamp:?} {scale}: {off}");
        }
    }
}

/// Planes facing away from the light are left out by culling them, and all shadow with them.
#[test]
fn culled_sides_cast_no_shadow() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        for (cull, dark) in [("none", 0.0), ("back", 0.0), ("front", 1.0)] {
            let options = format!("\"cull\": \"{cull}\", {PLAIN}");
            let shader = vsm(lamp, "box", 3, &options);
            let values = ramp(&mut gpu, lamp, &shader);
            let deep = values.iter().filter(|(x, _)| *x < -4.0).map(|(_, v)| *v);
            for value in deep {
                assert!((value - dark).abs() < 1e-3, "{lamp:?} {cull}: {value}");
            }
            // A mirrored plate has the same sides.
            let mut stage = under(lamp, &EDGE, 24.0, (160, 2));
            stage.items[1].mirror();
            let least = stage.look(&mut gpu, &shader).into_iter().fold(1.0, f64::min);
            assert!((least - dark).abs() < 1e-3, "{lamp:?} {cull}, mirrored: {least}");
        }
    }
}

/// Standard deviations do not interpolate: half way between two flat texels there is none, and the ramp of the edge is a
/// step at the middle, where squares give the ramp itself.
#[test]
fn deviations_turn_edges_hard() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        let kernel = kernel(Weights::Box, 1);
        let truth = |x: f64| edge_visibility(&kernel, x);
        let squares = ramp(&mut gpu, lamp, &vsm(lamp, "box", 1, PLAIN));
        assert!(worst(&squares, truth) < sampled(&gpu), "{lamp:?}");
        let deviations = ramp(&mut gpu, lamp, &vsm(lamp, "box", 1, &format!("\"second\": \"deviation\", {PLAIN}")));
        // The step lies where the ramp has reached 1; pixels are 0.15 texels wide.
        assert!(worst(&deviations, truth) > 0.8, "{lamp:?}: {}", worst(&deviations, truth));
        // In front of the mean lies only what is all lit.
        for (x, value) in deviations.iter().filter(|(x, _)| (x.abs() - 0.5).abs() > 0.02) {
            assert!(*value < 0.01 || *value > 0.99, "{lamp:?} {x}: {value}");
        }
    }
}

/// The amount that is measured per tile leaves nothing in full shadow, whatever the spread; where there is one occluder it
/// is nothing; and between it takes no more than itself of the shadow away.
#[test]
fn measured_reduction_removes_bleeding_and_spares_the_rest() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        let shader = |bleeding: &str| {
            let options = format!("\"bleeding\": \"{bleeding}\", \"width\": \"11\", \"weights\": \"box\", {PLAIN}");
            lamp.shadow("variance_shadow", "", &options)
        };
        let measured = shader("measured");
        let kernel = kernel(Weights::Box, 11);
        let one = ramp(&mut gpu, lamp, &measured);
        let off = worst(&one, |x| edge_visibility(&kernel, x));
        assert!(off < STEP, "{lamp:?}: one occluder is off by {off}");
        for (lower, reach) in [(0.75, 43.0), (0.5, 43.0), (0.25, 43.0), (0.5, 7.0)] {
            let plates =
                [Plate { height: 1.0, edge: 3.0, angle: 0.0 }, Plate { height: lower, edge: reach, angle: 0.0 }];
            let truth = layers(lamp, &plates);
            let stage = under(lamp, &plates, 24.0, (240, 2));
            let values = stage.look(&mut gpu, &measured);
            let apart = lamp.depth(lower) - lamp.depth(1.0);
            let gap = lamp.depth(0.0) - lamp.depth(lower);
            // Occluders are known to a step of a 32nd of all depths of a tile.
            let step = (apart + gap) / 32.0;
            let most = worst_bleeding((apart + step) / (gap - step));
            for (point, value) in stage.on_ground(&values) {
                let mix = truth.mix(&kernel, Taps::Bilinear, lamp.at(point));
                let what = format!("{lamp:?} {lower} at {point}: {value}, {mix:?}");
                if mix.lit() < 1e-9 {
                    assert!(value < 2.0 * STEP, "{what}");
                }
                let low = reduce_bleeding(mix.bound(), most);
                assert!(value > low - 2.0 * STEP && value < mix.bound() + 2.0 * STEP, "{what}: from {low}");
            }
        }
    }
}
