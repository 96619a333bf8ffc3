//! The tests that claims can ask for: one row each.

use super::Claim;
use crate::study::figures::figure;
use crate::study::fit::Fit;

/// A number and what it may be.
#[derive(Clone, Debug)]
pub(super) struct Statistic {
    /// What it is.
    pub(super) what: String,
    /// The number.
    pub(super) value: f64,
    /// The least that it may be.
    pub(super) low: Option<f64>,
    /// The most.
    pub(super) high: Option<f64>,
}

/// A test.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// Its name in files.
    pub name: &'static str,
    /// Fields that it needs beyond those of every claim.
    pub needs: &'static [&'static str],
    /// Fields that it can do without.
    pub takes: &'static [&'static str],
    /// Fewest and most methods; 0 of fewest: all methods, where none are named.
    pub methods: (usize, usize),
    /// Whether each method is divided by its neighbour in the list.
    pub pairs: bool,
    /// Of neighbours, the later is divided by the earlier; else the other way round.
    pub rising: bool,
    /// Fewest points of a line.
    pub points: usize,
    /// The numbers of a line, as many for any values at the same places.
    pub(super) measure: fn(&Claim, &[f64], &[f64]) -> Vec<Statistic>,
    /// More about a line, in words.
    pub(super) detail: fn(&Claim, &[f64], &[f64]) -> String,
}

const EACH: Kind = Kind {
    name: "",
    needs: &[],
    takes: &[],
    methods: (0, usize::MAX),
    pairs: false,
    rising: false,
    points: 2,
    measure: |_, _, _| Vec::new(),
    detail: |_, _, values| values.iter().map(|v| figure(*v)).collect::<Vec<_>>().join(", "),
};

/// All tests.
pub const KINDS: &[Kind] = &[
    // Greatest over least.
    Kind { name: "constant", needs: &["within"], takes: &["to"], measure: constant, ..EACH },
    // All within a share of their middle.
    Kind { name: "steady", needs: &["within"], takes: &["to"], measure: steady, ..EACH },
    // Growth with each doubling, beside a power.
    Kind { name: "power", needs: &["exponent", "within"], takes: &["to"], measure: power, detail: fitted, ..EACH },
    // Growth from point to point, beside that of a power times a logarithm.
    Kind { name: "power_log", needs: &["exponent", "within"], takes: &["to"], measure: power_log, ..EACH },
    // How well a straight line explains the values.
    Kind {
        name: "linear",
        needs: &["least"],
        takes: &["exponent", "to"],
        points: 3,
        measure: linear,
        detail: fitted,
        ..EACH
    },
    // Each method above the one before it.
    Kind {
        name: "ordered",
        methods: (2, usize::MAX),
        pairs: true,
        rising: true,
        points: 1,
        measure: |_, _, ratios| vec![Statistic::new("least ratio", least(ratios), Some(1.0), None)],
        ..EACH
    },
    // The first method below the second at first, above it in the end.
    Kind { name: "crossing", methods: (2, 2), pairs: true, measure: crossing, detail: where_they_cross, ..EACH },
    // More at the end than at the beginning, and nowhere less than before.
    Kind { name: "grows", takes: &["by", "within", "to"], measure: grows, ..EACH },
];

impl Kind {
    /// The test of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        KINDS.iter().find(|k| k.name == name)
    }
}

impl Statistic {
    fn new(what: impl Into<String>, value: f64, low: Option<f64>, high: Option<f64>) -> Self {
        Self { what: what.into(), value, low, high }
    }
}

fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

fn most(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

fn constant(claim: &Claim, _: &[f64], values: &[f64]) -> Vec<Statistic> {
    vec![Statistic::new("greatest / least", most(values) / least(values), None, Some(1.0 + claim.within))]
}

fn steady(claim: &Claim, _: &[f64], values: &[f64]) -> Vec<Statistic> {
    let (low, high) = (least(values), most(values));
    vec![Statistic::new("farthest from the middle", (high - low) / (high + low), None, Some(claim.within))]
}

/// From point to point, each with what it is from and to.
fn steps<'a>(x: &'a [f64], values: &'a [f64]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> + 'a {
    x.windows(2).zip(values.windows(2)).map(|(x, v)| ([x[0], x[1]], [v[0], v[1]]))
}

fn power(claim: &Claim, x: &[f64], values: &[f64]) -> Vec<Statistic> {
    let expected = claim.exponent.exp2();
    let step = |(x, v): ([f64; 2], [f64; 2])| {
        let what = format!("growth per doubling, {} to {}", x[0], x[1]);
        let growth = (v[1] / v[0]).powf(1.0 / (x[1] / x[0]).log2());
        Statistic::new(what, growth, Some(expected * (1.0 - claim.within)), Some(expected * (1.0 + claim.within)))
    };
    steps(x, values).map(step).collect()
}

fn power_log(claim: &Claim, x: &[f64], values: &[f64]) -> Vec<Statistic> {
    let of = |x: f64| x.powf(claim.exponent) * x.log2();
    let step = |(x, v): ([f64; 2], [f64; 2])| {
        let what = format!("growth beside the law, {} to {}", x[0], x[1]);
        let ratio = (v[1] / v[0]) / (of(x[1]) / of(x[0]));
        Statistic::new(what, ratio, Some(1.0 - claim.within), Some(1.0 + claim.within))
    };
    steps(x, values).map(step).collect()
}

fn line(claim: &Claim, x: &[f64], values: &[f64]) -> Option<Fit> {
    Fit::of(&x.iter().map(|x| x.powf(claim.exponent)).collect::<Vec<_>>(), values)
}

fn linear(claim: &Claim, x: &[f64], values: &[f64]) -> Vec<Statistic> {
    let r2 = line(claim, x, values).map_or(f64::NAN, |fit| fit.r2);
    vec![Statistic::new("R²", r2, Some(claim.least), None)]
}

/// The line through powers of what lies along the axis.
fn fitted(claim: &Claim, x: &[f64], values: &[f64]) -> String {
    let Some(fit) = line(claim, x, values) else { return String::new() };
    let power = if claim.exponent == 1.0 { "x".to_owned() } else { format!("x^{}", claim.exponent) };
    let slope = format!("{:.2e}", fit.b);
    format!("{} + {slope} {power}, R² {:.4}", figure(fit.a), fit.r2)
}

fn crossing(_: &Claim, x: &[f64], ratios: &[f64]) -> Vec<Statistic> {
    let (Some(first), Some(last)) = (ratios.first(), ratios.last()) else { return Vec::new() };
    let at = |i: usize| x.get(i).map_or(String::new(), f64::to_string);
    vec![
        Statistic::new(format!("ratio at {}", at(0)), *first, None, Some(1.0)),
        Statistic::new(format!("ratio at {}", at(x.len() - 1)), *last, Some(1.0), None),
    ]
}

/// Where the ratio passes 1, both along the axis and in itself taken as powers.
fn where_they_cross(_: &Claim, x: &[f64], ratios: &[f64]) -> String {
    let place = |(x, v): ([f64; 2], [f64; 2])| {
        (v[0] < 1.0 && v[1] >= 1.0)
            .then(|| (x[0].log2() + (x[1] / x[0]).log2() * (-v[0].log2() / (v[1] / v[0]).log2())).exp2())
    };
    match steps(x, ratios).find_map(place) {
        Some(x) => format!("cross at {x:.0}"),
        None if most(ratios) < 1.0 => "cheaper everywhere".into(),
        None if least(ratios) > 1.0 => "dearer everywhere".into(),
        None => "do not cross upwards".into(),
    }
}

fn grows(claim: &Claim, x: &[f64], values: &[f64]) -> Vec<Statistic> {
    let (Some(first), Some(last)) = (values.first(), values.last()) else { return Vec::new() };
    let step = least(&steps(x, values).map(|(_, v)| v[1] / v[0]).collect::<Vec<_>>());
    vec![
        Statistic::new("last / first", last / first, Some(claim.by), None),
        Statistic::new("least step", step, Some(1.0 - claim.within), None),
    ]
}
