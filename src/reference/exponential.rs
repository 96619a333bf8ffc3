//! Exponential shadow maps (Annen et al. 2008; Salvi 2008) and exponential variance shadow maps (Lauritzen and McCool
//! 2008) over planes. A distribution lists what a filter sees: depths and their shares, which sum to 1, the receiver's and
//! those behind it among them.

use super::chebyshev;

/// Visibility by the exponential alone: the mean of e^(c (z - t)), at most 1.
pub fn exponential(distribution: &[(f64, f64)], receiver: f64, c: f64) -> f64 {
    distribution.iter().map(|(z, share)| share * (c * (z - receiver)).exp()).sum::<f64>().min(1.0)
}

/// The bound on visibility from mean and variance of e^(c (2 z - 1)); with a negative c, of -e^(c (2 z - 1)), which rises
/// with depth as well. `least_variance` of depth itself is stretched by the slope of the warp at the receiver.
pub fn warped_bound(distribution: &[(f64, f64)], receiver: f64, c: f64, least_variance: f64) -> f64 {
    // Relative to the receiver's: bounds do not change with the scale.
    let warp = |z: f64| c.signum() * (2.0 * c * (z - receiver)).exp();
    let mean = distribution.iter().map(|(z, share)| share * warp(*z)).sum();
    let square = distribution.iter().map(|(z, share)| share * warp(*z).powi(2)).sum();
    chebyshev(mean, square, c.signum(), least_variance * (2.0 * c).powi(2))
}

/// Most light that bleeds into full shadow under one warp, where the farthest occluder lies `gap` above the receiver: a
/// nearer one cannot make more of it, however near the light it is.
pub fn worst_warped_bleeding(c: f64, gap: f64) -> f64 {
    (2.0 * (2.0 * c * gap).exp() - 1.0).recip().powi(2)
}

#[cfg(test)]
mod tests {
    use super::super::worst_bleeding;
    use super::*;

    #[test]
    fn one_occluder_leaks_by_its_gap_alone() {
        for (c, gap) in [(80.0_f64, 0.069_26), (11.0, 0.2)] {
            let leak = exponential(&[(0.5, 1.0)], 0.5 + gap, c);
            assert!((leak - (-c * gap).exp()).abs() < 1e-12, "{leak}");
        }
        assert!((exponential(&[(0.5, 1.0)], 0.569_26, 80.0) - 1.0 / 255.0).abs() < 1e-5);
        // A share of 0.1 that lies 0.05 behind the receiver makes up for a shadow of 0.9.
        assert!((exponential(&[(0.1, 0.9), (0.55, 0.1)], 0.5, 80.0) - 1.0).abs() < 1e-12);
    }

    /// The warped bound is the bound on two occluders with warped distances, and its worst case their limit.
    #[test]
    fn a_warp_turns_distances_into_exponentials() {
        for c in [5.54_f64, 40.0] {
            for gap in [0.005_f64, 0.02, 0.1] {
                for apart in [0.01, 0.3, 0.8] {
                    let spread = (1.0 - (-2.0 * c * apart).exp()) / ((2.0 * c * gap).exp() - 1.0);
                    let share = 1.0 / (spread + 2.0);
                    let farthest = 0.95 - gap;
                    let bound = warped_bound(&[(farthest - apart, share), (farthest, 1.0 - share)], 0.95, c, 0.0);
                    assert!((bound - worst_bleeding(spread)).abs() < 1e-9, "{c} {gap} {apart}: {bound}");
                    assert!(bound <= worst_warped_bleeding(c, gap) + 1e-12);
                }
            }
        }
        assert!((worst_warped_bleeding(42.0, 0.02) - 0.0106).abs() < 1e-4);
    }

    #[test]
    fn each_warp_is_exact_for_one_occluder() {
        for c in [40.0, -5.0] {
            for share in [0.1, 0.5, 0.9] {
                let bound = warped_bound(&[(0.3, share), (0.6, 1.0 - share)], 0.6, c, 0.0);
                assert!((bound - (1.0 - share)).abs() < 1e-9, "{c} {share}: {bound}");
            }
        }
    }
}
