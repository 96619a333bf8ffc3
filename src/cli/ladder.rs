//! Runs `simplify`: the ladders, their table, and the files of the rungs.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use serde_json::{Value as Json, json};

use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use super::output;
use super::picture::late;
use super::render::adapter_options;
use super::simplify::{By, Simplify};
use crate::diagnostic::{Diagnostic, Place};
use crate::node::Catalog;
use crate::render::{AdapterSummary, Gpu};
use crate::simplify::ladder::{Ladder, Rung, Wanted, ladders};
use crate::simplify::material::Material;
use crate::simplify::search::READ;
use crate::simplify::trial::{self, Tools};
use crate::simplify::{swap, swaps};
use crate::studio::load::{Loader, is_dash, stems};
use crate::studio::{self};

pub(super) fn run(command: &Simplify, context: &Context) -> Outcome {
    let mut loader = Loader::default();
    // Files are read more than once, and stdin cannot be.
    if let Some(dash) = command.files.iter().find(|f| is_dash(f)) {
        let text = loader.text(dash)?.text.as_str().into();
        loader = Loader::with_overlay([(dash.clone(), text)].into());
    }
    let (catalog, found) = loader.catalog(&command.nodes)?;
    context.report(&found);
    let material = Material::read(&command.files, command.scene.as_deref(), (&loader, &catalog, context))?;
    context.report(&swap::check(&material.graph, &catalog));
    if swaps(&material.graph, &catalog).is_empty() {
        let place = Place::file(material.file().display().to_string());
        let message = "no node of this material has a cheaper form: the ladder has one rung";
        let help = "node files declare them in `//! cheaper:` lines; see nodes/README.md";
        context.report(&[Diagnostic::warning("ST0753", message, place).help(help)]);
    }
    if let Some(folder) = &command.output {
        // Told before the work is done, not after.
        std::fs::create_dir_all(folder).map_err(|e| Failure::write(folder, &e))?;
    }
    let bar = late(context, "simplifying", None);
    let mut gpu = Gpu::new(&adapter_options(command.adapter.as_deref())).map_err(studio::Failure::from)?;
    let adapter = gpu.adapter().clone();
    let wanted = Wanted {
        size: command.size,
        distances: command.distance.clone(),
        error: command.max_error,
        rungs: usize::from(command.rungs),
        by: if command.by == By::Time { trial::By::Time } else { trial::By::Operations },
    };
    let cancel = AtomicBool::new(false);
    let mut tools = Tools { loader: &loader, catalog: &catalog, gpu: &mut gpu, cancel: &cancel, each: &|| bar.inc(1) };
    let all = ladders(&material, &wanted, &mut tools);
    bar.finish_and_clear();
    let all = all?;
    let files = files(&material, &all, command.output.as_deref(), &catalog);
    if all.iter().any(|l| l.cut) {
        context.say("the search ended before everything was tried: the material has very many cheaper forms");
    }
    for ladder in all.iter().filter(|l| l.rungs.len() == 1 && !l.singles.is_empty()) {
        let at = metres(ladder.distance);
        context
            .say(&format!("at {at} m no cheaper form stays within the error of {}: raise --max-error", wanted.error));
    }
    let text =
        if context.is_json() { listed(&all, &files, &adapter) } else { tables(&all, &files, command.by, &adapter) };
    output::print(text.as_bytes())?;
    let written: Vec<(&Path, &[u8])> =
        files.iter().flatten().flatten().map(|(p, t)| (p.as_path(), t.as_bytes())).collect();
    output::write_all(&written)?;
    for (path, _) in written {
        context.detail(&format!("wrote {}", path.display()));
    }
    Ok(Exit::Done)
}

/// Path and text of each rung; none of the full material, which is a file already, and none where no folder is given.
type Files = Vec<Vec<Option<(PathBuf, String)>>>;

fn files(material: &Material, all: &[Ladder], folder: Option<&Path>, catalog: &Catalog) -> Files {
    let stem = stems(&[material.file().to_path_buf()]).remove(0);
    let file = |ladder: &Ladder, index: usize, rung: &Rung| {
        let folder = folder.filter(|_| index > 0)?;
        let distance = if all.len() > 1 { format!(".{}m", metres(ladder.distance)) } else { String::new() };
        let path = folder.join(format!("{stem}{distance}.lod{index}.ron"));
        Some((path, material.in_folder(&rung.graph, folder, catalog)))
    };
    let one = |ladder: &Ladder| ladder.rungs.iter().enumerate().map(|(i, rung)| file(ladder, i, rung)).collect();
    all.iter().map(one).collect()
}

fn metres(distance: f64) -> f64 {
    (distance * 100.0).round() / 100.0
}

/// What the cost of a single swap is.
fn cost_words(by: By) -> String {
    match by {
        By::Operations => format!("operations and {READ} more for each texture read"),
        By::Time => "the time of a frame beside the full material's".into(),
    }
}

fn tables(all: &[Ladder], files: &Files, by: By, adapter: &AdapterSummary) -> String {
    let mut text = String::new();
    for (ladder, files) in all.iter().zip(files) {
        text += &format!("at {} m, over {} pixels\n", metres(ladder.distance), ladder.pixels);
        text +=
            &format!("{:5} {:>8} {:>10} {:>5} {:>14}  {}\n", "rung", "error", "operations", "reads", "time", "swaps");
        for (index, rung) in ladder.rungs.iter().enumerate() {
            let name = if index == 0 { "full".to_owned() } else { format!("lod{index}") };
            let time = rung.time.map_or("1".into(), |t| format!("{:.2} +- {:.2}", t.median, t.mad));
            let cost = rung.cost;
            let swaps = rung.swaps.join("; ");
            text += &format!(
                "{name:5} {:>8.4} {:>10} {:>5} {time:>14}  {swaps}",
                rung.error, cost.operations, cost.texture_reads
            );
            text.truncate(text.trim_end().len());
            text.push('\n');
            if let Some((path, _)) = files.get(index).and_then(Option::as_ref) {
                text += &format!("{:5} {}\n", "", path.display());
            }
        }
        if !ladder.singles.is_empty() {
            text += &format!(
                "each swap by itself, with {}:\n{:5} {:>8} {:>10}  swap\n",
                cost_words(by),
                "",
                "error",
                "cost"
            );
            for single in &ladder.singles {
                text += &format!(
                    "{:5} {:>8.4} {:>10.4}  {}\n",
                    "", single.figures.error, single.figures.cost, single.words
                );
            }
        }
        text.push('\n');
    }
    let clock = if all.iter().all(|l| l.on_adapter) { "on" } else { "from submission to pixels, on" };
    let software = if adapter.software { ", which computes on the CPU" } else { "" };
    text + &format!(
        "times beside the full material's in the same rounds (median +- MAD), {clock} {}{software}\n",
        adapter.name
    )
}

fn listed(all: &[Ladder], files: &Files, adapter: &AdapterSummary) -> String {
    let mut lines: Vec<Json> = Vec::new();
    for (ladder, files) in all.iter().zip(files) {
        let distance = metres(ladder.distance);
        for single in &ladder.singles {
            let figures = single.figures;
            lines.push(json!({
                "schema": 1, "record": "swap", "distance": distance, "swap": single.words, "error": figures.error,
                "cost": figures.cost,
            }));
        }
        for (index, rung) in ladder.rungs.iter().enumerate() {
            let path = files.get(index).and_then(Option::as_ref).map(|(path, _)| path.display().to_string());
            lines.push(json!({
                "schema": 1, "record": "rung", "distance": distance, "pixels": ladder.pixels, "rung": index,
                "file": path, "error": rung.error, "operations": rung.cost.operations,
                "texture_reads": rung.cost.texture_reads, "time_ratio": rung.time, "on_adapter": ladder.on_adapter,
                "swaps": rung.swaps, "adapter": adapter.name, "software": adapter.software, "complete": !ladder.cut,
            }));
        }
    }
    lines.iter().map(|line| format!("{line}\n")).collect()
}
