//! Lines through records: one time along one thing that varies, all else being equal.

use std::collections::BTreeMap;

use super::statistics::median;
use super::{Record, Role};

/// What is timed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// All passes, on the adapter.
    #[default]
    Total,
    /// The pass that draws the picture.
    Main,
    /// The passes that draw casters as the light sees them.
    Light,
    /// The passes that make maps from maps.
    Filter,
    /// From the submission to the pixels on the host.
    Wall,
}

impl Quantity {
    /// All, by name.
    pub const ALL: [(&'static str, Self); 5] = [
        ("total", Self::Total),
        ("main", Self::Main),
        ("light", Self::Light),
        ("filter", Self::Filter),
        ("wall", Self::Wall),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, q)| *q == self).map_or("", |(name, _)| name)
    }

    /// Milliseconds of a record, round by round, of passes whose own name is `pass` where one is given; none where they
    /// are not known.
    pub fn of(self, record: &Record, pass: Option<&str>) -> Option<Vec<f64>> {
        let roles: &[Role] = match self {
            Self::Total => &[Role::Light, Role::Filter, Role::Main],
            Self::Main => &[Role::Main],
            Self::Light => &[Role::Light],
            Self::Filter => &[Role::Filter],
            Self::Wall => return (!record.wall.is_empty()).then(|| record.wall.clone()),
        };
        let Some(pass) = pass else { return record.time_of(roles) };
        let named = |name: &str| {
            let own = name.rsplit_once(": ").map_or(name, |(_, own)| own);
            own.split([' ', ',']).next() == Some(pass)
        };
        let passes = record.passes.iter().filter(|p| named(&p.name)).cloned().collect();
        Record { passes, ..Record::default() }.time_of(roles)
    }
}

/// Which records are looked at.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Filter {
    /// Only of this class of scenes.
    pub class: Option<String>,
    /// Only of this frame size.
    pub frame: Option<(u32, u32)>,
    /// Only with these settings; a setting that a method does not have is no hindrance.
    pub settings: BTreeMap<String, String>,
}

impl Filter {
    /// Whether a record is one of them and has figures.
    pub fn takes(&self, record: &Record) -> bool {
        let set = |(name, value): (&String, &String)| record.settings.get(name).is_none_or(|v| v == value);
        record.failure.is_none()
            && self.class.as_ref().is_none_or(|c| *c == record.class)
            && self.frame.is_none_or(|f| f == record.frame)
            && self.settings.iter().all(set)
    }
}

/// Times along something that varies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// What all its points have in common, in words, the most telling first.
    pub place: Vec<String>,
    /// Where the points lie, ascending.
    pub x: Vec<f64>,
    /// Milliseconds of each point, round by round.
    pub samples: Vec<Vec<f64>>,
    /// Milliseconds that they are divided by.
    pub below: Option<Vec<Vec<f64>>>,
}

impl Line {
    /// Values from the medians of samples, and of what they are divided by.
    pub fn values(&self, medians: &[f64]) -> Vec<f64> {
        match &self.below {
            Some(_) => (0..self.x.len()).map(|i| medians[i] / medians[i + self.x.len()]).collect(),
            None => medians.to_vec(),
        }
    }

    /// All samples: those of the points, then those that they are divided by.
    pub fn groups(&self) -> Vec<&[f64]> {
        self.samples.iter().chain(self.below.iter().flatten()).map(Vec::as_slice).collect()
    }
}

/// What is looked at along an axis.
#[derive(Clone, Copy, Debug)]
pub struct Along<'a> {
    /// `pixels` (of the frame; also `frame`), `triangles`, `side` (of the map), or the name of a setting.
    pub axis: &'a str,
    /// What is timed.
    pub time: Quantity,
    /// Only passes of this name.
    pub pass: Option<&'a str>,
    /// Which records.
    pub filter: &'a Filter,
    /// Least value along the axis.
    pub from: f64,
}

/// Where a record lies along an axis.
pub fn position(record: &Record, axis: &str) -> Option<f64> {
    match axis {
        "frame" | "pixels" => Some(f64::from(record.frame.0) * f64::from(record.frame.1)),
        "triangles" => Some(record.triangles as f64),
        "side" => record.side.map(f64::from),
        "size" => number(record, axis).or_else(|| record.side.map(f64::from)),
        setting => number(record, setting),
    }
}

fn number(record: &Record, setting: &str) -> Option<f64> {
    record.settings.get(setting)?.parse::<f64>().ok().filter(|x| x.is_finite())
}

/// What must be equal along an axis, in words.
fn place(record: &Record, axis: &str) -> Vec<String> {
    let mut place = vec![record.method.clone()];
    if axis != "triangles" {
        place.push(record.case.clone());
    }
    if !matches!(axis, "frame" | "pixels") {
        place.push(format!("{} x {}", record.frame.0, record.frame.1));
    }
    let sized = matches!(axis, "side" | "size");
    let rest = record.settings.iter().filter(|(name, _)| *name != axis && !(sized && *name == "size"));
    place.extend(rest.map(|(name, value)| format!("{name} {value}")));
    place.push(record.machine.adapter.clone());
    place
}

/// Records of a method by where they lie and their frame.
type Others<'a> = BTreeMap<(u64, (u32, u32)), Vec<&'a Record>>;

impl Along<'_> {
    /// Lines of a method, in the order of their places. With `below`, every point is divided by that method at the same
    /// place, and left out where there is none.
    pub fn lines(&self, records: &[Record], method: &str, below: Option<&str>) -> Vec<Line> {
        let mut lines: BTreeMap<Vec<String>, BTreeMap<u64, &Record>> = BTreeMap::new();
        for (x, record) in self.of(records, method) {
            lines.entry(place(record, self.axis)).or_default().entry(x).or_insert(record);
        }
        let mut others = Others::new();
        for (x, record) in below.iter().flat_map(|below| self.of(records, below)) {
            others.entry((x, record.frame)).or_default().push(record);
        }
        let made = lines.into_iter().map(|(place, points)| {
            let mut line = Line { place, below: below.map(|_| Vec::new()), ..Line::default() };
            if let Some(below) = below {
                line.place[0] = format!("{method} / {below}");
            }
            for (x, record) in points {
                let Some(samples) = self.samples(record) else { continue };
                if let Some(divisors) = &mut line.below {
                    let Some(other) = self.beside(&others, x, record) else { continue };
                    divisors.push(other);
                }
                line.x.push(f64::from_bits(x));
                line.samples.push(samples);
            }
            line
        });
        made.filter(|line| !line.x.is_empty()).collect()
    }

    /// Records of a method and the bits of where they lie; positive numbers are in the order of their bits.
    fn of<'r>(&self, records: &'r [Record], method: &str) -> impl Iterator<Item = (u64, &'r Record)> {
        records.iter().filter(move |r| r.method == method && self.filter.takes(r)).filter_map(|record| {
            let x = position(record, self.axis).filter(|x| *x > 0.0 && *x >= self.from)?;
            Some((x.to_bits(), record))
        })
    }

    /// Times of a record. Half of them are above 0: a clock that now and then says 0 spoils nothing.
    fn samples(&self, record: &Record) -> Option<Vec<f64>> {
        let samples = self.time.of(record, self.pass)?;
        (samples.iter().all(|s| s.is_finite()) && median(&samples) > 0.0).then_some(samples)
    }

    /// Times of another method where a record is.
    fn beside(&self, others: &Others<'_>, x: u64, record: &Record) -> Option<Vec<f64>> {
        let same = |other: &&&Record| {
            other.machine.adapter == record.machine.adapter
                && (self.axis == "triangles" || other.case == record.case)
                && (other.side.is_none() || record.side.is_none() || other.side == record.side)
        };
        // The first by name, whatever the order of the records.
        let found = others.get(&(x, record.frame))?.iter().filter(same).min_by(|a, b| a.cell.cmp(&b.cell))?;
        self.samples(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::{Machine, Series};

    fn record(method: &str, size: u32, frame: (u32, u32), milliseconds: f64) -> Record {
        let pass = |name: &str, role, x: f64| Series { name: name.into(), role, milliseconds: vec![x, x] };
        Record {
            cell: format!("{method} {size} {frame:?}"),
            case: "car".into(),
            method: method.into(),
            settings: [("size".to_owned(), size.to_string())].into(),
            frame,
            side: Some(size),
            passes: vec![
                pass("key: blur x", Role::Filter, milliseconds),
                pass("key: mips", Role::Filter, 100.0),
                pass("main", Role::Main, milliseconds),
            ],
            wall: vec![1.0],
            machine: Machine { adapter: "a".into(), ..Machine::default() },
            ..Record::default()
        }
    }

    fn records() -> Vec<Record> {
        let mut all = Vec::new();
        for (size, frame) in [(512, (20, 10)), (256, (20, 10)), (256, (40, 10))] {
            all.push(record("a", size, frame, f64::from(size)));
            all.push(record("b", size, frame, 2.0 * f64::from(size)));
        }
        all.pop();
        all
    }

    #[test]
    fn lines_run_along_one_axis_and_share_all_else() {
        let filter = Filter::default();
        let along = Along { axis: "size", time: Quantity::Main, pass: None, filter: &filter, from: 0.0 };
        let lines = along.lines(&records(), "a", None);
        assert_eq!(lines.len(), 2, "one a frame size");
        assert_eq!((&lines[0].x, &lines[0].samples), (&vec![256.0, 512.0], &vec![vec![256.0; 2], vec![512.0; 2]]));
        assert_eq!(lines[0].place, ["a", "car", "20 x 10", "a"]);
        let along = Along { axis: "pixels", ..along };
        let lines = along.lines(&records(), "a", None);
        assert_eq!((&lines[0].x, &lines[1].x), (&vec![200.0, 400.0], &vec![200.0]));
        let along = Along { axis: "size", from: 300.0, ..along };
        assert_eq!(along.lines(&records(), "a", None)[0].x, [512.0]);
        let only = Filter { frame: Some((40, 10)), ..Filter::default() };
        assert_eq!(Along { filter: &only, from: 0.0, ..along }.lines(&records(), "a", None).len(), 1);
    }

    #[test]
    fn ratios_are_taken_where_both_are() {
        let filter = Filter::default();
        let along = Along { axis: "size", time: Quantity::Main, pass: None, filter: &filter, from: 0.0 };
        let lines = along.lines(&records(), "a", Some("b"));
        assert_eq!(lines.len(), 1, "at 40 x 10 there is no b");
        assert_eq!(lines[0].values(&[1.0, 2.0, 4.0, 4.0]), [0.25, 0.5]);
        assert_eq!(lines[0].place[0], "a / b");
    }

    #[test]
    fn passes_are_told_by_their_own_name() {
        let record = record("a", 256, (4, 4), 3.0);
        assert_eq!(Quantity::Filter.of(&record, None), Some(vec![103.0; 2]));
        assert_eq!(Quantity::Filter.of(&record, Some("blur")), Some(vec![3.0; 2]));
        assert_eq!(Quantity::Filter.of(&record, Some("key")), None);
        assert_eq!(Quantity::Wall.of(&record, None), Some(vec![1.0]));
        let failed = Record { failure: Some("lost".into()), ..record };
        assert!(!Filter::default().takes(&failed));
    }
}
