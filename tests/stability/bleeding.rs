//! Light that bleeds through several occluders, and what its cure costs.

use shadetree::reference::{Taps, Weights, edge_visibility, kernel, reduce_bleeding, worst_bleeding};
use shadetree::render::Gpu;

use super::bench::{Numbers, look_with, most};
use super::table::{Bound, Table};
use crate::laws::lamp::{CLOSED_FORM, Lamp, PLAIN, Plate, SIDE, layers, under, vsm};
use crate::stage::gpu;

/// What samplers elsewhere may do.
pub(super) const WEIGHTS: (f64, &str) = (1.0 / 255.0, "samplers may round their weights to 1/256");

/// The most light in the full shadow of a plate at 1 m over another that is `spread` times as far below it as above the
/// ground, at these amounts of bleeding reduction.
pub(super) fn in_full_shadow(gpu: &mut Gpu, spread: f64, amounts: &[f64]) -> Vec<f64> {
    let shader = vsm(Lamp::Sun, "box", 11, PLAIN);
    let upper = Plate { height: 1.0, edge: 3.0, angle: 0.0 };
    // The lower plate reaches so far that no kernel around the upper edge leaves it.
    let lower = Plate { height: 1.0 / (1.0 + spread), edge: 43.0, angle: 0.0 };
    let mut stage = under(Lamp::Sun, &[upper, lower], 16.0, (480, 2));
    amounts.iter().map(|a| most(&look_with(&mut stage, gpu, &shader, "bleeding_reduction", *a))).collect()
}

#[test]
fn bleeding_grows_with_the_spread_of_occluders() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "bleeding",
        "Two plates over the ground in parallel light from above, box blur of 11 texels, most light in full shadow.\nr: distance between the plates over that of the lower one from the ground.",
        WEIGHTS,
        (5e-4, 0.0),
    );
    for spread in [0.25, 0.5, 1.0, 1.474, 2.0, 4.0, 8.0] {
        let measured = in_full_shadow(&mut gpu, spread, &[0.0, 0.18]);
        let worst = worst_bleeding(spread);
        let bound = Bound::Near(worst, CLOSED_FORM);
        table.wide(format!("r {spread}"), "T3: (r / (r + 2))^2", measured[0], bound);
        let law = "T3, T2: none up to r = 1.474";
        // The remap stretches errors, too.
        let bound = Bound::Near(reduce_bleeding(worst, 0.18), CLOSED_FORM / 0.82);
        table.wide(format!("r {spread}, reduction 0.18"), law, measured[1], bound);
    }
    table.check(&gpu);
}

/// The most that an amount of reduction takes from the edge of one plate, where nothing bleeds.
pub(super) fn loss(gpu: &mut Gpu, amount: f64) -> f64 {
    let shader = vsm(Lamp::Sun, "box", 11, PLAIN);
    let mut stage = under(Lamp::Sun, &[Plate { height: 1.0, edge: 4.0, angle: 0.0 }], 16.0, (320, 2));
    let values = look_with(&mut stage, gpu, &shader, "bleeding_reduction", amount);
    let kernel = kernel(Weights::Box, 11);
    let truth = |x: f64| edge_visibility(&kernel, x - SIDE / 2.0 - 4.0);
    most(&stage.on_ground(&values).map(|(p, v)| truth(Lamp::Sun.at(p).0) - v).collect::<Vec<_>>())
}

#[test]
fn reduction_darkens_edges_by_at_most_its_amount() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "reduction",
        "The edge of one plate over the ground, where nothing bleeds: most darkening by bleeding reduction.",
        WEIGHTS,
        (5e-4, 0.0),
    );
    for amount in [0.0, 0.1, 0.18, 0.3, 0.5] {
        let measured = loss(&mut gpu, amount);
        // Pixels lie 1/20 texel apart on a ramp of 11 texels, and right at p = a the loss has a corner.
        let grid = 1.0 / 20.0 / 11.0 / 2.0;
        let bound = Bound::Near(amount, grid + CLOSED_FORM / (1.0 - amount));
        table.wide(format!("reduction {amount}"), "T2b: at most a, where p = a", measured, bound);
    }
    table.check(&gpu);
}

/// Plates at random, each with an edge of its own.
fn scene(numbers: &mut Numbers) -> Vec<Plate> {
    let count = 2 + usize::from(numbers.within(0.0, 1.0) > 0.4) + usize::from(numbers.within(0.0, 1.0) > 0.7);
    let first = numbers.within(-3.2, 3.1);
    (0..count)
        .map(|i| Plate {
            height: if i == 0 { 1.0 } else { numbers.within(0.2, 0.95) },
            edge: numbers.within(-6.0, 6.0),
            angle: if i == 0 { first } else { first + numbers.within(-0.7, 0.7) },
        })
        .collect()
}

/// What scenes drawn at random say about the bound.
pub(super) struct Drawn {
    /// Largest distance of the bound from the affine law.
    pub(super) law: f64,
    /// Largest distance from the truth of the pixel that bleeds most in each scene, with the amount that cures it.
    pub(super) cured: f64,
    /// Most that the bound is below the truth, and above it.
    pub(super) below: f64,
    pub(super) above: f64,
    pub(super) pixels: usize,
}

pub(super) fn random_scenes(gpu: &mut Gpu, count: u64) -> Drawn {
    let shader = vsm(Lamp::Sun, "box", 11, PLAIN);
    let kernel = kernel(Weights::Box, 11);
    let mut drawn = Drawn { law: 0.0, cured: 0.0, below: 0.0, above: 0.0, pixels: 0 };
    for seed in 0..count {
        let plates = scene(&mut Numbers(seed));
        let truth = layers(Lamp::Sun, &plates);
        let mut stage = under(Lamp::Sun, &plates, 20.0, (14, 10));
        let bounds = look_with(&mut stage, gpu, &shader, "bleeding_reduction", 0.0);
        // Cure, pixel and bleeding of the worst.
        let mut worst = (0.0, 0, 0.0);
        for (i, (point, bound)) in stage.on_ground(&bounds).enumerate() {
            let at = Lamp::Sun.at(point);
            // Rasterisers place vertices on a grid of 1/256 texel: texels that near an edge may go either way.
            if truth.margin(at.0, at.1, 6) < 0.006 {
                continue;
            }
            let mix = truth.mix(&kernel, Taps::Bilinear, at);
            let bleeds = mix.bound() - mix.lit();
            drawn.law = drawn.law.max((bound - mix.bound()).abs());
            drawn.below = drawn.below.max(mix.lit() - bound);
            drawn.above = drawn.above.max(bound - mix.lit());
            drawn.pixels += 1;
            if mix.cure() < 0.9 && bleeds > worst.2 {
                worst = (mix.cure(), i, bleeds);
            }
        }
        let (amount, pixel, _) = worst;
        let reduced = look_with(&mut stage, gpu, &shader, "bleeding_reduction", amount)[pixel];
        let at = Lamp::Sun.at(stage.on_ground(&bounds).nth(pixel).expect("a pixel").0);
        drawn.cured = drawn.cured.max((reduced - truth.lit(&kernel, Taps::Bilinear, at)).abs());
    }
    drawn
}

#[test]
fn the_affine_law_holds_over_scenes_drawn_at_random() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "random_scenes",
        "50 scenes of two to four plates with edges at random heights, places and angles; box blur of 11 texels.",
        WEIGHTS,
        (2e-3, 0.0),
    );
    let Drawn { law, cured, above, below, pixels } = random_scenes(&mut gpu, 50);
    assert!(pixels > 50 * 50, "{pixels} pixels");
    let (affine, cure) = ("T1: p_max = (p + q) / (1 + q)", "T2: a = q / (1 + q) gives p");
    table.wide("largest |p_max - law|", affine, law, Bound::Most(2.0 / 255.0));
    table.wide("largest |cured - p|, worst pixel of each scene", cure, cured, Bound::Most(2.0 / 255.0));
    table.wide("most below the truth", "p_max >= p", below, Bound::Most(CLOSED_FORM));
    table.row("most above the truth", "light bleeds", above, Bound::Least(0.3));
    table.check(&gpu);
}
