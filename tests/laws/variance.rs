//! What the variance bound makes of more than one occluder, and of its minimum variance.

use shadetree::compile::Compiled;
use shadetree::reference::{Mix, Taps, Weights, kernel, reduce_bleeding, spread_cured_by, worst_bleeding};

use super::lamp::{Lamp, PLAIN, Plate, layers, sampled, under, vsm};
use crate::stage::{gpu, renders};

/// A plate at 1 m, and one below it that reaches farther to the right by `between` texels.
fn stack(lower: f64, between: f64) -> [Plate; 2] {
    let upper = Plate { height: 1.0, edge: 3.0, angle: 0.0 };
    [upper, Plate { height: lower, edge: 3.0 + between, angle: 0.0 }]
}

/// The path of a parameter of the node `shadow`.
fn path(shader: &Compiled, name: &str) -> String {
    let found = shader.module.parameters.iter().find(|p| p.path.ends_with(&format!("shadow.{name}")));
    found.unwrap_or_else(|| panic!("no parameter {name}")).path.clone()
}

/// Over two occluders the bound is affine in the lit share, with the relative variance of the occluders.
#[test]
fn bleeding_follows_the_affine_law() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        for (name, weights) in Weights::ALL {
            let (shader, kernel) = (vsm(lamp, name, 11, PLAIN), kernel(weights, 11));
            for (lower, between) in [(0.7, 4.0), (0.5, 2.0), (0.25, 6.0)] {
                let plates = stack(lower, between);
                let truth = layers(lamp, &plates);
                let stage = under(lamp, &plates, 24.0, (240, 2));
                let values = stage.look(&mut gpu, &shader);
                let mut most = 0.0_f64;
                for (point, bound) in stage.on_ground(&values) {
                    let mix = truth.mix(&kernel, Taps::Bilinear, lamp.at(point));
                    let off = (bound - mix.bound()).abs();
                    assert!(off < sampled(&gpu), "{lamp:?} {name} {lower} at {point}: {bound}, {}", mix.bound());
                    most = most.max(mix.bound() - mix.lit());
                }
                assert!(most > 0.005, "light bleeds: {most}");
            }
        }
    }
}

/// The right amount of reduction turns the bound into the truth; finding it by trying builds no pipelines.
#[test]
fn the_right_amount_cures_bleeding_exactly_and_builds_no_pipeline() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        let (shader, kernel) = (vsm(lamp, "box", 11, PLAIN), kernel(Weights::Box, 11));
        let plates = stack(0.5, 5.0);
        let truth = layers(lamp, &plates);
        let mut stage = under(lamp, &plates, 20.0, (20, 1));
        let bounds = stage.look(&mut gpu, &shader);
        let mixes: Vec<Mix> =
            stage.on_ground(&bounds).map(|(p, _)| truth.mix(&kernel, Taps::Bilinear, lamp.at(p))).collect();
        let built = gpu.pipelines_built();
        let mut cured = 0;
        for (pixel, mix) in mixes.iter().enumerate().filter(|(_, m)| m.cure() > 0.01) {
            stage.set(&path(&shader, "bleeding_reduction"), &[mix.cure()]);
            let values = stage.look(&mut gpu, &shader);
            assert!((values[pixel] - mix.lit()).abs() < sampled(&gpu), "{lamp:?} {pixel}: {} {mix:?}", values[pixel]);
            // The same amount elsewhere: the remap of the bound, whatever the bound.
            for (value, bound) in values.iter().zip(&bounds) {
                assert!((value - reduce_bleeding(*bound, mix.cure())).abs() < sampled(&gpu));
            }
            cured += 1;
        }
        assert!(cured >= 8, "{cured}");
        assert_eq!(gpu.pipelines_built(), built, "values need no pipelines");
    }
}

/// In full shadow: never above the worst case of the spread, which is reached, and gone with the amount against it.
#[test]
fn bleeding_in_full_shadow_has_the_worst_case_of_its_spread() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        let shader = vsm(lamp, "box", 11, PLAIN);
        for lower in [0.75, 0.5, 0.25] {
            let spread = (lamp.depth(lower) - lamp.depth(1.0)) / (lamp.depth(0.0) - lamp.depth(lower));
            // The lower plate reaches so far that no kernel around the upper edge leaves it.
            let mut stage = under(lamp, &stack(lower, 40.0), 16.0, (480, 2));
            let most = stage.look(&mut gpu, &shader).into_iter().fold(0.0, f64::max);
            let worst = worst_bleeding(spread);
            assert!((most - worst).abs() < sampled(&gpu), "{lamp:?} {lower}: {most} is not {worst}");
            assert!((spread_cured_by(worst) - spread).abs() < 1e-9);
            stage.set(&path(&shader, "bleeding_reduction"), &[worst]);
            let left = stage.look(&mut gpu, &shader).into_iter().fold(0.0, f64::max);
            assert!(left < sampled(&gpu), "{lamp:?} {lower}: {left} is left");
        }
    }
}

/// The minimum variance e lets e / (e + D^2) through under one occluder at distance D.
#[test]
fn minimum_variance_leaks_by_its_law() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        let shader = vsm(lamp, "gaussian", 5, PLAIN);
        // Where the map has 16 bits, rounding adds to the variance.
        let noise = if renders(&gpu, "rg32float") { 0.0 } else { 3.0 * 3.0 / 131_072.0 };
        for height in [1.0, 0.3, 0.1] {
            let plates = [Plate { height, edge: 60.0, angle: 0.0 }];
            let mut stage = under(lamp, &plates, 4.0, (16, 2));
            stage.view.position.x = 0.0;
            stage.view.target.x = 0.0;
            // The fitted range of the sun ends at the highest object: a speck far from the view keeps it where it was.
            let speck = Plate { height: 1.0, edge: -120.0, angle: 0.0 };
            stage.items.extend(under(lamp, &[speck], 4.0, (16, 2)).items.into_iter().skip(1));
            let gap = lamp.depth(0.0) - lamp.depth(height);
            for least in [1e-6, 1e-4, 1e-2] {
                stage.set(&path(&shader, "minimum_variance"), &[least]);
                let leak = |variance: f64| variance / (variance + gap * gap);
                for value in stage.look(&mut gpu, &shader) {
                    let (low, high) = (leak(least) * 0.998 - 2e-6, leak(least + noise) * 1.002 + 2e-6);
                    assert!((low..=high).contains(&value), "{height} {least}: {value} {low} {high}");
                }
            }
        }
    }
}
