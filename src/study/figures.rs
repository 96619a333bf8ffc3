//! Numbers as people read them.

/// Three significant digits, without a needless point; powers of ten from a million up and a ten-thousandth down.
pub fn figure(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    if !x.is_finite() {
        return "-".into();
    }
    let size = x.abs();
    if !(1e-4..1e6).contains(&size) {
        return format!("{x:.2e}");
    }
    // After rounding, so that 9.996 is 10.0 and not 10.00.
    let rounded: f64 = format!("{size:.2e}").parse().unwrap_or(size);
    let places = (0..=6).rev().find(|p| rounded < 10f64.powi(3 - p)).unwrap_or(0);
    format!("{x:.*}", usize::try_from(places).unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits_are_kept() {
        let cases = [
            (0.0, "0"),
            (1.0, "1.00"),
            (9.996, "10.0"),
            (12.34, "12.3"),
            (-123.4, "-123"),
            (1234.5, "1234"),
            (0.012_345, "0.0123"),
            (0.000_123_4, "0.000123"),
            (0.000_012_3, "1.23e-5"),
            (2_500_000.0, "2.50e6"),
            (f64::NAN, "-"),
        ];
        for (x, text) in cases {
            assert_eq!(figure(x), text, "{x}");
        }
    }
}
