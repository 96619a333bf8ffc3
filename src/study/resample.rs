//! How sure a number is that was computed from medians: the percentile bootstrap (Efron 1979), with the same random numbers
//! in every run.

use super::statistics::median;

/// Share of resamples that an interval holds.
pub const CONFIDENCE: f64 = 0.95;
/// How often samples are drawn anew.
const RESAMPLES: usize = 1000;
/// Fewest resamples, where there are very many samples.
const LEAST: usize = 100;
/// Most samples that are drawn for one interval: bounds the time that a large folder can ask for.
const MOST_DRAWN: usize = 20_000_000;

/// Random numbers by `SplitMix64` (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `count`, which is not 0.
    fn below(&mut self, count: usize) -> usize {
        // The high half of a product is as even as 2^64 / count allows.
        ((u128::from(self.next()) * count as u128) >> 64) as usize
    }
}

/// Where the results of `of` lie when each group of samples is drawn again from itself: for each result its lower and
/// upper end. `of` is given the median of each group and answers with as many numbers each time; where one is no number,
/// its interval is what the others leave.
pub fn intervals(groups: &[&[f64]], of: impl Fn(&[f64]) -> Vec<f64>) -> Vec<(f64, f64)> {
    if groups.iter().any(|g| g.is_empty()) {
        return Vec::new();
    }
    let drawn: usize = groups.iter().map(|g| g.len()).sum();
    let count = (MOST_DRAWN / drawn.max(1)).clamp(LEAST, RESAMPLES);
    let mut random = Random(0x5eed);
    let mut all: Vec<Vec<f64>> = Vec::new();
    let mut again = Vec::new();
    for _ in 0..count {
        let medians: Vec<f64> = groups
            .iter()
            .map(|group| {
                again.clear();
                again.extend((0..group.len()).map(|_| group[random.below(group.len())]));
                median(&again)
            })
            .collect();
        for (i, result) in of(&medians).into_iter().enumerate() {
            if all.len() <= i {
                all.push(Vec::with_capacity(count));
            }
            if result.is_finite() {
                all[i].push(result);
            }
        }
    }
    all.into_iter().map(ends).collect()
}

/// The ends of the middle [`CONFIDENCE`] of numbers.
fn ends(mut results: Vec<f64>) -> (f64, f64) {
    results.sort_by(f64::total_cmp);
    let Some(last) = results.len().checked_sub(1) else { return (f64::NAN, f64::NAN) };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below the count")]
    let cut = (results.len() as f64 * (1.0 - CONFIDENCE) / 2.0).floor() as usize;
    (results[cut.min(last)], results[last - cut.min(last)])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Even noise of this width around a value.
    fn noisy(seed: u64, value: f64, width: f64, count: usize) -> Vec<f64> {
        let mut random = Random(seed);
        (0..count).map(|_| value + width * (random.below(10_001) as f64 / 10_000.0 - 0.5)).collect()
    }

    #[test]
    fn most_intervals_hold_the_true_value() {
        let inside = |seed: u64| {
            let (a, b) = (noisy(seed, 6.0, 2.0, 31), noisy(seed + 1000, 3.0, 1.0, 31));
            let ends = intervals(&[&a, &b], |m| vec![m[0] / m[1]]);
            ends[0].0 <= 2.0 && 2.0 <= ends[0].1
        };
        let held = (0..100).filter(|seed| inside(*seed)).count();
        assert!((88..=100).contains(&held), "{held} of 100");
    }

    #[test]
    fn more_noise_is_less_sure_and_every_run_is_the_same() {
        let width = |noise: f64| {
            let samples = noisy(7, 5.0, noise, 31);
            let (low, high) = intervals(&[&samples], |m| vec![m[0]])[0];
            assert_eq!(intervals(&[&samples], |m| vec![m[0]]), [(low, high)]);
            high - low
        };
        assert!(width(0.0) == 0.0 && width(0.1) < width(1.0) && width(1.0) < 1.0);
        assert_eq!(intervals(&[&[]], |m| vec![m[0]]), []);
        let nothing = intervals(&[&[1.0]], |_| vec![f64::NAN]);
        assert!(nothing[0].0.is_nan());
    }
}
