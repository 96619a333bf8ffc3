//! The choice for one light, with the reason and the bound of each part of it.

use super::candidate::{Candidate, MODELS};
use super::cost::{CostTable, Load, work};
use super::facts::Facts;
use super::filter::Filter;
use super::judge::{Judge, Storage};
use super::predict::{Metric, Outlook};
use crate::reference::worst_warped_bleeding;

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wish {
    /// Greatest error.
    pub max_error: f64,
    /// What error is.
    pub metric: Metric,
    /// Most milliseconds; none for as many as it takes.
    pub budget: Option<f64>,
}

/// A candidate with all that is known of it beforehand.
#[derive(Clone, Debug, PartialEq)]
pub struct Priced {
    /// The candidate, its expected error and its bound.
    pub outlook: Outlook,
    /// Milliseconds that it takes.
    pub milliseconds: f64,
}

/// Something that was decided.
#[derive(Clone, Debug, PartialEq)]
pub struct Decision {
    /// About what.
    pub about: &'static str,
    /// What was chosen.
    pub choice: String,
    /// Why.
    pub reason: String,
    /// Error of visibility that this decision alone can bring, where a law says so.
    pub bound: Option<f64>,
}

/// Why a light needs no shadow code, in words; its error is 0.
pub type Needless = &'static str;

/// The choice.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// No shadow code at all.
    Unshadowed(Needless),
    /// This one; its bound holds what was asked for.
    Met(Priced),
    /// None holds what was asked for; this one comes nearest.
    Unmet(Priced),
}

/// The cheapest first, of those that hold the wish; then the others, the most exact first. Those that the table cannot
/// price are left out, and counted.
pub fn ranked(outlooks: &[Outlook], table: &CostTable, load: &Load, wish: &Wish) -> (Vec<Priced>, Vec<Priced>, usize) {
    let price = |o: &Outlook| {
        let milliseconds = table.price(&work(&o.candidate, o.taps, load))?;
        Some(Priced { outlook: o.clone(), milliseconds })
    };
    let all: Vec<Priced> = outlooks.iter().filter_map(price).collect();
    let unknown = outlooks.len() - all.len();
    let (mut good, mut other): (Vec<_>, Vec<_>) = all.into_iter().partition(|p| holds(p, wish));
    // Sorting is stable: of equals the one that comes first in the table of models is taken.
    good.sort_by(|a, b| a.milliseconds.total_cmp(&b.milliseconds));
    other.sort_by(|a, b| a.outlook.bound.total_cmp(&b.outlook.bound));
    (good, other, unknown)
}

/// Whether error and time are within what was asked for.
pub fn holds(priced: &Priced, wish: &Wish) -> bool {
    priced.outlook.bound <= wish.max_error && wish.budget.is_none_or(|b| priced.milliseconds <= b)
}

/// Kinds of shadows of a catalogue that have no row in the table of models, and so are never chosen.
pub fn unmodelled<'a>(kinds: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    kinds.into_iter().filter(|kind| MODELS.iter().all(|m| m.kind != *kind)).collect()
}

/// The parts of a choice, each with its reason and the bound that a law gives for it.
pub fn decisions(chosen: &Priced, good: &[Priced], other: &[Priced], facts: &Facts, wish: &Wish) -> Vec<Decision> {
    let candidate = &chosen.outlook.candidate;
    let all = || good.iter().chain(other);
    let mut list = vec![Decision {
        about: "shadow code",
        choice: "yes".into(),
        reason: format!(
            "{:.1}% of what is seen is in full shadow and {:.1}% in penumbra",
            facts.shares[1] * 100.0,
            facts.shares[2] * 100.0
        ),
        bound: None,
    }];
    list.push(method(chosen, good, other));
    list.extend(law(candidate, facts));
    // The same with half the texels says why it is not less.
    let smaller = all().map(|p| &p.outlook).find(|o| is_like(&o.candidate, candidate, candidate.side / 2));
    let reason = match smaller {
        Some(o) if o.bound > wish.max_error => {
            format!("with {} texels the bound would be {:.4}, above what is asked for", o.candidate.side, o.bound)
        }
        Some(o) => format!("with {} texels it would cost no less (bound {:.4})", o.candidate.side, o.bound),
        None => "the smallest that is tried".into(),
    };
    list.push(Decision { about: "map side", choice: candidate.side.to_string(), reason, bound: None });
    if let Some(filter) = candidate.filter {
        let texels = facts.penumbra.map(|p| p * f64::from(candidate.side));
        let reason = format!("penumbrae are {:.1} texels wide, 95 in 100 at most {:.1}", texels[0], texels[1]);
        let choice = match filter {
            Filter::Nearest => "one texel".to_owned(),
            Filter::Kernel(width) | Filter::Mips(width, _) => format!("{width} texels"),
            Filter::Footprint(_) => "the pixel's footprint".into(),
            Filter::Disc(count, radius) => format!("{count} samples within {radius} texels"),
        };
        list.push(Decision { about: "filter width", choice, reason, bound: None });
    } else if let Judge::Blockers { search, filter } = candidate.judge {
        let reason = "penumbrae differ so much in width that each pixel finds its own".to_owned();
        let choice = format!("{search} samples search, {filter} filter");
        list.push(Decision { about: "taps", choice, reason, bound: None });
    }
    if candidate.blur > 0 {
        let wide = facts.footprint * f64::from(candidate.side);
        let reason = format!("95 in 100 pixels cover at most {wide:.2} texels along their longer side");
        let choice = if candidate.mips { "mips, and 16 times as long as wide" } else { "off" };
        let bound = (!candidate.mips && wide <= 1.0).then_some(0.0);
        list.push(Decision { about: "mips and anisotropy", choice: choice.into(), reason, bound });
    }
    let parts = format!("distances from {:.1} to {:.1} m ask for {}", facts.seen[0], facts.seen[1], facts.split_demand);
    list.push(Decision { about: "splits", choice: candidate.parts.to_string(), reason: parts, bound: None });
    list.push(Decision {
        about: "freezing",
        choice: "the finished map".into(),
        reason: "light and occluders stand still in a scene, so it is made once and kept between pictures".into(),
        bound: Some(0.0),
    });
    list
}

fn is_like(one: &Candidate, other: &Candidate, side: u32) -> bool {
    one.side == side
        && one.kind == other.kind
        && one.parts == other.parts
        && one.filter == other.filter
        && one.judge == other.judge
        && one.reads == other.reads
}

/// The method, with the cheapest of the other kinds that hold the wish, or why none is cheaper.
fn method(chosen: &Priced, good: &[Priced], other: &[Priced]) -> Decision {
    let kind = chosen.outlook.candidate.kind;
    let next = good.iter().find(|p| p.outlook.candidate.kind != kind);
    let cheaper = other.iter().filter(|p| p.milliseconds < chosen.milliseconds).count();
    let mut reason = match next {
        Some(p) => format!(
            "the next kind that holds the bound is `{}`, {:.2} times as dear",
            p.outlook.candidate.kind,
            p.milliseconds / chosen.milliseconds.max(1e-9)
        ),
        None => "no other kind holds the bound".into(),
    };
    reason += &format!("; {cheaper} cheaper candidates do not hold it");
    Decision { about: "method", choice: kind.into(), reason, bound: Some(chosen.outlook.bound) }
}

/// What the laws say of the method on this scene: bleeding, contacts, receiver edges, formats.
fn law(candidate: &Candidate, facts: &Facts) -> Vec<Decision> {
    let decision = |about, choice: String, reason: String, bound| Decision { about, choice, reason, bound };
    let contact = |least: f64| least / (least + facts.gap * facts.gap);
    match candidate.judge {
        Judge::Variance { least, reduction, storage } => {
            let (format, unit) = match storage {
                Storage::Single => ("rg32float", "32 bits"),
                Storage::Unorm => ("rg16unorm", "16 bits"),
            };
            let gap = format!(
                "the smallest gaps are {:.4} of the range; {unit} need a least variance of {least:e}, which leaks e / (e + gap^2)",
                facts.gap
            );
            let cure = format!(
                "occluders lie up to {:.2} times as far apart as above the receiver, which bleeds (r / (r + 2))^2 = {:.3} at most",
                facts.spread, facts.bleeding
            );
            let left = ((facts.bleeding - reduction) / (1.0 - reduction)).max(0.0).max(reduction);
            vec![
                decision("format", format.into(), gap, Some(contact(least))),
                decision("bleeding reduction", format!("{reduction}"), cure, Some(left)),
            ]
        }
        Judge::Exponential { exponent } => {
            let leak = (-exponent * facts.gap).exp();
            let reason = format!("the smallest gaps are {:.4} of the range and leak e^(-c gap)", facts.gap);
            vec![decision("exponent", format!("{exponent}"), reason, Some(leak))]
        }
        Judge::Warped { exponent, falling, .. } => {
            let bleeding = worst_warped_bleeding(2.0 * exponent, facts.gap);
            let behind = format!(
                "at {:.1}% of what is seen something lies behind the receiver within the filter, where one warp lights up",
                facts.behind * 100.0
            );
            let choice = if falling.is_some() { "two" } else { "one" };
            vec![
                decision("warps", choice.into(), behind, None),
                decision(
                    "exponent",
                    format!("{exponent}"),
                    format!("gaps of {:.4} of the range bleed (1 / (2 e^(C gap) - 1))^2 at most", facts.gap),
                    Some(bleeding),
                ),
            ]
        }
        Judge::Moments { .. } => {
            let reason =
                format!("{:.0}% of shadows lie under more than one layer; two are exact", facts.layered * 100.0);
            vec![decision("moments", "four".into(), reason, None)]
        }
        Judge::Comparison | Judge::Blockers { .. } => Vec::new(),
    }
}
