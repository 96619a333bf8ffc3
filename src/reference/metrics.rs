//! How far a picture of visibility is from the truth.

/// Errors over pixels, on linear visibility. Positive differences are light where there is none.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Metrics {
    /// Pixels that were compared.
    pub pixels: usize,
    /// Root of the mean square.
    pub rms: f64,
    /// Mean difference: above 0 too much light, below 0 too much shadow.
    pub bias: f64,
    /// Greatest difference, without its sign.
    pub most: f64,
    /// Not exceeded by 99 of 100 pixels.
    pub percentile_99: f64,
    /// Share of pixels that are off by more than 1/255.
    pub over_step: f64,
    /// Share that is off by more than 0.05.
    pub over_twentieth: f64,
    /// Share that is lighter by more than 0.05: light that bleeds or leaks.
    pub false_lit: f64,
    /// Share that is darker by more than 0.05: acne and shadows that are too wide.
    pub false_dark: f64,
}

impl Metrics {
    /// Compares pairs of (value, truth).
    pub fn new(pairs: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let differences: Vec<f64> = pairs.into_iter().map(|(value, truth)| value - truth).collect();
        if differences.is_empty() {
            return Self::default();
        }
        let count = differences.len() as f64;
        let share = |of: &dyn Fn(f64) -> bool| differences.iter().filter(|d| of(**d)).count() as f64 / count;
        let mut sizes: Vec<f64> = differences.iter().map(|d| d.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        let last = sizes.len() - 1;
        Self {
            pixels: differences.len(),
            rms: (differences.iter().map(|d| d * d).sum::<f64>() / count).sqrt(),
            bias: differences.iter().sum::<f64>() / count,
            most: sizes[last],
            percentile_99: sizes[(last * 99).div_ceil(100)],
            over_step: share(&|d| d.abs() > 1.0 / 255.0),
            over_twentieth: share(&|d| d.abs() > 0.05),
            false_lit: share(&|d| d > 0.05),
            false_dark: share(&|d| d < -0.05),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_told_apart_by_size_and_sign() {
        let pairs = (0..100).map(|i| match i {
            0 => (1.0, 0.0),
            1 | 2 => (0.0, 0.1),
            _ => (0.5, 0.5),
        });
        let m = Metrics::new(pairs);
        assert_eq!((m.pixels, m.most, m.false_lit, m.false_dark), (100, 1.0, 0.01, 0.02));
        assert!((m.rms - (1.02_f64 / 100.0).sqrt()).abs() < 1e-12 && (m.bias - 0.008).abs() < 1e-12);
        assert!((m.percentile_99 - 1.0).abs() < 1e-12 && (m.over_step - 0.03).abs() < 1e-12);
        assert_eq!(Metrics::new([]), Metrics::default());
    }
}
