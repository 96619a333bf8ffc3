//! Exponential warps: contacts, several occluders, what lies behind a receiver, and what 16 bits hold of them.

use glam::DVec3;
use shadetree::compile::Compiled;
use shadetree::reference::{
    Weights, chebyshev, edge_visibility, exponential, hamburger, kernel, signed_moments, warped_bound, worst_bleeding,
    worst_warped_bleeding,
};
use shadetree::render::Gpu;

use super::bench::{most, single_precision};
use super::bleeding::WEIGHTS;
use super::table::{Bound, Table, figure};
use crate::laws::lamp::{CLOSED_FORM, Lamp, PLAIN, Plate, SIDE, under};
use crate::stage::{Stage, gpu, skipped};

/// Whether the adapter makes maps of single precision; says so if not.
pub(super) fn able(gpu: &Gpu) -> bool {
    let able = single_precision(gpu);
    if !able {
        skipped(&format!("{} has no maps of 32-bit floats", gpu.adapter()));
    }
    able
}

fn shader(kind: &str, params: &str, options: &str) -> Compiled {
    Lamp::Spot.shadow(kind, params, &format!("\"sampling\": \"manual\", {options}, {PLAIN}"))
}

/// In full shadow, `gap` ranges of the light under a plate.
pub(super) fn umbra(gap: f64) -> Stage {
    let mut stage = under(Lamp::Spot, &[Plate { height: gap * 4.0, edge: 60.0, angle: 0.0 }], 4.0, (16, 2));
    stage.view.position.x = 0.0;
    stage.view.target.x = 0.0;
    stage
}

#[test]
fn exponentials_leak_where_occluders_come_close() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu) {
        return;
    }
    let mut table = Table::new(
        "exponential_contact",
        "Full shadow under a plate at a gap, in ranges of the light, by exponential and exponential variance shadows.\nLight leaks through the first up to 5.54 / c of the range, where 1/255 is left.",
        (0.0, ""),
        (1e-3, 0.0),
    );
    for exponent in [80.0_f64, 20.0, 11.0] {
        let esm = shader("exponential_shadow", "", &format!("\"exponent\": \"{exponent}\""));
        for gap in [0.2_f64, 5.54 / 80.0, 0.02, 0.005] {
            let law = (-exponent * gap).exp();
            // Depth is known to 1e-6, which the exponential stretches.
            let bound = Bound::Near(law, 1e-4 + law * exponent * 2e-6);
            let setting = format!("ESM c {exponent}, gap {}", figure(gap));
            table.row(setting, "T6: e^(-c gap)", most(&umbra(gap).look(&mut gpu, &esm)), bound);
        }
    }
    let evsm = shader("exponential_variance_shadow", "", "\"warps\": \"two\"");
    for gap in [0.2_f64, 5.54 / 80.0, 0.02, 0.005] {
        // What the two warps make of the gap; the falling one stretches it.
        let (rising, falling) = ((1.0 - (-80.0 * gap).exp()) / 80.0, ((10.0 * gap).exp() - 1.0) / 10.0);
        let law = |e: f64| e / (e + rising.max(falling).powi(2));
        // Rounding of the falling warp's square, over the square of its slope.
        let noise = 3.0 / 16_777_216.0 / 100.0;
        let bound = Bound::Near(law(1e-8), law(1e-8 + noise) - law(1e-8) + 1e-6);
        let setting = format!("EVSM4 c 40, gap {}", figure(gap));
        let measured = most(&umbra(gap).look(&mut gpu, &evsm));
        table.row(setting, "T10 in the better warp", measured, bound);
    }
    table.check(&gpu);
}

#[test]
fn a_warp_bounds_bleeding_by_the_gap_alone() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu) {
        return;
    }
    let mut table = Table::new(
        "warped_bleeding",
        "A plate at a quarter of a spotlight's range above the ground, and one below it at a gap; box blur of 11 texels,\none warp without minimum variance: most light in full shadow. The bound does not depend on the upper plate.",
        WEIGHTS,
        (1e-3, 0.0),
    );
    for exponent in ["40", "5.54"] {
        let c: f64 = exponent.parse().expect("a number");
        let options =
            format!("\"warps\": \"one\", \"exponent\": \"{exponent}\", \"width\": \"11\", \"weights\": \"box\"");
        let shader = shader("exponential_variance_shadow", "\"minimum_variance\": 0", &options);
        for gap in [0.02, 0.05, 0.1, 0.2] {
            let upper = Plate { height: 1.0, edge: 3.0, angle: 0.0 };
            let lower = Plate { height: gap * 4.0, edge: 43.0, angle: 0.0 };
            let measured = most(&under(Lamp::Spot, &[upper, lower], 16.0, (480, 2)).look(&mut gpu, &shader));
            let spread = (1.0 - (-2.0 * c * (0.25 - gap)).exp()) / ((2.0 * c * gap).exp() - 1.0);
            let what = format!("c {exponent}, gap {gap}");
            table.wide(
                format!("{what}: light"),
                "T3, T5",
                measured,
                Bound::Near(worst_bleeding(spread), 4.0 * CLOSED_FORM),
            );
            let bound = worst_warped_bleeding(c, gap) + 4.0 * CLOSED_FORM;
            table.wide(format!("{what}: at most"), "T5: 1 / (2 e^(2 c gap) - 1)^2", measured, Bound::Most(bound));
        }
    }
    table.check(&gpu);
}

/// Visibility from what is in the filter, as depths and shares, and the receiver's depth.
type Formula = fn(&[(f64, f64)], f64) -> f64;

const FORMULAS: [(&str, &str, &str, &str, Formula); 5] = [
    ("VSM", "variance_shadow", "\"bleeding_reduction\": 0", "\"slope_variance\": \"off\"", |seen, t| {
        let mean = |power| seen.iter().map(|(z, share): &(f64, f64)| share * z.powi(power)).sum::<f64>();
        chebyshev(mean(1), mean(2), t, 1e-6)
    }),
    ("ESM c 80", "exponential_shadow", "", "\"exponent\": \"80\"", |seen, t| exponential(seen, t, 80.0)),
    ("EVSM2 c 40", "exponential_variance_shadow", "", "\"warps\": \"one\"", |seen, t| {
        warped_bound(seen, t, 40.0, 1e-8)
    }),
    ("EVSM4 c 40, 5", "exponential_variance_shadow", "", "\"warps\": \"two\"", |seen, t| {
        warped_bound(seen, t, 40.0, 1e-8).min(warped_bound(seen, t, -5.0, 1e-8))
    }),
    ("MSM4", "moment_shadow", "\"bleeding_reduction\": 0, \"slope_bias\": 0", "\"mips\": \"off\"", |seen, t| {
        hamburger(signed_moments(seen, 3e-7, 0.375), 2.0 * t - 1.0)
    }),
];

#[test]
fn what_lies_behind_a_receiver_counts_as_light() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu) {
        return;
    }
    let mut table = Table::new(
        "receiver_edge",
        "The edge of a plate over a ground that does not cast, so that a share p of the filter sees the far plane, a quarter\nof the range behind: root mean square of visibility less p, and the largest distance from each method's own formula.",
        WEIGHTS,
        (2e-3, 0.0),
    );
    let kernel = kernel(Weights::Box, 11);
    for (name, kind, params, options, formula) in FORMULAS {
        let mips = if kind == "moment_shadow" { "" } else { options };
        let options =
            format!("\"width\": \"11\", \"weights\": \"box\"{}{mips}", if mips.is_empty() { "" } else { ", " });
        let mut stage = under(Lamp::Spot, &[Plate { height: 1.0, edge: 4.0, angle: 0.0 }], 14.0, (280, 2));
        stage.items[0].casts = false;
        let values = stage.look(&mut gpu, &shader(kind, params, &options));
        let (near, receiver) = (Lamp::Spot.depth(1.0), Lamp::Spot.depth(0.0));
        let share = |p: DVec3| edge_visibility(&kernel, Lamp::Spot.at(p).0 - SIDE / 2.0 - 4.0);
        let pixels: Vec<(f64, f64)> = stage.on_ground(&values).map(|(p, v)| (share(p), v)).collect();
        let rms = |of: &dyn Fn(f64, f64) -> f64| {
            (pixels.iter().map(|(p, v)| of(*p, *v).powi(2)).sum::<f64>() / pixels.len() as f64).sqrt()
        };
        let law = |p: f64| formula(&[(near, 1.0 - p), (1.0, p)], receiver);
        let expected = rms(&|p, _| law(p) - p);
        let bound = Bound::Near(expected, 2.0 / 255.0);
        table.wide(format!("{name}: error"), "T13: of the formula", rms(&|p, v| v - p), bound);
        // Where a formula jumps from one branch to another, a rounding of p decides.
        let smooth = |p: f64| (law((p + 1e-4).min(1.0)) - law((p - 1e-4).max(0.0))).abs() < 0.05;
        let off: Vec<f64> = pixels.iter().filter(|(p, _)| smooth(*p)).map(|(p, v)| (v - law(*p)).abs()).collect();
        table.wide(format!("{name}: from its formula"), "the formula", most(&off), Bound::Most(2.0 / 255.0));
    }
    table.check(&gpu);
}

/// Of exponentials in 16 bits with an exponent that is asked for: values of the blurred map that are no numbers or too
/// large, its largest value, and the largest error at the edge of a plate.
fn halves(gpu: &mut Gpu, exponent: &str, width: u32) -> (f64, f64, f64) {
    let options = format!(
        "\"format\": \"float16\", \"exponent\": \"{exponent}\", \"width\": \"{width}\", \"weights\": \"box\", {PLAIN}"
    );
    let shader = Lamp::Spot.shadow("exponential_variance_shadow", "", &options);
    let mut stage = under(Lamp::Spot, &[Plate { height: 2.0, edge: 4.0, angle: 0.0 }], 16.0, (160, 2));
    // Where nothing is drawn, the map holds the far plane, whose exponential is the greatest.
    stage.items[0].casts = false;
    let map = gpu.map(&stage.job(&shader), "light/lamp", 0).expect("renders");
    stage.items[0].casts = true;
    let all: Vec<f64> = map.pixels.iter().flat_map(|t| t[..map.channels].iter().map(|x| f64::from(*x))).collect();
    let strange = all.iter().filter(|x| !x.is_finite() || x.abs() >= 65504.0).count();
    let kernel = kernel(Weights::Box, width as usize);
    let values = stage.look(gpu, &shader);
    let off = stage
        .on_ground(&values)
        .map(|(p, v)| (v - edge_visibility(&kernel, Lamp::Spot.at(p).0 - SIDE / 2.0 - 4.0)).abs());
    (strange as f64, most(&all), off.fold(0.0, f64::max))
}

#[test]
fn exponentials_of_16_bits_do_not_overflow_in_the_blur() {
    let Some(mut gpu) = gpu() else { return };
    let able =
        gpu.adapter().formats.iter().any(|(name, able)| name == "rgba16float" && able.renderable && able.filterable);
    if !able {
        return skipped("no maps of 16-bit floats");
    }
    let mut table = Table::new(
        "half_overflow",
        "The edge of a plate half the range above the ground, exponential variance in 16 bits: values of the blurred map that\nreach 65504 or are no numbers, and the largest value, with nothing beside the plate; the largest error over a ground.\ne^(2 c) is held below 65504 by c <= 5.54, and weights that sum to 1 keep the blur there; greater exponents are not\ngiven.",
        (0.01, "half floats round as the device likes; lavapipe truncates them"),
        (5e-3, 0.02),
    );
    for (exponent, width) in [("5.54", 1), ("5.54", 5), ("5.54", 25), ("10", 25), ("42", 25)] {
        let (strange, largest, off) = halves(&mut gpu, exponent, width);
        let what = format!("c {exponent} asked for, blur {width}");
        table.row(format!("{what}: overflown"), "none", strange, Bound::Most(0.0));
        // The node stores the far plane as 240, whose square is exact in half floats and less than e^(2 c). Halves there lie
        // 32 apart; truncation may take one of them at each of three stores.
        table.wide(format!("{what}: largest"), "240^2 < e^(2 c)", largest, Bound::Near(240.0 * 240.0, 96.0));
        // The contact law at a gap of half the range with the node's own minimum variance of 3e-5, and the rounding of
        // mean and square that lavapipe truncates after each of two blurs: 2^-10 of values, thrice.
        let warped = (1.0 - (-11.08_f64 * 0.5).exp()) / 11.08;
        let leak = 3e-5 / (3e-5 + warped * warped) + 3.0 / 1024.0 * 3.0;
        table.wide(format!("{what}: error"), "T7, T10", off, Bound::Most(leak));
    }
    table.check(&gpu);
}
