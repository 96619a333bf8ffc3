//! A choice for each light: what is read and asked of a device, and what is said of it.

mod plan_text;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use super::choose::Choose;
use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use super::output;
use super::picture::late;
use super::render::adapter_options;
use crate::choose::{
    Candidate, CostTable, Decision, Effort, Facts, Metric, Priced, Verdict, Wish, candidates, decisions, holds,
    predict, ranked, unmodelled,
};
use crate::diagnostic::{Diagnostic, Place};
use crate::node::Catalog;
use crate::reference::Metrics;
use crate::reference::picture::Watch;
use crate::render::Gpu;
use crate::studio::choice::{
    FRAMES, Lamp, Stand, Trier, calibrate, demand, read_table, rewritten, scene_with, table_path, write_table,
};
use crate::studio::load::Loader;
use crate::studio::measure::shadow_kinds;
use crate::studio::trial::Rounds;
use crate::studio::weave::{Known, Weaver};
use crate::{graph, scene, studio};

/// Rays a pixel of the truth that a choice is verified against.
const RAYS: u32 = 256;
/// Most candidates that are tried one after the other where the bound does not hold.
const MOST_TRIED: usize = 12;
/// Candidates that are measured where that is asked for, and how often.
const SEARCHED: usize = 16;
const ROUNDS: Rounds = Rounds { warm_up: 1, counted: 7 };
/// Candidates whose prices are that near to each other cannot be told apart by them.
const UNCLEAR: f64 = 2.0;

/// What was chosen for one light, and what became of it.
pub(super) struct Choice {
    pub(super) light: String,
    pub(super) verdict: Verdict,
    pub(super) facts: Facts,
    pub(super) decisions: Vec<Decision>,
    /// Candidates that were judged, and those of them that hold the wish.
    pub(super) judged: usize,
    pub(super) good: usize,
    /// Kinds that have no model, or no price.
    pub(super) unmodelled: Vec<String>,
    /// What was rendered, in that order: its name and its errors. The last one counts.
    pub(super) verified: Vec<(String, Metrics)>,
    /// What was measured, the cheapest first.
    pub(super) front: Vec<Measured>,
}

/// A candidate that was rendered and timed.
pub(super) struct Measured {
    pub(super) name: String,
    pub(super) error: f64,
    /// Median of all passes, milliseconds.
    pub(super) milliseconds: f64,
    /// Nothing measured is both as exact and cheaper.
    pub(super) on_front: bool,
}

pub(super) fn run(command: &Choose, context: &Context) -> Outcome {
    let loader = Loader::default();
    let (catalog, found) = loader.catalog(&command.nodes)?;
    context.report(&found);
    let known = Known::default();
    let weaver = Weaver { set: &command.set, ..Weaver::new(context, &loader, &catalog, &known) };
    let stand = Stand::read(&command.scene, command.light.as_deref(), &weaver)?;
    destination(command, &stand)?;
    let mut device = Device::default();
    let table = table(command, context, &catalog, &stand, &mut device)?;
    let wish = Wish { max_error: command.max_error, metric: command.metric, budget: command.budget_ms };
    let texts = BTreeMap::new();
    let trier = Trier::new(&stand, &catalog, context, &texts, &command.set, command.size);
    let bar = late(context, "choosing", Some(stand.lamps.len() as u64 * 3));
    let mut choices = Vec::new();
    for lamp in &stand.lamps {
        let mut choice = chosen(&stand, lamp, &table, &wish, command, &catalog)?;
        bar.inc(1);
        if command.search {
            choice.0 = searched(choice.0, &choice.1, lamp, &trier, &wish, device.open(command)?)?;
        }
        bar.inc(1);
        if command.verify || command.search {
            choice.0 = verified(choice.0, &choice.1, lamp, &trier, &wish, device.open(command)?)?;
        }
        bar.inc(1);
        choices.push(choice.0);
    }
    bar.finish_and_clear();
    let text = if context.is_json() {
        plan_text::json(&choices, &wish, &table.device, command)
    } else {
        plan_text::text(&choices, &wish, &table.device, command)
    };
    write(command, &stand, &choices, &catalog)?;
    output::print(text.as_bytes())?;
    let mut missed = false;
    for choice in &choices {
        missed |= context.report(&misses(choice, &wish));
    }
    Ok(if missed { Exit::Input } else { Exit::Done })
}

/// A device that is opened when it is first asked for.
#[derive(Default)]
struct Device(Option<Gpu>);

impl Device {
    fn open(&mut self, command: &Choose) -> Result<&mut Gpu, Failure> {
        match &mut self.0 {
            Some(gpu) => Ok(gpu),
            empty => {
                let options = adapter_options(command.adapter.as_deref());
                Ok(empty.insert(Gpu::new(&options).map_err(studio::Failure::from)?))
            }
        }
    }
}

/// The constants to price with: from a file, from the folder for caches, or measured now.
fn table(
    command: &Choose,
    context: &Context,
    catalog: &Catalog,
    stand: &Stand,
    device: &mut Device,
) -> Result<CostTable, Failure> {
    if let Some(path) = &command.costs {
        let broken = || {
            let message = format!("{} does not hold constants of a device", path.display());
            let place = Place::file(path.display().to_string());
            let help = "a calibration writes such files into the folder for caches; this one may be of another version";
            Failure::from(vec![Diagnostic::error("ST0706", message, place).help(help)])
        };
        Loader::default().text(path)?;
        return read_table(path, None).ok_or_else(broken);
    }
    if stand.lamps.iter().all(|l| l.needless.is_some()) {
        return Ok(CostTable::default());
    }
    let gpu = device.open(command)?;
    let adapter = gpu.adapter();
    let name = format!("{} ({})", adapter.name, adapter.driver);
    let path = caches().map(|folder| table_path(&folder, &name));
    if let Some(known) = path.as_ref().filter(|_| !command.calibrate).and_then(|p| read_table(p, Some(&name))) {
        return Ok(known);
    }
    let bar = late(context, "measuring this device, once", Some(FRAMES));
    let cancel = AtomicBool::new(false);
    let table = calibrate(&name, catalog, context, gpu, &cancel, || bar.inc(1))?;
    bar.finish_and_clear();
    if let Some(path) = path
        && let Err(error) = write_table(&path, &table)
    {
        let message = format!("the constants of this device could not be kept: {error}");
        let help = "they will be measured again next time; set XDG_CACHE_HOME to a folder that you may write to";
        context.report(&[Diagnostic::warning("ST0707", message, Place::default()).help(help)]);
    }
    Ok(table)
}

/// The user's folder for caches.
fn caches() -> Option<PathBuf> {
    let of = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|p| p.is_absolute());
    of("XDG_CACHE_HOME").or_else(|| of("LOCALAPPDATA")).or_else(|| of("HOME").map(|home| home.join(".cache")))
}

/// Judges everything for one light. Besides the choice, all candidates in the order in which they would be taken.
fn chosen(
    stand: &Stand,
    lamp: &Lamp,
    table: &CostTable,
    wish: &Wish,
    command: &Choose,
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
    let cancelled = studio::Failure::cancelled;
    let (receivers, facts) = stand.look(lamp, command.size, Effort::default(), watch).ok_or_else(cancelled)?;
    let all = candidates(&demand(lamp, &facts));
    let site = stand.site(lamp, command.size);
    let outlooks = predict(&site, &receivers, all, wish.metric, watch).ok_or_else(cancelled)?;
    let load = stand.load(lamp, &receivers, command.size);
    let (good, other, unpriced) = ranked(&outlooks, table, &load, wish);
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
fn candidate(verdict: &Verdict) -> Option<&Priced> {
    match verdict {
        Verdict::Unshadowed(_) => None,
        Verdict::Met(priced) | Verdict::Unmet(priced) => Some(priced),
    }
}

/// The error that is bounded.
pub(super) fn error_of(metrics: &Metrics, metric: Metric) -> f64 {
    match metric {
        Metric::Rms => metrics.rms,
        Metric::Percentile99 => metrics.percentile_99,
        Metric::Most => metrics.most,
        Metric::OverTwentieth => metrics.over_twentieth,
    }
}

/// Renders the choice; where the bound does not hold, those that would have come next.
fn verified(
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
    let affordable = |p: &&Priced| wish.budget.is_none_or(|b| p.milliseconds <= b);
    let others = all.iter().filter(|p| p.outlook.candidate != first.outlook.candidate).filter(affordable);
    let mut best: Option<(Priced, f64)> = None;
    for priced in std::iter::once(&first).chain(others).take(MOST_TRIED) {
        let tried = trier.tried(lamp, Some(&priced.outlook.candidate), &truth, gpu)?;
        let error = error_of(&tried.metrics, wish.metric);
        choice.verified.push((priced.outlook.candidate.name(), tried.metrics));
        if best.as_ref().is_none_or(|(_, least)| error < *least) {
            best = Some((priced.clone(), error));
        }
        if error <= wish.max_error {
            break;
        }
    }
    if let Some((priced, error)) = best {
        let good = error <= wish.max_error && affordable(&&priced);
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
fn searched(
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
    let times: Vec<f64> = laps
        .iter()
        .map(|l| {
            let mut all = l.total().unwrap_or_else(|| l.wall.clone());
            all.sort_by(f64::total_cmp);
            all.get(all.len() / 2).copied().unwrap_or_default()
        })
        .collect();
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
pub(super) fn contenders(all: &[Priced], first: &Priced, wish: &Wish) -> Vec<Priced> {
    let possible = |p: &&Priced| {
        (holds(p, wish) || p.outlook.error <= wish.max_error * 1.2) && p.milliseconds <= first.milliseconds * UNCLEAR
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

/// What did not come true.
fn misses(choice: &Choice, wish: &Wish) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let metric = wish.metric.name();
    if let Verdict::Unmet(priced) = &choice.verdict {
        let (what, error) = match choice.verified.last() {
            Some((_, metrics)) => ("was found to have", error_of(metrics, wish.metric)),
            None => ("may have", priced.outlook.bound),
        };
        let budget = wish.budget.map_or_else(String::new, |b| format!(" within {b} ms"));
        let message = format!(
            "no shadow on `{}` keeps {metric} to {}{budget}; the nearest {what} {error:.4}",
            choice.light, wish.max_error
        );
        let help = "allow a greater error, more time, or a smaller light";
        found.push(Diagnostic::error("ST0704", message, Place::default()).help(help));
    } else if let Some((_, metrics)) = choice.verified.last().filter(|(_, m)| error_of(m, wish.metric) > wish.max_error)
    {
        let error = error_of(metrics, wish.metric);
        let message = format!("the choice for `{}` has {metric} {error:.4}, above {}", choice.light, wish.max_error);
        found.push(Diagnostic::error("ST0704", message, Place::default()).help("allow a greater error"));
    }
    found
}

/// Whether there is one light graph to write, or a folder.
fn is_file(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("ron"))
}

/// Refuses what cannot be written before anything is computed.
fn destination(command: &Choose, stand: &Stand) -> Result<(), Failure> {
    let Some(path) = command.output.as_ref().filter(|p| is_file(p)) else { return Ok(()) };
    if let [_] = stand.lamps[..] {
        return Ok(());
    }
    let names: Vec<&str> = stand.lamps.iter().map(|l| l.name.as_str()).collect();
    let message = format!("`{}` can hold one light, and the scene has {}", path.display(), names.join(", "));
    let place = Place::default();
    let help = "name a folder, or one of them with --light";
    Err(Failure::new(Exit::Usage, Diagnostic::error("ST0705", message, place).help(help)))
}

/// Writes the chosen light graph, or all of them with their scene into a folder.
fn write(command: &Choose, stand: &Stand, choices: &[Choice], catalog: &Catalog) -> Result<(), Failure> {
    let Some(path) = &command.output else { return Ok(()) };
    let made: Vec<(&Lamp, graph::Graph)> = stand
        .lamps
        .iter()
        .zip(choices)
        .map(|(lamp, choice)| {
            let chosen = candidate(&choice.verdict).map(|p| &p.outlook.candidate);
            (lamp, rewritten(&lamp.graph, &lamp.node, catalog, chosen))
        })
        .collect();
    if let ([(_, graph)], true) = (&made[..], is_file(path) || output::is_dash(path)) {
        return output::write(path, graph::write(graph).as_bytes());
    }
    std::fs::create_dir_all(path).map_err(|e| Failure::write(path, &e))?;
    let mut files: Vec<(PathBuf, String)> = Vec::new();
    let mut lights = BTreeMap::new();
    for (lamp, graph) in made {
        // Names of lights may hold what names of files may not.
        let plain: String = lamp.name.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
        let free = |n: &String| files.iter().all(|(p, _)| !p.ends_with(n));
        let name = (2..).map(|i| format!("{plain}_{i}.ron")).find(free);
        let name = Some(format!("{plain}.ron")).filter(free).or(name).unwrap_or_default();
        files.push((path.join(&name), graph::write(&graph)));
        lights.insert(lamp.name.clone(), (name, graph));
    }
    let scene = scene_with(&stand.scene, &stand.file, path, &lights, catalog);
    let name = stand.file.file_name().map_or_else(|| "scene.ron".into(), |n| n.to_string_lossy().into_owned());
    let name = if files.iter().any(|(p, _)| p.ends_with(&name)) { format!("scene_{name}") } else { name };
    files.push((path.join(name), scene::write(&scene)));
    let all: Vec<(&Path, &[u8])> = files.iter().map(|(p, t)| (p.as_path(), t.as_bytes())).collect();
    output::write_all(&all)
}
