//! Logarithmic axes: where a value lies, and which values are marked.

/// A logarithmic axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    /// The value at its beginning.
    low: f64,
    /// The value at its end.
    high: f64,
    /// Places of both, in points.
    from: f64,
    to: f64,
}

/// A mark on an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub(super) value: f64,
    /// Empty for a small mark.
    pub(super) label: String,
}

impl Scale {
    /// An axis with room for these values, of which those that are not above 0 are left out, from one place to another.
    pub(super) fn new(values: impl IntoIterator<Item = f64>, from: f64, to: f64) -> Self {
        let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
        for value in values.into_iter().filter(|v| *v > 0.0 && v.is_finite()) {
            // Nobody measures beyond, and digits and marks run out there.
            let value = value.clamp(1e-30, 1e30);
            low = low.min(value);
            high = high.max(value);
        }
        if low > high {
            (low, high) = (0.1, 10.0);
        }
        // A little room at both ends, and at least a factor of four in all.
        let least = (2.0 / (high / low).sqrt()).max(1.0);
        let room = 1.12 * least * (high / low).powf(0.04);
        Self { low: low / room, high: high * room, from, to }
    }

    /// The same axis somewhere else.
    pub(super) fn at(self, from: f64, to: f64) -> Self {
        Self { from, to, ..self }
    }

    /// Where a value lies.
    pub(super) fn place(&self, value: f64) -> f64 {
        let share = (value.log10() - self.low.log10()) / (self.high.log10() - self.low.log10());
        self.from + (self.to - self.from) * share.clamp(0.0, 1.0)
    }

    /// Its marks: some with a label, so many that they can be read and do not touch.
    pub(super) fn ticks(&self) -> Vec<Tick> {
        let decades = self.high.log10() - self.low.log10();
        let (labelled, small): (&[f64], &[f64]) = match decades {
            d if d < 0.8 => (&[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0], &[]),
            d if d < 2.7 => (&[1.0, 2.0, 5.0], &[3.0, 4.0, 6.0, 7.0, 8.0, 9.0]),
            _ => (&[1.0], &[2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]),
        };
        // With very many decades not each has a label.
        #[allow(clippy::cast_possible_truncation, reason = "at most 617 decades")]
        let (first, last, every) =
            (self.low.log10().floor() as i32, self.high.log10().ceil() as i32, (decades / 7.0).ceil().max(1.0) as i32);
        let mut ticks = Vec::new();
        for power in first..=last {
            let mut add = |digit: f64, labelled: bool| {
                let value: f64 = format!("{digit}e{power}").parse().unwrap_or(0.0);
                if value >= self.low && value <= self.high {
                    let label = if labelled && power.rem_euclid(every) == 0 { written(value) } else { String::new() };
                    ticks.push(Tick { value, label });
                }
            };
            labelled.iter().for_each(|d| add(*d, true));
            small.iter().for_each(|d| add(*d, false));
        }
        ticks.sort_by(|a, b| a.value.total_cmp(&b.value));
        ticks
    }
}

/// A value of a mark, as short as it is exact.
fn written(value: f64) -> String {
    if (1e-4..1e5).contains(&value) {
        return format!("{value}");
    }
    format!("{value:e}").replace('e', "×10^").replace("1×", "")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(values: &[f64]) -> Vec<String> {
        let ticks = Scale::new(values.iter().copied(), 0.0, 100.0).ticks();
        ticks.into_iter().map(|t| t.label).filter(|l| !l.is_empty()).collect()
    }

    #[test]
    fn every_axis_has_marks_that_can_be_read() {
        assert_eq!(labels(&[1.0, 1.1]), ["0.5", "0.6", "0.8", "1", "1.5", "2"]);
        assert_eq!(labels(&[1.2, 40.0]), ["1", "2", "5", "10", "20", "50"][..].to_vec());
        assert_eq!(labels(&[0.002, 0.5, 3.0]), ["0.01", "0.1", "1"]);
        for values in [&[][..], &[0.0], &[1e-300, 1e300], &[5e-324], &[f64::MAX], &[7.0]] {
            let count = labels(values).len();
            assert!((1..=12).contains(&count), "{values:?}: {:?}", labels(values));
        }
    }

    #[test]
    fn values_lie_within_and_in_their_order() {
        let scale = Scale::new([1.0, 100.0], 10.0, 110.0);
        let places = [1.0, 10.0, 100.0].map(|v| scale.place(v));
        assert!(10.0 < places[0] && places[0] < places[1] && places[1] < places[2] && places[2] < 110.0);
        assert!((places[1] - 60.0).abs() < 1e-9, "{places:?}");
    }
}
