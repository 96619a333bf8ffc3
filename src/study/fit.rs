//! Straight lines through points.

/// `a + b x`, by least squares, and how much of the variance of y it explains.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Fit {
    /// The value at x = 0.
    pub a: f64,
    /// The slope.
    pub b: f64,
    /// The share of the variance of y that the line explains, from 0 to 1: 1 where all points lie on it.
    pub r2: f64,
}

impl Fit {
    /// The line through points; none through fewer than two values of x.
    pub fn of(x: &[f64], y: &[f64]) -> Option<Self> {
        let n = x.len().min(y.len());
        if n < 2 {
            return None;
        }
        let mean = |v: &[f64]| v.iter().take(n).sum::<f64>() / n as f64;
        let (mx, my) = (mean(x), mean(y));
        let sum = |of: &dyn Fn(f64, f64) -> f64| x.iter().zip(y).map(|(x, y)| of(x - mx, y - my)).sum::<f64>();
        let (xx, xy, yy) = (sum(&|x, _| x * x), sum(&|x, y| x * y), sum(&|_, y| y * y));
        if xx <= 0.0 || !(xx + xy + yy).is_finite() {
            return None;
        }
        let b = xy / xx;
        // A level line through level points explains all that there is.
        let r2 = if yy > 0.0 { (xy * xy / (xx * yy)).min(1.0) } else { 1.0 };
        Some(Self { a: my - b * mx, b, r2 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_found_and_noise_is_told() {
        let fit = Fit::of(&[1.0, 2.0, 4.0], &[5.0, 7.0, 11.0]).expect("a line");
        assert!((fit.a - 3.0).abs() < 1e-12 && (fit.b - 2.0).abs() < 1e-12 && (fit.r2 - 1.0).abs() < 1e-12, "{fit:?}");
        // By hand: means 2 and 2, xx 2, xy 1, yy 2, so b = 1/2 and R^2 = 1/4.
        let noisy = Fit::of(&[1.0, 2.0, 3.0], &[2.0, 1.0, 3.0]).expect("a line");
        assert!((noisy.b - 0.5).abs() < 1e-12 && (noisy.r2 - 0.25).abs() < 1e-12, "{noisy:?}");
        assert_eq!(Fit::of(&[1.0, 1.0], &[1.0, 2.0]), None);
        assert_eq!(Fit::of(&[1.0], &[1.0]), None);
    }
}
