//! Claims about times, and whether records bear them out.
//!
//! A claim names a kind of test, methods, a time and an axis. Its test is computed on every line of records along that
//! axis, each from the medians of its rounds, and it is held if every one of them meets its bounds. How sure each number
//! is, drawing the rounds again tells.

mod kinds;
mod read;

use serde::Serialize;

pub use kinds::{KINDS, Kind};
pub(super) use read::known_method;
pub use read::read_claims;

use super::Record;
use super::figures::figure;
use super::resample::intervals;
use super::select::{Along, Filter, Line, Quantity};
use super::statistics::median;

/// Something that ought to be so.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Claim {
    /// Short name. What stands before a blank is the hypothesis that it is a part of.
    pub id: String,
    /// What is claimed, in words.
    pub text: String,
    /// Whether it must hold on every device; else it is a fact about the one that was measured.
    pub law: bool,
    /// The test: a name of [`KINDS`].
    pub kind: &'static str,
    /// What is timed.
    pub time: Quantity,
    /// Only passes of this name.
    pub pass: Option<String>,
    /// The methods that it is about, in the order that the test needs; empty for all.
    pub methods: Vec<String>,
    /// The method that times are divided by.
    pub to: Option<String>,
    /// The axis: see [`super::select::Along`].
    pub over: String,
    /// Only from here on along the axis.
    pub from: f64,
    /// Which records.
    pub only: Filter,
    /// Tolerance, as a share.
    pub within: f64,
    /// Power of what lies along the axis.
    pub exponent: f64,
    /// Least share of the variance that a line must explain.
    pub least: f64,
    /// Factor by which it must grow.
    pub by: f64,
}

/// What became of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Every number meets its bounds.
    Held,
    /// Some number does not.
    NotHeld,
    /// There are no records that tell.
    NotMeasured,
}

impl Outcome {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Held => "held",
            Self::NotHeld => "not held",
            Self::NotMeasured => "not measured",
        }
    }
}

/// One number of a claim.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Part {
    /// The method, and what else tells this line from the others.
    pub place: String,
    /// What the number is.
    pub what: String,
    /// The number.
    pub value: f64,
    /// Ends of its interval.
    pub interval: (f64, f64),
    /// What it may be, both ends included; none where there is no end.
    pub bounds: (Option<f64>, Option<f64>),
    /// Whether it is within its bounds.
    pub held: bool,
    /// Whether the whole interval lies on the same side of the bounds as the number.
    pub sure: bool,
    /// More about the line, in words.
    pub detail: String,
}

/// A claim, judged.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// Name of the claim.
    pub id: String,
    /// What is claimed.
    pub text: String,
    /// Whether it must hold on every device.
    pub law: bool,
    /// What became of it.
    pub outcome: Outcome,
    /// The numbers behind it, line by line.
    pub parts: Vec<Part>,
    /// Why it was not measured.
    pub reason: String,
}

impl Verdict {
    /// The number that decides: the one farthest outside of its bounds, or nearest to them from within.
    pub fn decisive(&self) -> Option<&Part> {
        self.parts.iter().min_by(|a, b| a.margin().total_cmp(&b.margin()))
    }
}

impl Part {
    /// How far within its bounds, as a share of them; below 0 outside.
    fn margin(&self) -> f64 {
        let scale = |bound: f64| if bound == 0.0 { 1.0 } else { bound.abs() };
        let low = self.bounds.0.map_or(f64::INFINITY, |b| (self.value - b) / scale(b));
        let high = self.bounds.1.map_or(f64::INFINITY, |b| (b - self.value) / scale(b));
        if self.value.is_finite() { low.min(high) } else { f64::NEG_INFINITY }
    }

    /// What it may be, in words.
    pub fn allowed(&self) -> String {
        match self.bounds {
            (Some(low), Some(high)) => format!("{} to {}", figure(low), figure(high)),
            (Some(low), None) => format!("at least {}", figure(low)),
            (None, Some(high)) => format!("at most {}", figure(high)),
            (None, None) => String::new(),
        }
    }
}

/// Judges claims by records, which may have any order.
pub fn judge(claims: &[Claim], records: &[Record]) -> Vec<Verdict> {
    claims.iter().map(|claim| judge_one(claim, records)).collect()
}

fn judge_one(claim: &Claim, records: &[Record]) -> Verdict {
    let verdict = |outcome, parts, reason: &str| Verdict {
        id: claim.id.clone(),
        text: claim.text.clone(),
        law: claim.law,
        outcome,
        parts,
        reason: reason.to_owned(),
    };
    let Some(kind) = Kind::named(claim.kind) else {
        return verdict(Outcome::NotMeasured, Vec::new(), "there is no such test");
    };
    let (lines, missing) = lines(claim, kind, records);
    let mut parts: Vec<Part> = lines.iter().flat_map(|line| measure(claim, kind, line)).collect();
    distinguish(&mut parts, &lines);
    if parts.is_empty() {
        let of = if missing.is_empty() { "any method".to_owned() } else { missing.join(", ") };
        let least = if kind.points == 1 { "1 place".to_owned() } else { format!("{} places", kind.points) };
        let reason = format!("needs the {} time of {of} at {least} or more along `{}`", claim.time.name(), claim.over);
        return verdict(Outcome::NotMeasured, parts, &reason);
    }
    if !parts.iter().all(|p| p.held) {
        return verdict(Outcome::NotHeld, parts, "");
    }
    // What was measured holds, but that is less than was claimed.
    if !missing.is_empty() {
        return verdict(Outcome::NotMeasured, parts, &format!("nothing was measured of {}", missing.join(", ")));
    }
    verdict(Outcome::Held, parts, "")
}

/// The lines that a claim is about, and the methods of which there is none.
fn lines(claim: &Claim, kind: &Kind, records: &[Record]) -> (Vec<Line>, Vec<String>) {
    let along = Along {
        axis: &claim.over,
        time: claim.time,
        pass: claim.pass.as_deref(),
        filter: &claim.only,
        from: claim.from,
    };
    let mut methods = claim.methods.clone();
    if methods.is_empty() {
        methods = records.iter().map(|r| r.method.clone()).collect();
        methods.sort();
        methods.dedup();
    }
    let pairs: Vec<(&str, Option<&str>)> = if kind.pairs {
        // The numerator is the method that the test is after: the later in a row that rises, the first where two cross.
        let pair = |w: &'static [usize; 2], i: usize| (methods[i + w[0]].as_str(), Some(methods[i + w[1]].as_str()));
        let order: &'static [usize; 2] = if kind.rising { &[1, 0] } else { &[0, 1] };
        (0..methods.len().saturating_sub(1)).map(|i| pair(order, i)).collect()
    } else {
        methods.iter().map(|m| (m.as_str(), claim.to.as_deref())).collect()
    };
    let mut all = Vec::new();
    let mut missing = Vec::new();
    for (method, below) in pairs {
        let mut found = along.lines(records, method, below);
        found.retain(|line| line.x.len() >= kind.points);
        if found.is_empty() {
            missing.push(below.map_or(method.to_owned(), |below| format!("{method} / {below}")));
        }
        all.extend(found);
    }
    (all, missing)
}

/// The numbers of one line.
fn measure(claim: &Claim, kind: &Kind, line: &Line) -> Vec<Part> {
    let groups = line.groups();
    let medians: Vec<f64> = groups.iter().map(|g| median(g)).collect();
    let values = line.values(&medians);
    let found = (kind.measure)(claim, &line.x, &values);
    let again = intervals(&groups, |medians| {
        let of = (kind.measure)(claim, &line.x, &line.values(medians));
        of.into_iter().map(|s| s.value).collect()
    });
    let detail = (kind.detail)(claim, &line.x, &values);
    let part = |(statistic, (low, high)): (kinds::Statistic, (f64, f64))| {
        let inside = |x: f64| statistic.low.is_none_or(|b| x >= b) && statistic.high.is_none_or(|b| x <= b);
        let held = statistic.value.is_finite() && inside(statistic.value);
        // An interval of what is never negative, such as a spread, can lie beside the number itself.
        let interval = (low.min(statistic.value), high.max(statistic.value));
        let sure = if held {
            inside(interval.0) && inside(interval.1)
        } else {
            statistic.high.is_some_and(|b| interval.0 > b) || statistic.low.is_some_and(|b| interval.1 < b)
        };
        Part {
            place: String::new(),
            what: statistic.what,
            value: statistic.value,
            interval,
            bounds: (statistic.low, statistic.high),
            held,
            sure,
            detail: detail.clone(),
        }
    };
    let mut parts: Vec<Part> = found.into_iter().zip(again).map(part).collect();
    // Which line it is, until all are known.
    parts.iter_mut().for_each(|p| p.place = line.place.join("\n"));
    parts
}

/// Names the line of each part by its method and by what is not the same in all lines.
fn distinguish(parts: &mut [Part], lines: &[Line]) {
    let common = |word: &String| lines.iter().all(|line| line.place[1..].contains(word));
    for line in lines {
        let rest = line.place[1..].iter().filter(|w| !common(w));
        let name: Vec<&str> = line.place[..1].iter().chain(rest).map(String::as_str).collect();
        let (name, old) = (name.join(", "), line.place.join("\n"));
        parts.iter_mut().filter(|p| p.place == old).for_each(|p| p.place.clone_from(&name));
    }
}

#[cfg(test)]
mod tests;
