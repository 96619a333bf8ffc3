//! Filter kernels as functions of the distance in texels, for maps that are finer than the one that they belong to.

use super::kernel::edge_visibility;
use super::layers::Taps;

/// The part of a filter below `x` texels from its middle, along one axis: it rises from 0 to 1 as `x` does.
///
/// A tap that reads the nearest texel weighs each place of that texel alike, so the kernel is one of boxes; one that
/// blends four texels weighs places by the tent that blends them. What the map shows of an edge that runs along texels
/// depends on where between them it runs; this is the mean over all such places.
pub fn filter_below(kernel: &[f64], taps: Taps, x: f64) -> f64 {
    match taps {
        Taps::Nearest => edge_visibility(kernel, x),
        Taps::Bilinear => {
            let middle = (kernel.len() as f64 - 1.0) / 2.0;
            kernel.iter().enumerate().map(|(i, w)| w * below_tent(x + i as f64 - middle)).sum()
        }
    }
}

/// The part below `x` of a tent from -1 to 1.
fn below_tent(x: f64) -> f64 {
    let beyond = 1.0 - x.abs().min(1.0);
    let part = beyond * beyond / 2.0;
    if x < 0.0 { part } else { 1.0 - part }
}

/// How far a filter of a kernel with `width` texels reaches from its middle, in texels.
pub(super) fn reach(width: usize, taps: Taps) -> f64 {
    width as f64 / 2.0 + if taps == Taps::Bilinear { 0.5 } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::super::{Weights, kernel};
    use super::*;

    #[test]
    fn filters_rise_from_nothing_to_all_within_their_reach() {
        for (name, weights) in Weights::ALL {
            for width in [1, 3, 5, 9] {
                for taps in [Taps::Nearest, Taps::Bilinear] {
                    let kernel = kernel(weights, width);
                    let end = reach(width, taps);
                    let below = |x: f64| filter_below(&kernel, taps, x);
                    assert!(below(-end).abs() < 1e-12 && (below(end) - 1.0).abs() < 1e-12, "{name} {width} {taps:?}");
                    assert!(below(-end + 0.01) > 0.0 && below(end - 0.01) < 1.0, "{name} {width} {taps:?}");
                    let rising: Vec<f64> = (-60..=60).map(|i| below(f64::from(i) * 0.1)).collect();
                    assert!(rising.is_sorted() && (below(0.0) - 0.5).abs() < 1e-12, "{name} {width} {taps:?}");
                }
            }
        }
    }

    /// Blended taps see an edge along texels as it is snapped to them; the mean over where it runs is the tent's part.
    #[test]
    fn the_tent_is_the_mean_over_all_places_of_the_edge() {
        for (_, weights) in Weights::ALL {
            let kernel = kernel(weights, 5);
            for x in [-2.7, -1.0, 0.0, 0.4, 2.2] {
                let steps = 4000;
                let place = |i: i32| (f64::from(i) + 0.5) / f64::from(steps) - 0.5;
                let mean = (0..steps).map(|i| edge_visibility(&kernel, x + place(i))).sum::<f64>() / f64::from(steps);
                assert!((mean - filter_below(&kernel, Taps::Bilinear, x)).abs() < 1e-6, "{x}");
            }
        }
    }
}
