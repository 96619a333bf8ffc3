//! Boxes over a map, texel by texel, and what float32 makes of a table of sums (Crow 1984).

/// Mean of what is constant on each texel of a square map over a box around `center` with fractional sides, as far as it
/// lies on the map. `value` is asked for column and row.
pub fn box_mean(side: usize, value: impl Fn(usize, usize) -> f64, center: (f64, f64), size: (f64, f64)) -> f64 {
    let shares = |center: f64, width: f64| {
        let (low, high) = ((center - width / 2.0).max(0.0), (center + width / 2.0).min(side as f64));
        let texels = low.floor() as usize..(high.ceil() as usize).min(side);
        let share = move |i: usize| (high.min(i as f64 + 1.0) - low.max(i as f64)).max(0.0);
        texels.map(|i| (i, share(i))).collect::<Vec<(usize, f64)>>()
    };
    let (columns, rows) = (shares(center.0, size.0), shares(center.1, size.1));
    let (mut sum, mut area) = (0.0, 0.0);
    for (row, height) in &rows {
        for (column, width) in &columns {
            sum += width * height * value(*column, *row);
            area += width * height;
        }
    }
    sum / area
}

/// Additions that an entry of a table has gone through at most, when steps of recursive doubling add `factor` sums each.
pub fn table_additions(side: u32, factor: u32) -> u32 {
    let mut steps = 0;
    let mut reach = 1_u64;
    while reach < u64::from(side) {
        reach *= u64::from(factor);
        steps += 1;
    }
    2 * steps * (factor - 1)
}

/// What the mean over a box of `width` texels is off by at most, to first order, if the table is summed in float32 and
/// the texels are at most `largest`: each addition rounds by a part in 2^24 of a sum of at most side^2 largest, and the
/// four corners of the box are subtracted from each other.
pub fn float_mean_bound(side: u32, factor: u32, width: f64, largest: f64) -> f64 {
    let sum = f64::from(side).powi(2) * largest;
    4.0 * f64::from(table_additions(side, factor)) * sum / width.powi(2) / f64::from(1_u32 << 24)
}

/// What the variance over a box is off by at most if its mean, of size `mean`, and its mean square are off by
/// `mean_error` and `square_error`.
pub fn variance_bound(mean: f64, mean_error: f64, square_error: f64) -> f64 {
    square_error + 2.0 * mean.abs() * mean_error + mean_error * mean_error
}

/// What the mean of numbers rounded to `bits` digits after the binary point is off by at most, whatever the box.
pub fn whole_mean_bound(bits: u32) -> f64 {
    0.5_f64.powi(i32::try_from(bits).unwrap_or(i32::MAX).saturating_add(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_take_parts_of_texels_and_end_at_the_map() {
        let value = |x: usize, y: usize| (x + 10 * y) as f64;
        assert!((box_mean(8, value, (2.5, 3.5), (1.0, 1.0)) - 32.0).abs() < 1e-12);
        assert!((box_mean(8, value, (3.0, 3.5), (1.0, 1.0)) - 32.5).abs() < 1e-12);
        // Columns 1 (half), 2 and 3 (quarter) of row 0, of which the upper half is not there.
        let expected = (0.5 * 1.0 + 2.0 + 0.25 * 3.0) / 1.75;
        assert!((box_mean(8, value, (2.375, 0.0), (1.75, 1.0)) - expected).abs() < 1e-12);
        // All of it.
        assert!((box_mean(8, value, (1.0, 7.0), (100.0, 100.0)) - 38.5).abs() < 1e-12);
    }

    /// A box of odd width whose middle is interpolated between texels is the blur of that width, sampled bilinearly.
    #[test]
    fn a_moving_box_is_an_interpolated_blur() {
        let value = |x: usize, y: usize| ((x * 7 + y * 13) % 11) as f64;
        let blurred = |x: f64| box_mean(16, value, (x, 8.5), (5.0, 5.0));
        for part in [0.0, 0.2, 0.5, 0.9] {
            let between = blurred(7.5) * (1.0 - part) + blurred(8.5) * part;
            assert!((blurred(7.5 + part) - between).abs() < 1e-12);
        }
    }

    #[test]
    fn errors_of_floats_grow_with_the_map_and_those_of_whole_numbers_do_not() {
        assert_eq!((table_additions(256, 4), table_additions(2048, 4), table_additions(1024, 2)), (24, 36, 20));
        let growth = float_mean_bound(1024, 4, 8.0, 1.0) / float_mean_bound(256, 4, 8.0, 1.0);
        assert!((growth - 16.0 * 30.0 / 24.0).abs() < 1e-9);
        assert!((variance_bound(1.0, whole_mean_bound(18), whole_mean_bound(18)) - 3.0 / 524_288.0).abs() < 1e-11);
    }
}
