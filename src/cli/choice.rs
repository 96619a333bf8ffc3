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
use crate::choose::{CostTable, Verdict, Wish};
use crate::diagnostic::{Diagnostic, Place};
use crate::node::Catalog;
use crate::render::Gpu;
use crate::studio::choice::{
    Choice, FRAMES, Lamp, Stand, Trier, calibrate, candidate, chosen, error_of, read_table, rewritten, scene_with,
    searched, table_path, verified, write_table,
};
use crate::studio::load::Loader;
use crate::studio::weave::{Known, Weaver};
use crate::{graph, scene, studio};

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
        let mut choice = chosen(&stand, lamp, &table, &wish, command.size, &catalog)?;
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
