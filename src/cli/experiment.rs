//! The run of a study.

use std::collections::BTreeMap;
use std::sync::atomic::AtomicBool;

use serde_json::json;

use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use super::folder::Folder;
use super::output;
use super::picture::late;
use super::render::adapter_options;
use super::study::RunStudy;
use crate::diagnostic::{Diagnostic, Place, has_errors};
use crate::render::Gpu;
use crate::studio::weave::{Known, Weaver};
use crate::studio::{self, FailureKind, Loader};
use crate::study::Record;
use crate::study::cells::{Batch, batches};
use crate::study::check::has_setting;
use crate::study::claims::{Claim, Verdict, judge};
use crate::study::read::read;
use crate::study::run::Runner;

/// Rounds of the quick form of a study, counted and before: without pictures and truth there is time for many.
const QUICK: (usize, usize) = (32, 3);

pub(super) fn run(command: &RunStudy, context: &Context) -> Outcome {
    let Some(file) = &command.study else { return Err(Failure::usage("no study", "name a study file")) };
    let loader = Loader::default();
    let (catalog, found) = loader.catalog(&command.nodes)?;
    context.report(&found);
    let source = loader.text(file)?;
    let (study, found) = read(&source);
    context.report(&found);
    let Some(mut study) = study.filter(|_| !has_errors(&found)) else { return Ok(Exit::Input) };
    if command.quick {
        (study.rounds, study.warm_up) = QUICK;
        study.truth.references.clear();
    }
    let name = file.display().to_string();
    let none = |message: String, help: &str| {
        Failure::from(vec![Diagnostic::error("ST0601", message, Place::file(name.clone())).help(help)])
    };
    let all = batches(&study, command.quick, &|kind, setting| has_setting(&catalog, kind, setting))
        .map_err(|m| none(m, "vary less at once, or write several studies"))?;
    if all.iter().all(|b| b.cells.is_empty()) {
        let help = if command.quick { "mark a grid with `quick: true`" } else { "name cases and methods in its grids" };
        return Err(none("the study has no cells".into(), help));
    }
    if command.list {
        let cells: Vec<&str> = all.iter().flat_map(|b| &b.cells).map(|c| c.name.as_str()).collect();
        let text = if context.is_json() { format!("{}\n", json!(cells)) } else { cells.join("\n") + "\n" };
        output::print(text.as_bytes())?;
        return Ok(Exit::Done);
    }
    let quiet = Context { quiet: true, ..*context };
    let known = Known::default();
    let weaver = Weaver::new(&quiet, &loader, &catalog, &known);
    let mut runner = Runner::new(&study, file, weaver)?;
    let Some(path) = &command.output else { return Err(Failure::usage("no folder", "give -o a folder")) };
    let mut folder = Folder::open(path, &source.text)?;

    let (part, parts) = command.shard.unwrap_or((1, 1));
    let own = all.iter().enumerate().filter(|(index, _)| index % parts == part - 1).map(|(_, batch)| batch);
    let rounds = runner.rounds.counted;
    let is_done = |batch: &&Batch| batch.cells.iter().all(|c| is_measured(&folder.records, &c.name, rounds));
    let (before, left): (Vec<&Batch>, Vec<&Batch>) = own.partition(is_done);
    let cells = |batches: &[&Batch]| batches.iter().map(|b| b.cells.len()).sum::<usize>();
    if !before.is_empty() {
        context.say(&format!("{} cells are in {} already", cells(&before), path.display()));
    }
    context.say(&format!("{} cells to measure", cells(&left)));
    let work: u64 = left.iter().map(|b| runner.work(b)).sum();
    let bar = late(context, "measuring", Some(work));
    let cancel = AtomicBool::new(false);
    let open = || Gpu::new(&adapter_options(command.adapter.as_deref())).map_err(studio::Failure::from);
    let mut gpu = if left.is_empty() { None } else { Some(open()?) };
    let (mut measured, mut failed) = (0, Vec::new());
    for batch in left {
        let start = bar.position();
        let done = |share| bar.inc(share);
        let mut attempt = |gpu: &mut Option<Gpu>| {
            let device = match gpu {
                Some(device) => device,
                None => gpu.insert(open()?),
            };
            runner.measure(batch, device, &cancel, &done)
        };
        let results = attempt(&mut gpu).or_else(|failure| {
            if failure.kind != FailureKind::NoAdapter {
                return Err(failure);
            }
            // A device may be lost for once; what hangs it hangs the next one, too.
            context.say("the device was lost; once more with a new one");
            gpu = None;
            bar.set_position(start);
            attempt(&mut gpu)
        })?;
        let mut pictures = Vec::new();
        let mut records = Vec::new();
        for one in results {
            // A plain map that several batches are compared with is one cell.
            if one.record.baseline && is_measured(&folder.records, &one.record.cell, rounds) {
                continue;
            }
            pictures.extend(one.pictures);
            records.push(one.record);
        }
        measured += records.len();
        failed.extend(records.iter().filter(|r| r.failure.is_some()).map(|r| r.cell.clone()));
        folder.add(records, &pictures)?;
        bar.set_position(start + runner.work(batch));
    }
    bar.finish_and_clear();
    for cell in &failed {
        let why = folder.records[cell].failure.clone().unwrap_or_default();
        context.say(&format!("{cell}: {why}"));
    }
    let verdicts: Vec<Verdict> = if command.quick {
        let records: Vec<Record> = folder.records.values().cloned().collect();
        let laws: Vec<Claim> = study.claims.iter().filter(|c| c.law).cloned().collect();
        judge(&laws, &records).into_iter().filter(|v| !v.parts.is_empty()).collect()
    } else {
        Vec::new()
    };
    let broken = verdicts.iter().filter(|v| is_broken(v)).count();
    let text = if context.is_json() {
        let folder = path.display().to_string();
        let told = json!({
            "folder": folder, "measured": measured, "known": cells(&before), "failed": failed, "laws": verdicts
        });
        format!("{told}\n")
    } else {
        let laws: String = verdicts.iter().map(in_words).collect();
        format!("{measured} cells measured, {} of them without figures: {}\n{laws}", failed.len(), path.display())
    };
    output::print(text.as_bytes())?;
    if broken > 0 {
        let message = format!("{broken} of the laws that the study claims do not hold");
        let diagnostic = Diagnostic::error("ST0613", message, Place::file(name));
        return Err(vec![diagnostic.help("measure again on a machine that does nothing else, with more rounds")].into());
    }
    Ok(Exit::Done)
}

/// Whether a cell was measured in as many rounds, or cannot be.
fn is_measured(known: &BTreeMap<String, Record>, cell: &str, rounds: usize) -> bool {
    known.get(cell).is_some_and(|r| r.failure.is_some() || r.wall.len() >= rounds)
}

/// Whether a claim is refuted: a number is outside of its bounds, and so is the whole of its interval.
fn is_broken(verdict: &Verdict) -> bool {
    verdict.parts.iter().any(|p| !p.held && p.sure)
}

/// A law with the number that decides on it, in a line.
fn in_words(verdict: &Verdict) -> String {
    let state = match verdict.parts.iter().all(|p| p.held) {
        true => "holds",
        false if is_broken(verdict) => "does not hold",
        false => "is open",
    };
    let number = verdict.decisive().map_or_else(String::new, |p| {
        let (low, high) = p.interval;
        format!(" ({}: {} {:.3}, {low:.3} to {high:.3}; allowed {})", p.place, p.what, p.value, p.allowed())
    });
    format!("{} {state}: {}{number}\n", verdict.id, verdict.text)
}
