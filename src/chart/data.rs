//! What a chart shows: points, curves and fronts, panel by panel.

use std::collections::{BTreeMap, BTreeSet};

use super::metric::{METRICS, Metric};
use crate::study::front::front;
use crate::study::select::Quantity;
use crate::study::{Machine, Record, Spread};

/// The time that is charted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Time {
    /// All passes on the adapter.
    #[default]
    Total,
    /// The pass that draws the picture.
    Main,
    /// From the submission to the pixels on the host.
    Wall,
    /// All passes, beside those of the plain shadow map in the same rounds.
    Ratio,
}

impl Time {
    /// Its values in a record, round by round.
    pub fn of(self, record: &Record) -> Option<Vec<f64>> {
        match self {
            Self::Total => record.total(),
            Self::Main => Quantity::Main.of(record, None),
            Self::Wall => Quantity::Wall.of(record, None),
            Self::Ratio => record.ratios(),
        }
    }

    /// What it is, for an axis.
    pub fn label(self) -> &'static str {
        match self {
            Self::Total => "time of all passes, ms",
            Self::Main => "time of the main pass, ms",
            Self::Wall => "time to the pixels on the host, ms",
            Self::Ratio => "time of all passes / that of the plain shadow map",
        }
    }

    /// What stands after a value.
    pub fn unit(self) -> &'static str {
        if self == Self::Ratio { "×" } else { " ms" }
    }
}

/// What is charted.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// What lies across.
    pub time: Time,
    /// What lies upwards.
    pub metric: Metric,
    /// The part of the picture that the error is taken over.
    pub region: String,
    /// The truth that errors are taken from; none for rays where there are such, else whatever there is.
    pub reference: Option<String>,
    /// Size of the frames; none for the one with the most points.
    pub frame: Option<(u32, u32)>,
}

impl Default for Choice {
    fn default() -> Self {
        Self { time: Time::Total, metric: METRICS[0], region: "all".into(), reference: None, frame: None }
    }
}

/// One cell in a panel.
#[derive(Clone, Debug)]
pub struct Point<'a> {
    /// What was measured.
    pub record: &'a Record,
    /// Its method: a place in [`Chart::methods`].
    pub method: usize,
    /// Where its time lies: the median is across.
    pub time: Spread,
    /// Its error.
    pub error: f64,
    /// What varies between the points of its method, in few words.
    pub label: String,
}

/// Points of a method, joined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Curve {
    /// The method.
    pub method: usize,
    /// Places in [`Panel::points`], in the order of the sweep.
    pub points: Vec<usize>,
}

/// One class of scenes.
#[derive(Clone, Debug)]
pub struct Panel<'a> {
    /// The class.
    pub class: String,
    /// The case, where it says more than the class.
    pub case: String,
    /// All points.
    pub points: Vec<Point<'a>>,
    /// All curves.
    pub curves: Vec<Curve>,
    /// Places of the points that none beats, by rising time.
    pub front: Vec<usize>,
}

impl Panel<'_> {
    /// What it is called.
    pub fn title(&self) -> String {
        if self.case.is_empty() || self.case == self.class {
            self.class.clone()
        } else {
            format!("{}: {}", self.class, self.case)
        }
    }

    /// Times and errors of the points.
    pub fn places(&self) -> Vec<(f64, f64)> {
        self.points.iter().map(|p| (p.time.median, p.error)).collect()
    }
}

/// What is shown, panel by panel.
#[derive(Clone, Debug)]
pub struct Chart<'a> {
    /// What is charted.
    pub choice: Choice,
    /// The truth that errors are taken from.
    pub reference: String,
    /// Size of the frames; others are not in the chart.
    pub frame: (u32, u32),
    /// Sizes of frames that were measured besides.
    pub other_frames: Vec<(u32, u32)>,
    /// All methods, in the order in which they are met in the records.
    pub methods: Vec<String>,
    /// One for each case, in the order in which they are met.
    pub panels: Vec<Panel<'a>>,
    /// Where it was measured.
    pub machine: Machine,
    /// Fewest and most rounds of a point.
    pub rounds: (usize, usize),
}

/// Different values in the order in which they are met.
fn distinct<T: Clone + Ord>(values: impl Iterator<Item = T>) -> Vec<T> {
    let mut seen = BTreeSet::new();
    values.filter(|v| seen.insert(v.clone())).collect()
}

impl<'a> Chart<'a> {
    /// The chart of records of one machine; none where no cell has both a time and an error.
    pub fn new(records: &'a [Record], choice: &Choice) -> Option<Self> {
        let reference = choice.reference.clone().or_else(|| {
            let known: BTreeSet<&String> = records.iter().flat_map(|r| r.errors.keys()).collect();
            known.iter().find(|n| n.as_str() == "rays").or(known.first()).map(|n| (*n).clone())
        })?;
        let methods = distinct(records.iter().map(|r| r.method.clone()));
        let number: BTreeMap<&str, usize> = methods.iter().enumerate().map(|(i, m)| (m.as_str(), i)).collect();
        let all: Vec<Point<'a>> = records
            .iter()
            .filter(|r| r.failure.is_none() && choice.frame.is_none_or(|f| f == r.frame))
            .filter_map(|record| {
                let time = Spread::of(&choice.time.of(record)?).filter(|t| t.median > 0.0)?;
                let error = (choice.metric.of)(record.errors.get(&reference)?.regions.get(&choice.region)?);
                let method = number[record.method.as_str()];
                (error.is_finite() && error >= 0.0).then(|| Point { record, method, time, error, label: String::new() })
            })
            .collect();
        // The frame with the most points, and of those the largest.
        let mut counts: BTreeMap<(u32, u32), usize> = BTreeMap::new();
        all.iter().for_each(|p| *counts.entry(p.record.frame).or_default() += 1);
        let area = |f: (u32, u32)| u64::from(f.0) * u64::from(f.1);
        let frame = *counts.iter().max_by_key(|(f, n)| (**n, area(**f)))?.0;
        let mut others = distinct(records.iter().map(|r| r.frame).filter(|f| *f != frame));
        others.sort_by_key(|f| area(*f));
        let mut cases: BTreeMap<(String, String), Vec<Point<'a>>> = BTreeMap::new();
        let shown: Vec<Point<'a>> = all.into_iter().filter(|p| p.record.frame == frame).collect();
        let order = distinct(shown.iter().map(|p| (p.record.class.clone(), p.record.case.clone())));
        let rounds = (
            shown.iter().map(|p| p.time.count).min().unwrap_or(0),
            shown.iter().map(|p| p.time.count).max().unwrap_or(0),
        );
        let machine = shown.first()?.record.machine.clone();
        for point in shown {
            cases.entry((point.record.class.clone(), point.record.case.clone())).or_default().push(point);
        }
        let panel = |(class, case): (String, String)| {
            let alone = order.iter().filter(|(c, _)| *c == class).count() == 1;
            let points = cases.remove(&(class.clone(), case.clone())).unwrap_or_default();
            Panel::new(class, if alone { String::new() } else { case }, points)
        };
        let panels = order.clone().into_iter().map(panel).collect();
        Some(Self { choice: choice.clone(), reference, frame, other_frames: others, methods, panels, machine, rounds })
    }

    /// What is known of records without a chart, where errors were not measured; none without records.
    pub fn without_panels(records: &'a [Record], choice: &Choice) -> Option<Self> {
        Some(Self {
            choice: choice.clone(),
            reference: choice.reference.clone().unwrap_or_default(),
            frame: choice.frame.unwrap_or_default(),
            other_frames: Vec::new(),
            methods: distinct(records.iter().map(|r| r.method.clone())),
            panels: Vec::new(),
            machine: records.first()?.machine.clone(),
            rounds: (0, 0),
        })
    }

    /// Whether some point has no error at all, which has no place on a logarithmic axis.
    pub fn has_zero(&self) -> bool {
        self.panels.iter().flat_map(|p| &p.points).any(|p| p.error == 0.0)
    }
}

impl<'a> Panel<'a> {
    fn new(class: String, case: String, mut points: Vec<Point<'a>>) -> Self {
        let curves = curves(&mut points);
        let places: Vec<(f64, f64)> = points.iter().map(|p| (p.time.median, p.error)).collect();
        Self { class, case, front: front(&places), points, curves }
    }
}

/// Joins points of a method along the first setting that varies, and labels each with what varies.
fn curves(points: &mut [Point<'_>]) -> Vec<Curve> {
    let mut methods: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    points.iter().enumerate().for_each(|(i, p)| methods.entry(p.method).or_default().push(i));
    let mut curves = Vec::new();
    for (method, mut members) in methods {
        let value = |i: usize, name: &str| points[i].record.settings.get(name).cloned().unwrap_or_default();
        let named = distinct(members.iter().flat_map(|i| points[*i].record.varied.clone()));
        let varies = |name: &String| members.iter().any(|i| value(*i, name) != value(members[0], name));
        let varied: Vec<String> = named.into_iter().filter(varies).collect();
        let key = |i: usize| varied.iter().map(|name| Value::new(&value(i, name))).collect::<Vec<_>>();
        members.sort_by(|a, b| {
            let (a_key, b_key) = (key(*a), key(*b));
            // What is joined varies last.
            let rest = a_key.get(1..).cmp(&b_key.get(1..));
            rest.then_with(|| a_key.first().cmp(&b_key.first())).then(a.cmp(b))
        });
        let labels: Vec<(usize, String)> = members
            .iter()
            .map(|i| (*i, varied.iter().map(|name| value(*i, name)).collect::<Vec<_>>().join(" · ")))
            .collect();
        let mut by_rest: Vec<(Option<Vec<Value>>, Vec<usize>)> = Vec::new();
        for i in members {
            let rest = key(i).get(1..).map(<[Value]>::to_vec);
            match by_rest.last_mut() {
                Some((last, members)) if *last == rest => members.push(i),
                _ => by_rest.push((rest, vec![i])),
            }
        }
        curves.extend(by_rest.into_iter().map(|(_, points)| Curve { method, points }));
        labels.into_iter().for_each(|(i, label)| points[i].label = label);
    }
    curves
}

/// A value of a setting: numbers in their order, before words in theirs.
#[derive(Clone, Debug, PartialEq)]
enum Value {
    Number(f64),
    Word(String),
}

impl Value {
    fn new(text: &str) -> Self {
        text.parse().ok().filter(|x: &f64| x.is_finite()).map_or_else(|| Self::Word(text.to_owned()), Self::Number)
    }
}

impl Eq for Value {}

impl Ord for Value {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        use std::cmp::Ordering;
        match (self, other) {
            (Self::Number(a), Self::Number(b)) => a.total_cmp(b),
            (Self::Word(a), Self::Word(b)) => a.cmp(b),
            (Self::Number(_), Self::Word(_)) => Ordering::Less,
            (Self::Word(_), Self::Number(_)) => Ordering::Greater,
        }
    }
}

impl PartialOrd for Value {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
