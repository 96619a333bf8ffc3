//! Variance shadow maps over planes (Donnelly and Lauritzen 2006): the bound, its laws and their cure.

/// The lit share that mean and mean square of depth allow at most, at the receiver's depth: Chebyshev's inequality in
/// its one-sided form, named after Cantelli. `least_variance` takes the place of smaller variances.
pub fn chebyshev(mean: f64, mean_square: f64, receiver: f64, least_variance: f64) -> f64 {
    if receiver <= mean {
        return 1.0;
    }
    let variance = (mean_square - mean * mean).max(least_variance);
    variance / (variance + (receiver - mean).powi(2))
}

/// Visibility with lit shares up to `amount` counted as dark and the rest stretched to [0, 1].
pub fn reduce_bleeding(visibility: f64, amount: f64) -> f64 {
    ((visibility - amount) / (1.0 - amount)).clamp(0.0, 1.0)
}

/// Most light that bleeds into full shadow where `spread` is the distance between the farthest and the nearest
/// occluder, in units of the distance from the farthest to the receiver; whatever the occluders between, and their
/// shares. Two occluders reach it when the nearer covers 1 / (spread + 2).
pub fn worst_bleeding(spread: f64) -> f64 {
    (spread / (spread + 2.0)).powi(2)
}

/// The spread up to which [`reduce_bleeding`] by `amount` leaves no light in full shadow: the inverse of
/// [`worst_bleeding`].
pub fn spread_cured_by(amount: f64) -> f64 {
    2.0 * amount.sqrt() / (1.0 - amount.sqrt())
}

/// What lies in a filter above a planar receiver: its depth, and the depth and share of each occluder. The rest of the
/// filter sees the receiver.
#[derive(Clone, Debug, PartialEq)]
pub struct Mix {
    /// Depth of the receiver.
    pub receiver: f64,
    /// Depth, less than the receiver's, and share of each occluder. Shares sum to at most 1.
    pub occluders: Vec<(f64, f64)>,
}

impl Mix {
    /// The true lit share.
    pub fn lit(&self) -> f64 {
        1.0 - self.occluders.iter().map(|(_, share)| share).sum::<f64>()
    }

    /// Everything in the filter: depths and their shares, the receiver's last.
    pub fn distribution(&self) -> Vec<(f64, f64)> {
        self.occluders.iter().copied().chain(std::iter::once((self.receiver, self.lit().max(0.0)))).collect()
    }

    /// Variance of the occluders alone, in squares of the distance from their mean to the receiver.
    pub fn relative_variance(&self) -> f64 {
        let covered = 1.0 - self.lit();
        if covered <= 0.0 {
            return 0.0;
        }
        let mean = self.occluders.iter().map(|(z, share)| z * share).sum::<f64>() / covered;
        let variance = self.occluders.iter().map(|(z, share)| (z - mean).powi(2) * share).sum::<f64>() / covered;
        variance / (self.receiver - mean).powi(2)
    }

    /// The bound that a variance shadow map gives, in closed form: affine in the true lit share p, (p + q) / (1 + q)
    /// with q the relative variance of the occluders. It is exact where there is one occluder, or none.
    pub fn bound(&self) -> f64 {
        let q = self.relative_variance();
        (self.lit() + q) / (1.0 + q)
    }

    /// The amount of [`reduce_bleeding`] that makes the bound the true lit share.
    pub fn cure(&self) -> f64 {
        let q = self.relative_variance();
        q / (1.0 + q)
    }

    /// Mean and mean square of depth over the filter.
    pub fn moments(&self) -> (f64, f64) {
        let receiver = (self.receiver, self.lit());
        let all = || self.occluders.iter().chain(std::iter::once(&receiver));
        (all().map(|(z, share)| z * share).sum(), all().map(|(z, share)| z * z * share).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn mixes() -> impl Strategy<Value = Mix> {
        let occluder = (0.01..0.99_f64, 0.01..1.0_f64);
        (proptest::collection::vec(occluder, 1..6), 0.02..1.0_f64, 0.0..2.0_f64).prop_map(|(raw, receiver, lit)| {
            let total = raw.iter().map(|(_, share)| share).sum::<f64>() + lit;
            Mix { receiver, occluders: raw.into_iter().map(|(z, share)| (z * receiver, share / total)).collect() }
        })
    }

    proptest! {
        /// The closed form is the bound on the moments; it is never below the truth, and the right amount cures it.
        #[test]
        fn the_bound_is_affine_in_the_lit_share(mix in mixes()) {
            let (mean, square) = mix.moments();
            let bound = chebyshev(mean, square, mix.receiver, 0.0);
            prop_assert!((bound - mix.bound()).abs() < 1e-7, "{bound} {}", mix.bound());
            prop_assert!(mix.bound() >= mix.lit() - 1e-12);
            prop_assert!((reduce_bleeding(mix.bound(), mix.cure()) - mix.lit()).abs() < 1e-9);
        }

        /// In full shadow the bound stays below the worst case of its spread.
        #[test]
        fn bleeding_is_bounded_by_the_spread(mix in mixes()) {
            let covered = 1.0 - mix.lit();
            let full: Vec<_> = mix.occluders.iter().map(|(z, share)| (*z, share / covered)).collect();
            let near = full.iter().map(|o| o.0).fold(f64::INFINITY, f64::min);
            let far = full.iter().map(|o| o.0).fold(0.0, f64::max);
            let spread = (far - near) / (mix.receiver - far);
            let dark = Mix { occluders: full, ..mix };
            prop_assert!(dark.bound() <= worst_bleeding(spread) + 1e-9);
        }
    }

    #[test]
    fn two_occluders_reach_the_worst_case() {
        for spread in [0.5, 1.0, 2.0, 8.0] {
            let share = 1.0 / (spread + 2.0);
            let mix = Mix { receiver: 1.0, occluders: vec![(0.9 - 0.1 * spread, share), (0.9, 1.0 - share)] };
            assert!((mix.bound() - worst_bleeding(spread)).abs() < 1e-12, "{spread}");
            assert!((spread_cured_by(worst_bleeding(spread)) - spread).abs() < 1e-12, "{spread}");
        }
        assert!((worst_bleeding(2.0) - 0.25).abs() < 1e-15 && (spread_cured_by(0.18) - 1.474).abs() < 1e-3);
    }
}
