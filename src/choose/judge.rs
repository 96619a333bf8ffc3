//! What each method makes of the depths under its filter: its closed form in float64, with the rounding of its format.

use super::filter::Seen;
use crate::reference::{chebyshev, hamburger, reduce_bleeding, signed_moments};

/// How a texel's numbers are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Storage {
    /// 32 bits of floating point: exact to what matters here.
    Single,
    /// 16 bits of a whole number: moments of [0, 1] are off by up to 2^-17.
    Unorm,
}

/// How visibility follows from depths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Judge {
    /// The share that does not lie in front of the receiver's plane.
    Comparison,
    /// Chebyshev's bound from mean and variance of depth, with a least variance and a reduction of bleeding.
    Variance {
        /// In squares of the light's range.
        least: f64,
        /// Lit shares up to this count as dark.
        reduction: f64,
        /// Of the moments.
        storage: Storage,
    },
    /// The mean of e^(c (z - t)), at most 1.
    Exponential {
        /// c.
        exponent: f64,
    },
    /// Chebyshev's bound under e^(c (2 z - 1)), and perhaps under the falling warp as well.
    Warped {
        /// c.
        exponent: f64,
        /// The exponent of the falling warp; none where there is none.
        falling: Option<f64>,
        /// Least variance of depth, see `Variance`.
        least: f64,
        /// See `Variance`.
        reduction: f64,
    },
    /// The least shadow that four moments allow.
    Moments {
        /// See `Variance`.
        reduction: f64,
    },
    /// A search for occluders, then comparisons within the penumbra that they make: samples of each.
    Blockers {
        /// Samples of the search.
        search: u32,
        /// Samples of the filter.
        filter: u32,
    },
}

/// Part of the moments that is replaced by those of a wide distribution, the wide moment, and how far the receiver is moved
/// towards the light, in half widths of the blur along its slope: the defaults of moment shadows in 32 bits.
const MOMENT_BIAS: (f64, f64, f64) = (3e-7, 0.375, 1.0);

/// Visibility by the closed form, from what the filter of the method reads. Not for those that read for themselves.
pub fn lit(judge: Judge, seen: &Seen) -> f64 {
    let t = seen.receiver;
    let mean_of = |of: &dyn Fn(f64) -> f64| seen.samples.iter().map(|s| s.weight * of(s.depth)).sum::<f64>();
    match judge {
        Judge::Comparison => 1.0 - seen.samples.iter().filter(|s| s.dark).map(|s| s.weight).sum::<f64>(),
        Judge::Variance { least, reduction, storage } => {
            let (mut mean, mut square) =
                (mean_of(&|z| z), seen.samples.iter().map(|s| s.weight * (s.depth * s.depth + s.slope)).sum::<f64>());
            if storage == Storage::Unorm {
                (mean, square) = (unorm(mean), unorm(square.min(1.0)));
            }
            reduce_bleeding(chebyshev(mean, square, t.clamp(0.0, mean.max(1.0)), least), reduction)
        }
        Judge::Exponential { exponent } => {
            let mean = mean_of(&|z| (exponent * (z - 1.0)).exp());
            (mean / receiver_mean(exponent, t, seen.reach)).min(1.0)
        }
        Judge::Warped { exponent, falling, least, reduction } => {
            let bound = |rate: f64| {
                // Rises with depth whatever the sign of the rate.
                let warp = |z: f64| rate.signum() * (rate * (z - 1.0)).exp();
                // The slope within a texel is variance, stretched by that of the warp.
                let squared = |z: f64, slope: f64| warp(z).powi(2) * (1.0 + rate * rate * slope);
                let mean = mean_of(&warp);
                let square = seen.samples.iter().map(|s| s.weight * squared(s.depth, s.slope)).sum();
                let here = rate.signum() * receiver_mean(rate, t, seen.reach);
                chebyshev(mean, square, here, least * (rate * (rate * (t.clamp(0.0, 1.0) - 1.0)).exp()).powi(2))
            };
            let rising = bound(2.0 * exponent);
            let all = falling.map_or(rising, |c| rising.min(bound(-2.0 * c)));
            reduce_bleeding(all, reduction)
        }
        Judge::Moments { reduction } => {
            let depths: Vec<(f64, f64)> = seen.samples.iter().map(|s| (s.depth, s.weight)).collect();
            let (bias, wide, slope) = MOMENT_BIAS;
            let receiver = up_to_far(t, seen.reach) - slope * seen.reach;
            reduce_bleeding(hamburger(signed_moments(&depths, bias, wide), 2.0 * receiver - 1.0), reduction)
        }
        Judge::Blockers { .. } => 1.0,
    }
}

/// The nearest number of 16 bits.
fn unorm(x: f64) -> f64 {
    (x * 65_535.0).round() / 65_535.0
}

/// Mean of the lesser of depth and 1 where depth is spread evenly up to `reach` around `middle`.
fn up_to_far(middle: f64, reach: f64) -> f64 {
    let beyond = (middle + reach - 1.0).clamp(0.0, 2.0 * reach);
    (middle - beyond * beyond / (4.0 * reach).max(1e-9) - (middle - reach - 1.0).max(0.0)).clamp(0.0, 1.0)
}

/// The receiver's own e^(c (z - 1)), averaged over what of it lies beyond the far plane, as the nodes do.
fn receiver_mean(rate: f64, middle: f64, reach: f64) -> f64 {
    let warp = |z: f64| (rate * (z.clamp(0.0, 1.0) - 1.0)).exp();
    let alone = warp(middle);
    if (middle - 1.0).abs() >= reach || reach <= 1e-4 {
        return alone;
    }
    let mean = ((1.0 - warp(middle - reach)) / rate + (middle + reach - 1.0)) / (2.0 * reach);
    if rate > 0.0 { alone.min(mean) } else { alone.max(mean) }
}

#[cfg(test)]
mod tests {
    use super::super::filter::Sample;
    use super::*;

    /// A receiver at depth t under occluders, with the lit share `p` left to itself.
    fn seen(t: f64, occluders: &[(f64, f64)]) -> Seen {
        let sample = |depth: f64, weight: f64| Sample { weight, depth, slope: 0.0, dark: depth < t };
        let covered: f64 = occluders.iter().map(|o| o.1).sum();
        let mut samples: Vec<Sample> = occluders.iter().map(|(z, w)| sample(*z, *w)).collect();
        samples.push(sample(t, 1.0 - covered));
        Seen { samples, receiver: t, reach: 0.0, taps: 1.0 }
    }

    const VARIANCE: Judge = Judge::Variance { least: 1e-12, reduction: 0.0, storage: Storage::Single };
    const TWO_WARPS: Judge = Judge::Warped { exponent: 40.0, falling: Some(5.0), least: 1e-12, reduction: 0.0 };

    #[test]
    fn one_occluder_over_one_plane_is_exact() {
        for p in [0.0, 0.25, 0.5, 0.9] {
            let seen = seen(0.6, &[(0.4, 1.0 - p)]);
            for judge in [Judge::Comparison, VARIANCE, TWO_WARPS] {
                assert!((lit(judge, &seen) - p).abs() < 1e-6, "{judge:?} {p}: {}", lit(judge, &seen));
            }
            assert!((lit(Judge::Moments { reduction: 0.0 }, &seen) - p).abs() < 1e-3);
        }
    }

    /// Law T3: two occluders bleed at most (r / (r + 2))^2, and at a share of 1 / (r + 2) just that.
    #[test]
    fn bleeding_is_what_the_law_says() {
        for r in [0.5, 1.0, 2.0, 4.0] {
            let (gap, t) = (0.1, 0.9);
            let x = 1.0 / (r + 2.0);
            let seen = seen(t, &[(t - gap - r * gap, x), (t - gap, 1.0 - x)]);
            let law = (r / (r + 2.0)).powi(2);
            assert!((lit(VARIANCE, &seen) - law).abs() < 1e-6, "{r}: {} {law}", lit(VARIANCE, &seen));
            assert!(lit(TWO_WARPS, &seen) < 0.01, "warped depths hardly bleed at this gap");
            let exponential = lit(Judge::Exponential { exponent: 80.0 }, &seen);
            assert!(exponential < 2.0 * (-80.0 * gap).exp(), "{exponential}");
        }
    }

    /// Law T6 and T10: contacts leak by e^(-c d), and by e / (e + d^2).
    #[test]
    fn contacts_leak_as_the_laws_say() {
        for gap in [0.005, 0.02, 0.05] {
            let seen = seen(0.5, &[(0.5 - gap, 1.0)]);
            let found = lit(Judge::Exponential { exponent: 80.0 }, &seen);
            assert!((found - (-80.0 * gap).exp()).abs() < 1e-9);
            let least = 1e-5;
            let found = lit(Judge::Variance { least, reduction: 0.0, storage: Storage::Single }, &seen);
            assert!((found - least / (least + gap * gap)).abs() < 1e-9);
        }
    }

    /// Law T13: where a part of the filter lies behind the receiver, one warp is falsely lit, four moments are not.
    #[test]
    fn receiver_edges_light_up_one_warp() {
        let t = 0.5;
        let sample = |depth: f64, weight: f64| Sample { weight, depth, slope: 0.0, dark: depth < t };
        let samples = vec![sample(0.4, 0.6), sample(t, 0.2), sample(0.8, 0.2)];
        let seen = Seen { samples, receiver: t, reach: 0.0, taps: 1.0 };
        let one = Judge::Warped { exponent: 40.0, falling: None, least: 1e-12, reduction: 0.0 };
        assert!(lit(one, &seen) > 0.9, "{}", lit(one, &seen));
        assert!(lit(TWO_WARPS, &seen) < 0.8, "{}", lit(TWO_WARPS, &seen));
        assert!((lit(Judge::Moments { reduction: 0.0 }, &seen) - 0.4).abs() < 0.01);
    }

    #[test]
    fn sixteen_bits_leak_at_contacts() {
        let seen = seen(0.5, &[(0.497, 1.0)]);
        let of = |storage, least| lit(Judge::Variance { least, reduction: 0.0, storage }, &seen);
        assert!(of(Storage::Single, 1e-7) < 0.02);
        assert!(of(Storage::Unorm, 2e-5) > 0.5);
    }
}
