//! Exponential warps: what leaks at contacts, what bleeds, and what lies behind a receiver's edge.

use glam::{DMat4, DVec3};
use shadetree::compile::Compiled;
use shadetree::reference::{Taps, Weights, kernel, worst_bleeding, worst_warped_bleeding};
use shadetree::render::Gpu;

use super::lamp::{Lamp, PLAIN, Plate, SIDE, STEP, layers, sampled, under};
use super::methods::{METHODS, Method};
use crate::stage::{Item, Stage, View, gpu, light, renders, skipped, visibility};

/// In full shadow under one wide plate at a height, where a speck far off keeps the sun's range.
fn umbra(lamp: Lamp, height: f64) -> Stage {
    let mut stage = under(lamp, &[Plate { height, edge: 60.0, angle: 0.0 }], 4.0, (16, 2));
    stage.view.position.x = 0.0;
    stage.view.target.x = 0.0;
    let speck = Plate { height: 1.0, edge: -120.0, angle: 0.0 };
    stage.items.extend(under(lamp, &[speck], 4.0, (16, 2)).items.into_iter().skip(1));
    stage
}

fn able(gpu: &Gpu) -> bool {
    let able = renders(gpu, "rgba32float") && renders(gpu, "rg32float") && renders(gpu, "r32float");
    if !able {
        skipped(&format!("{} has no maps of 32-bit floats", gpu.adapter()));
    }
    able
}

/// e^(-c D) leaks through one occluder at distance D, whether exponentials or their logarithms are stored.
#[test]
fn an_exponential_leaks_at_contacts_by_its_law() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu) {
        return;
    }
    for lamp in Lamp::BOTH {
        for (exponent, domain) in [(80.0, "plain"), (11.0, "plain"), (80.0, "log"), (20.0, "log")] {
            let options =
                format!("\"exponent\": \"{exponent}\", \"domain\": \"{domain}\", \"sampling\": \"manual\", {PLAIN}");
            let shader = lamp.shadow("exponential_shadow", "", &options);
            let mut seen = 0;
            for height in [0.5, 0.2, 0.1, 0.05, 0.02] {
                let leak = (-exponent * (lamp.depth(0.0) - lamp.depth(height))).exp();
                for value in umbra(lamp, height).look(&mut gpu, &shader) {
                    // Depth is known to 1e-6, which the exponential stretches.
                    let bound = 1e-4 + leak * exponent * 2e-6;
                    assert!((value - leak).abs() < bound, "{lamp:?} {exponent} {domain} {height}: {value}, law {leak}");
                }
                seen += i32::from(leak > STEP);
            }
            assert!(seen >= 2, "some of it can be seen");
        }
    }
}

/// Two occluders under one warp: the worst case of their warped distances, below a bound that does not depend on how far
/// apart they lie.
#[test]
fn bleeding_under_a_warp_has_the_worst_case_of_its_gap() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu) {
        return;
    }
    for lamp in Lamp::BOTH {
        for exponent in [5.0, 10.0, 40.0] {
            let options = format!(
                "\"warps\": \"one\", \"exponent\": \"{exponent}\", \"width\": \"11\", \"weights\": \"box\", \"sampling\": \
                 \"manual\", {PLAIN}"
            );
            let shader = lamp.shadow("exponential_variance_shadow", "\"minimum_variance\": 0", &options);
            for lower in [0.6, 0.3, 0.1] {
                let plates =
                    [Plate { height: 1.0, edge: 3.0, angle: 0.0 }, Plate { height: lower, edge: 43.0, angle: 0.0 }];
                let apart = lamp.depth(lower) - lamp.depth(1.0);
                let gap = lamp.depth(0.0) - lamp.depth(lower);
                let spread = (1.0 - (-2.0 * exponent * apart).exp()) / ((2.0 * exponent * gap).exp() - 1.0);
                let values = under(lamp, &plates, 16.0, (480, 2)).look(&mut gpu, &shader);
                let most = values.into_iter().fold(0.0, f64::max);
                // Shares of the nearer occluder come in steps of a pixel, 1/330 of the blur.
                assert!((most - worst_bleeding(spread)).abs() < sampled(&gpu), "{lamp:?} {exponent} {lower}: {most}");
                assert!(most < worst_warped_bleeding(exponent, gap) + sampled(&gpu), "{lamp:?} {exponent} {lower}");
            }
        }
    }
}

/// The minimum variance e of depth, stretched by the warp: e / (e + d^2) leaks, with d = (1 - e^(-2 c D)) / (2 c) what the warp
/// makes of the distance D.
#[test]
fn minimum_variance_leaks_under_a_warp_by_its_law() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu) {
        return;
    }
    for lamp in Lamp::BOTH {
        for least in [1e-8, 1e-6, 1e-4] {
            let options = format!("\"warps\": \"one\", \"exponent\": \"40\", \"sampling\": \"manual\", {PLAIN}");
            let shader =
                lamp.shadow("exponential_variance_shadow", &format!("\"minimum_variance\": {least:.9}"), &options);
            for height in [0.5, 0.1, 0.02] {
                let behind = (1.0 - (-80.0 * (lamp.depth(0.0) - lamp.depth(height))).exp()) / 80.0;
                // What float32 leaves of the variance of a single depth: 3 units of 2^-24, over the square of the slope.
                let noise = 3.0 / 16_777_216.0 / 6400.0;
                let leak = |variance: f64| variance / (variance + behind * behind);
                for value in umbra(lamp, height).look(&mut gpu, &shader) {
                    let (low, high) = (leak(least) * 0.998 - 2e-6, leak(least + noise) * 1.002 + 2e-6);
                    assert!((low..=high).contains(&value), "{lamp:?} {least} {height}: {value} {low} {high}");
                }
            }
        }
    }
}

/// The falling warp is least at the far plane, and variances there are differences of its squares: what devices take for
/// nothing, below 2^-126, must not be among them. Seen from afar, where a filter covers a part of the slope that counts.
#[test]
fn slopes_at_the_far_plane_stay_lit_under_both_warps() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu) {
        return;
    }
    // Close to the corner of the ground that is farthest from the sun, in pixels of up to 0.2 m.
    let view = View {
        position: DVec3::new(-2.0, 4.0, -2.0),
        target: DVec3::new(-6.0, 0.0, -6.0),
        up: DVec3::Y,
        half_height: 0.105,
        size: (12, 12),
    };
    let stage = Stage::new(vec![Item::plane([16.0, 16.0], DMat4::IDENTITY)], view);
    for falling in [5.0, 5.54, 10.0, 20.0, 40.0] {
        for sampling in ["taps", "manual"] {
            let options = format!("\"falling\": \"{falling}\", \"sampling\": \"{sampling}\"");
            let sun = "\"direction\": (-1, -1.6, -1)";
            let shader = light("directional_light", sun, "exponential_variance_shadow", "", &options);
            let values = stage.look(&mut gpu, &visibility(&shader));
            let least = values.into_iter().fold(1.0, f64::min);
            // Of a filter with deviation s, the mean lies c s^2 behind its middle under the warp: 1 - c^2 s^2 is left.
            let law = 1.0 - (falling * 0.02_f64).powi(2);
            assert!(least > law, "{falling} {sampling}: {least}");
        }
    }
}

/// A lamp low above a ground that runs through the far plane of its maps, from before to behind.
fn through_the_far_plane(lamp: &str, at: &str, shadow: &str, options: &str) -> (Stage, Compiled) {
    let view = View {
        position: DVec3::new(3.0, 1.5, 0.3),
        target: DVec3::new(6.0, 0.0, 0.0),
        up: DVec3::Y,
        half_height: 0.1,
        size: (160, 90),
    };
    let shader = visibility(&light(lamp, at, shadow, "", options));
    (Stage::new(vec![Item::plane([40.0, 40.0], DMat4::IDENTITY)], view), shader)
}

/// Maps that hold no depth beyond the far plane bend what runs through it; the receiver is bent as much.
#[test]
fn the_ground_stays_lit_where_a_range_ends() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu) {
        return;
    }
    let point = ("point_light", "\"position\": (0, 1, 0), \"range\": 6");
    let spot = ("spot_light", "\"position\": (0, 1, 0), \"direction\": (1, -0.15, 0), \"near\": 1, \"range\": 6");
    let mut dark = Vec::new();
    for (lamp, at) in [point, spot] {
        for (shadow, options) in [
            ("exponential_shadow", ""),
            ("exponential_shadow", "\"domain\": \"log\""),
            ("exponential_shadow", "\"metric\": \"radial\", \"mips\": \"off\""),
            ("exponential_shadow", "\"width\": \"15\", \"sampling\": \"manual\""),
            ("exponential_variance_shadow", ""),
            ("exponential_variance_shadow", "\"warps\": \"one\""),
            ("exponential_variance_shadow", "\"metric\": \"radial\", \"width\": \"15\""),
            ("exponential_variance_shadow", "\"metric\": \"zw\", \"sampling\": \"hardware\""),
            ("summed_area_shadow", ""),
            ("summed_area_soft_shadow", ""),
            ("moment_shadow", ""),
            ("variance_shadow", ""),
        ] {
            let (stage, shader) = through_the_far_plane(lamp, at, shadow, options);
            let least = stage.look(&mut gpu, &shader).into_iter().fold(1.0, f64::min);
            if least < 0.98 {
                dark.push(format!("{lamp} {shadow} {options}: {least}"));
            }
        }
    }
    assert!(dark.is_empty(), "{}", dark.join("\n"));
}

/// The edge of a plate under an occluder, with the ground behind both: pixels of the plate with what is in their filter.
fn receiver_edge(gpu: &mut Gpu, lamp: Lamp, shader: &Compiled, height: f64) -> Vec<(f64, Vec<(f64, f64)>)> {
    let plates = [Plate { height: 1.0, edge: 2.0, angle: 0.0 }, Plate { height, edge: 6.0, angle: 0.0 }];
    let truth = layers(lamp, &plates);
    let kernel = kernel(Weights::Box, 11);
    let middle = 3.0 * lamp.texel(height);
    let above = 0.5 * (1.0 + height);
    // Seen from between the two; the frame is measured on the plate.
    let mut view = View::down((middle, 0.0), above, 1.0, (120, 1));
    view.half_height = 6.0 * lamp.texel(height) / (above - height) / 120.0;
    let mut items = vec![Item::plane([16.0, 16.0], DMat4::IDENTITY)];
    items.extend(under(lamp, &plates, 4.0, (2, 1)).items.into_iter().skip(1));
    let stage = Stage::new(items, view);
    let values = stage.look(gpu, shader);
    let on_plate = |p: &DVec3| p.x < 5.9 * lamp.texel(height);
    let pixels = stage.on_plane(&values, DVec3::Y * height, DVec3::Y).filter(|(p, _)| on_plate(p));
    let seen = pixels.map(|(point, value)| {
        let at = (SIDE / 2.0 + point.x / lamp.texel(height), SIDE / 2.0);
        (value, truth.mix(&kernel, Taps::Bilinear, at).distribution())
    });
    seen.collect()
}

/// Behind the edge of a receiver lies something deeper, which every method but the four moments takes for light.
#[test]
fn receiver_edges_are_falsely_lit_as_the_formulas_say() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu) {
        return;
    }
    for lamp in Lamp::BOTH {
        for height in [0.8, 0.4] {
            let mut off = Vec::new();
            for method in &METHODS {
                let shader = method.shader(lamp, Weights::Box, 11);
                let (mut sum, mut count) = (0.0, 0.0);
                for (value, seen) in receiver_edge(&mut gpu, lamp, &shader, height) {
                    let [(occluder, dark), (receiver, _), (ground, behind)] = seen[..] else { panic!("{seen:?}") };
                    // Shares below float64's own rounding are none.
                    if behind < 1e-9 {
                        continue;
                    }
                    let expected = (method.value)(&seen, receiver);
                    let what = format!("{} {lamp:?} {height}: {value} is not {expected}, {seen:?}", method.name);
                    assert!((value - expected).abs() < 2.0 * STEP, "{what}");
                    // All lit as soon as the mean is not in front of the receiver.
                    if method.name == "VSM" && behind > dark * (receiver - occluder) / (ground - receiver) {
                        assert!(value > 1.0 - STEP, "{what}");
                    }
                    if behind > 0.01 && dark > 0.01 {
                        sum += (value - (1.0 - dark)).powi(2);
                        count += 1.0;
                    }
                }
                assert!(count > 20.0, "{count} pixels see all three");
                off.push((method.name, f64::sqrt(sum / count)));
            }
            let of = |name: &str| off.iter().find(|o| o.0 == name).expect("a method").1;
            assert!(of("MSM4") < STEP && of("MSM4") < of("EVSM4"), "{off:?}");
            assert!(of("EVSM4") < of("EVSM2") && of("EVSM4") < of("ESM") && of("ESM") > 0.2, "{off:?}");
        }
    }
}

/// Two occluders of any heights are exact under four moments; under two there is the bleeding of the variance bound.
#[test]
fn four_moments_are_exact_for_two_occluders() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu) {
        return;
    }
    let kernel = kernel(Weights::Box, 11);
    for lamp in Lamp::BOTH {
        let (four, two) = (Method::named("MSM4"), Method::named("VSM"));
        let (four, two) = (four.shader(lamp, Weights::Box, 11), two.shader(lamp, Weights::Box, 11));
        for (lower, between) in [(0.7, 4.0), (0.5, 2.0), (0.25, 5.0)] {
            let plates = [
                Plate { height: 1.0, edge: 3.0, angle: 0.0 },
                Plate { height: lower, edge: 3.0 + between, angle: 0.0 },
            ];
            let truth = layers(lamp, &plates);
            let stage = under(lamp, &plates, 24.0, (240, 1));
            let (values, bounds) = (stage.look(&mut gpu, &four), stage.look(&mut gpu, &two));
            let lit: Vec<f64> =
                stage.on_ground(&values).map(|(p, _)| truth.lit(&kernel, Taps::Bilinear, lamp.at(p))).collect();
            let off = |all: &[f64]| all.iter().zip(&lit).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off(&values) < 2.0 * STEP, "{lamp:?} {lower}: {}", off(&values));
            assert!(off(&bounds) > 0.02, "{lamp:?} {lower}: {}", off(&bounds));
        }
    }
}
