//! The choice for one light: judged, verified on a device, and searched for by measuring.

use std::collections::BTreeMap;
use std::sync::atomic::AtomicBool;

use super::calibrate::middle;
use super::order::Trial;
use super::stand::{Lamp, Stand, demand, finer};
use super::trial::Trier;
use crate::choose::{
    Candidate, CostTable, Decision, Demand, Effort, Facts, Metric, Priced, Verdict, Wish, candidates, decisions, holds,
    predict, ranked, unmodelled,
};
use crate::diagnostic::{Diagnostic, Place};
use crate::node::Catalog;
use crate::reference::Metrics;
use crate::reference::picture::Watch;
use crate::render::Gpu;
use crate::studio::failure::Failure;
use crate::studio::measure::shadow_kinds;
use crate::studio::trial::Rounds;

/// Rays a pixel of the truth that a choice is verified against.
const RAYS: u32 = 256;
/// Candidates that are measured where that is asked for, and how often.
const SEARCHED: usize = 16;
const ROUNDS: Rounds = Rounds { warm_up: 1, counted: 7 };
/// Candidates whose prices are that near to each other cannot be told apart by them.
const UNCLEAR: f64 = 2.0;
/// Nor those whose expected errors are above the bound by less than this.
const LIKELY: f64 = 1.2;

/// What was chosen for one light, and what became of it.
#[derive(Clone, Debug)]
pub struct Choice {
    /// Name of the light.
    pub light: String,
    /// What was chosen.
    pub verdict: Verdict,
    /// Statistics of the light's view.
    pub facts: Facts,
    /// The parts of the choice.
    pub decisions: Vec<Decision>,
    /// Candidates that were judged, and those of them that hold the wish.
    pub judged: usize,
    /// See `judged`.
    pub good: usize,
    /// Kinds that have no model, or no price.
    pub unmodelled: Vec<String>,
    /// What was rendered, in that order: its name and its errors. The last one counts.
    pub verified: Vec<(String, Metrics)>,
    /// What was measured, the cheapest first.
    pub front: Vec<Measured>,
}

/// A candidate that was rendered and timed.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The candidate.
    pub name: String,
    /// Its error.
    pub error: f64,
    /// Median of all passes, milliseconds.
    pub milliseconds: f64,
    /// Nothing measured is both as exact and cheaper.
    pub on_front: bool,
}

/// Judges everything for one light. Besides the choice, all candidates in the order in which they would be taken.
pub fn chosen(
    stand: &Stand,
    lamp: &Lamp,
    table: &CostTable,
    wish: &Wish,
    size: (u32, u32),
    catalog: &Catalog,
) -> Result<(Choice, Vec<Priced>), Failure> {
    let mut choice = Choice {
        light: lamp.name.clone(),
        verdict: Verdict::Unshadowed("nothing casts a shadow"),
        facts: Facts::default(),
        decisions: Vec::new(),
        judged: 0,
        good: 0,
        unmodelled: Vec::new(),
        verified: Vec::new(),
        front: Vec::new(),
    };
    if let Some(reason) = lamp.needless {
        choice.verdict = Verdict::Unshadowed(reason);
        choice.decisions.push(Decision {
            about: "shadow code",
            choice: "none".into(),
            reason: reason.into(),
            bound: Some(0.0),
        });
        return Ok((choice, Vec::new()));
    }
    let cancel = AtomicBool::new(false);
    let watch = Watch { cancel: &cancel, done: &|_| {} };
    let cancelled = Failure::cancelled;
    let (receivers, facts) = stand.look(lamp, size, Effort::default(), watch).ok_or_else(cancelled)?;
    let asked = demand(lamp, &facts);
    let site = stand.site(lamp, size);
    let judged = |demand: &Demand| predict(&site, &receivers, candidates(demand), wish.metric, watch);
    let mut outlooks = judged(&asked).ok_or_else(cancelled)?;
    let load = stand.load(lamp, &receivers, size);
    let (mut good, mut other, mut unpriced) = ranked(&outlooks, table, &load, wish);
    if good.is_empty()
        && let Some(finer) = finer(lamp, &asked)
    {
        outlooks.extend(judged(&finer).ok_or_else(cancelled)?);
        (good, other, unpriced) = ranked(&outlooks, table, &load, wish);
    }
    let kinds = shadow_kinds(catalog);
    choice.unmodelled = unmodelled(kinds.iter().map(String::as_str)).into_iter().map(str::to_owned).collect();
    (choice.judged, choice.good) = (outlooks.len() - unpriced, good.len());
    let Some(first) = good.first().or(other.first()) else {
        let message = format!("nothing is known of what shadows cost on `{}`", table.device);
        let help = "measure the constants again with --calibrate";
        return Err(vec![Diagnostic::error("ST0706", message, Place::default()).help(help)].into());
    };
    choice.verdict = if good.is_empty() { Verdict::Unmet(first.clone()) } else { Verdict::Met(first.clone()) };
    choice.decisions = decisions(first, &good, &other, &facts, wish);
    choice.facts = facts;
    Ok((choice, good.into_iter().chain(other).collect()))
}

/// What the verdict chose.
pub fn candidate(verdict: &Verdict) -> Option<&Priced> {
    match verdict {
        Verdict::Unshadowed(_) => None,
        Verdict::Met(priced) | Verdict::Unmet(priced) => Some(priced),
    }
}

/// The error that is bounded.
pub fn error_of(metrics: &Metrics, metric: Metric) -> f64 {
    match metric {
        Metric::Rms => metrics.rms,
        Metric::Percentile99 => metrics.percentile_99,
        Metric::Most => metrics.most,
        Metric::OverTwentieth => metrics.over_twentieth,
    }
}

/// Renders the choice, and what may be cheaper or, where the bound does not hold, better: the cheapest that holds counts.
pub fn verified(
    mut choice: Choice,
    all: &[Priced],
    lamp: &Lamp,
    trier: &Trier<'_>,
    wish: &Wish,
    gpu: &mut Gpu,
) -> Result<Choice, Failure> {
    let cancel = AtomicBool::new(false);
    let watch = Watch { cancel: &cancel, done: &|_| {} };
    let (truth, _) = trier.truth(lamp, RAYS, watch)?;
    let Some(first) = candidate(&choice.verdict).cloned() else {
        let tried = trier.tried(lamp, None, &truth, gpu)?;
        choice.verified.push(("no shadow".into(), tried.metrics));
        return Ok(choice);
    };
    let mut trial = Trial::new(all, &first, wish);
    while let Some(priced) = trial.next() {
        let tried = trier.tried(lamp, Some(&priced.outlook.candidate), &truth, gpu)?;
        choice.verified.push((priced.outlook.candidate.name(), tried.metrics));
        trial.found(&priced, error_of(&tried.metrics, wish.metric));
    }
    if let Some((priced, error)) = trial.best {
        let good = error <= wish.max_error && wish.budget.is_none_or(|b| priced.milliseconds <= b);
        // What counts comes last.
        let name = priced.outlook.candidate.name();
        if let Some(at) = choice.verified.iter().position(|(n, _)| *n == name) {
            let last = choice.verified.remove(at);
            choice.verified.push(last);
        }
        choice.verdict = if good { Verdict::Met(priced) } else { Verdict::Unmet(priced) };
    }
    Ok(choice)
}

/// Measures those that the bounds and prices cannot tell apart, and chooses from what was measured.
pub fn searched(
    mut choice: Choice,
    all: &[Priced],
    lamp: &Lamp,
    trier: &Trier<'_>,
    wish: &Wish,
    gpu: &mut Gpu,
) -> Result<Choice, Failure> {
    let Some(first) = candidate(&choice.verdict) else { return Ok(choice) };
    let unclear = contenders(all, first, wish);
    let cancel = AtomicBool::new(false);
    let watch = Watch { cancel: &cancel, done: &|_| {} };
    let (truth, _) = trier.truth(lamp, RAYS, watch)?;
    let mut errors = Vec::new();
    for priced in &unclear {
        let tried = trier.tried(lamp, Some(&priced.outlook.candidate), &truth, gpu)?;
        errors.push(error_of(&tried.metrics, wish.metric));
    }
    let candidates: Vec<Candidate> = unclear.iter().map(|p| p.outlook.candidate.clone()).collect();
    let laps = trier.raced(lamp, &candidates, ROUNDS, gpu, &cancel, || {})?;
    let times: Vec<f64> = laps.iter().map(|l| middle(&l.total().unwrap_or_else(|| l.wall.clone()))).collect();
    let within = |i: usize| errors[i] <= wish.max_error && wish.budget.is_none_or(|b| times[i] <= b);
    let best = (0..unclear.len()).filter(|i| within(*i)).min_by(|a, b| times[*a].total_cmp(&times[*b]));
    for i in 0..unclear.len() {
        let beaten = (0..unclear.len())
            .any(|j| errors[j] <= errors[i] && times[j] <= times[i] && (errors[j] < errors[i] || times[j] < times[i]));
        choice.front.push(Measured {
            name: candidates[i].name(),
            error: errors[i],
            milliseconds: times[i],
            on_front: !beaten,
        });
    }
    choice.front.sort_by(|a, b| a.milliseconds.total_cmp(&b.milliseconds));
    if let Some(best) = best {
        let priced = Priced { milliseconds: times[best], ..unclear[best].clone() };
        choice.verdict = Verdict::Met(priced);
    }
    Ok(choice)
}

/// Candidates that measuring could put before the chosen one: whose expected error may be within the bound, and whose
/// price is not far above. The cheapest of each kind first.
pub fn contenders(all: &[Priced], first: &Priced, wish: &Wish) -> Vec<Priced> {
    let possible = |p: &&Priced| {
        (holds(p, wish) || p.outlook.error <= wish.max_error * LIKELY) && p.milliseconds <= first.milliseconds * UNCLEAR
    };
    let mut list: Vec<Priced> = all.iter().filter(possible).cloned().collect();
    list.sort_by(|a, b| a.milliseconds.total_cmp(&b.milliseconds));
    let mut seen: BTreeMap<&'static str, usize> = BTreeMap::new();
    let mut ranks: Vec<(usize, Priced)> = Vec::new();
    for priced in list {
        let rank = seen.entry(priced.outlook.candidate.kind).or_default();
        ranks.push((*rank, priced));
        *rank += 1;
    }
    // The first of every kind, then the second of every kind.
    ranks.sort_by_key(|(rank, _)| *rank);
    let mut list: Vec<Priced> = ranks.into_iter().map(|(_, p)| p).take(SEARCHED).collect();
    if !list.iter().any(|p| p.outlook.candidate == first.outlook.candidate) {
        list.push(first.clone());
    }
    list
}
