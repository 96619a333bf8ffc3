//! Numbers about numbers: medians and their spread, fits, and intervals by resampling.

/// Factor from the median absolute deviation to the standard deviation of a normal distribution.
const MAD_TO_SIGMA: f64 = 1.4826;
/// Sigmas from the median beyond which a sample is marked as an outlier. It is kept all the same.
const OUTLIER: f64 = 3.5;

/// Where samples lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Spread {
    /// Half of the samples are below.
    pub median: f64,
    /// Median of the distances from the median.
    pub mad: f64,
    /// The least sample.
    pub min: f64,
    /// The greatest.
    pub max: f64,
    /// How many there are.
    pub count: usize,
    /// How many lie far from the median; they are counted in everything else.
    pub outliers: usize,
}

impl Spread {
    /// The spread of samples; none where there are none, or where one is no number.
    pub fn of(samples: &[f64]) -> Option<Self> {
        if samples.is_empty() || samples.iter().any(|s| !s.is_finite()) {
            return None;
        }
        let median = median(samples);
        let distances: Vec<f64> = samples.iter().map(|s| (s - median).abs()).collect();
        let mad = self::median(&distances);
        let far = |distance: &&f64| **distance > OUTLIER * MAD_TO_SIGMA * mad && mad > 0.0;
        Some(Self {
            median,
            mad,
            min: samples.iter().copied().fold(f64::INFINITY, f64::min),
            max: samples.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            count: samples.len(),
            outliers: distances.iter().filter(far).count(),
        })
    }
}

/// The middle of the samples, or of the two in the middle; NaN of none.
pub fn median(samples: &[f64]) -> f64 {
    let mut sorted = samples.to_vec();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => sorted[n / 2],
        n => f64::midpoint(sorted[n / 2 - 1], sorted[n / 2]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_is_told_by_its_middle_and_keeps_what_lies_far() {
        let spread = Spread::of(&[1.0, 2.0, 3.0, 4.0, 100.0]).expect("samples");
        assert_eq!((spread.median, spread.mad, spread.min, spread.max), (3.0, 1.0, 1.0, 100.0));
        assert_eq!((spread.count, spread.outliers), (5, 1));
        assert_eq!(Spread::of(&[]), None);
        assert_eq!(Spread::of(&[1.0, f64::NAN]), None);
        assert_eq!(median(&[4.0, 1.0]), 2.5);
    }
}
