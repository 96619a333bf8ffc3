//! From the maps that a program asks for to passes with complete text.

use std::collections::BTreeMap;

use super::{Light, Map, Pass, PassKind, Plan, Space};
use crate::diagnostic::{Diagnostic, Place, Span, did_you_mean};
use crate::node::{Catalog, PassFile};
use crate::program::{MapDemand, Program};

/// The plan for the maps of `used` (indices into `program.maps`, in plan order) and the lights with these indices.
/// Mistakes here are mistakes of node and pass files; they name the node that asked.
pub fn plan(program: &Program, used: &[usize], lights: &[usize], catalog: &Catalog) -> (Plan, Vec<Diagnostic>) {
    let mut out = Vec::new();
    let mut plan = Plan::default();
    for &light in lights {
        let info = &program.nodes[light];
        let space = info.definition.header.space.as_ref().map(|spec| Space {
            projection: spec.projection.clone(),
            inputs: spec.inputs_of(&info.definition).map(|input| format!("{}.{input}", info.id)).collect(),
            settings: spec.all_settings(&info.definition),
            views: spec.views(&info.definition),
        });
        plan.lights.push(Light { name: info.id.to_string(), space });
    }
    for &index in used {
        let demand = &program.maps[index];
        let mut passes = Vec::new();
        for (name, arguments) in &demand.passes {
            match catalog.pass(name) {
                Some(Ok(file)) => expand(file, arguments, demand, program, catalog, &mut passes, &mut out),
                Some(Err(mut found)) => out.append(&mut found),
                None => {
                    let message =
                        format!("`{}` asks for the pass `{name}`, and there is none", program.nodes[demand.node].id);
                    let help = match did_you_mean(name, catalog.pass_names()) {
                        Some(near) => format!("did you mean `{near}`?"),
                        None => format!("the passes are {}", catalog.pass_names().collect::<Vec<_>>().join(", ")),
                    };
                    out.push(Diagnostic::error("ST0300", message, place(program, demand)).help(help));
                }
            }
        }
        let light = program.nodes[demand.light].id.to_string();
        plan.maps.push(Map { light, passes, filtered: demand.filtered });
    }
    (plan, out)
}

/// The `map` line of the node that asks, at its input.
fn place(program: &Program, demand: &MapDemand) -> Place {
    let info = &program.nodes[demand.node];
    let source = &info.definition.header.source;
    let mut at = 0;
    let line = source.text.split_inclusive('\n').find_map(|line| {
        let range = at..at + line.trim_end().len();
        at += line.len();
        let words: Vec<&str> = line.split_whitespace().take(3).collect();
        matches!(words[..], ["//!", "map", port] if port.trim_end_matches(':') == demand.port).then_some(range)
    });
    let place = line.map_or_else(|| Place::file(&source.name), |range| Place::span(Span::new(source, range)));
    place.node(&*info.id).port(demand.port.clone())
}

/// One pass of a chain: none if it is left out, one per axis if it has axes.
fn expand(
    file: &PassFile,
    arguments: &BTreeMap<String, String>,
    demand: &MapDemand,
    program: &Program,
    catalog: &Catalog,
    passes: &mut Vec<Pass>,
    out: &mut Vec<Diagnostic>,
) {
    let file = &match file.chosen(arguments) {
        Ok(file) => file,
        Err(mut found) => return out.append(&mut found),
    };
    if file.is_skipped(arguments) {
        return;
    }
    let axes: Vec<Option<&String>> =
        if file.axes.is_empty() { vec![None] } else { file.axes.iter().map(Some).collect() };
    for axis in axes {
        let mut chosen = arguments.clone();
        chosen.extend(axis.map(|a| ("axis".to_owned(), a.clone())));
        let light = &program.nodes[demand.light].definition;
        let variant = light.header.space.as_ref().and_then(|s| s.variant(light));
        match chosen_pass(file, chosen, variant, catalog) {
            Ok(pass) => passes.push(pass),
            Err(found) => {
                // A choice that the pass does not have was made by the node; anything else is wrong in the pass itself.
                let told = found.into_iter().map(|mut d| {
                    if d.code == "ST0133" {
                        d.message = format!("{} in the pass `{}`", d.message, file.name);
                        d.place = place(program, demand);
                    }
                    d.place.node.get_or_insert_with(|| program.nodes[demand.node].id.to_string());
                    d
                });
                // Each axis finds the same.
                out.extend(told.filter(|d| !out.contains(d)).collect::<Vec<_>>());
            }
        }
    }
}

/// A pass with its choices made, and what takes its place where an adapter cannot run it.
fn chosen_pass(
    file: &PassFile,
    mut chosen: BTreeMap<String, String>,
    variant: Option<&str>,
    catalog: &Catalog,
) -> Result<Pass, Vec<Diagnostic>> {
    let wgsl = file.text_with(&chosen, catalog, variant)?;
    let otherwise = match &file.otherwise {
        Some(name) => Some(Box::new(replacement(file, name, &chosen, variant, catalog)?)),
        None => None,
    };
    // What is not said takes the pass's default, so that equal passes are equal however they were asked for.
    for option in &file.options {
        chosen.entry(option.name.clone()).or_insert_with(|| option.default.clone());
    }
    let targets = match chosen.get("format").map(String::as_str) {
        Some(format) if file.targets.iter().any(|t| t == format) => vec![format.to_owned()],
        // `auto`, or a choice of storage that the pass answers with target lines of its own.
        _ => file.targets.clone(),
    };
    Ok(Pass {
        name: file.name.clone(),
        kind: file.kind,
        choices: chosen,
        wgsl,
        targets,
        clear: file.clear.clone(),
        reads_light: file.reads_light,
        repeat: file.repeat,
        otherwise,
    })
}

/// The pass that `file` says takes its place. It is one that every adapter runs, so it has no replacement itself.
fn replacement(
    file: &PassFile,
    name: &str,
    chosen: &BTreeMap<String, String>,
    variant: Option<&str>,
    catalog: &Catalog,
) -> Result<Pass, Vec<Diagnostic>> {
    let wrong = |message: String, help: String| {
        vec![Diagnostic::error("ST0138", message, Place::file(&file.source.name)).help(help)]
    };
    match catalog.pass(name) {
        Some(Ok(other)) if other.kind == PassKind::Image => {
            chosen_pass(&other.chosen(chosen)?, chosen.clone(), variant, catalog)
        }
        Some(Ok(other)) => Err(wrong(
            format!("the {} pass `{name}` cannot take the place of `{}`", other.kind.name(), file.name),
            "name an image pass, which every adapter runs".into(),
        )),
        Some(Err(found)) => Err(found),
        None => Err(wrong(
            format!("`{name}` is to take the place of the pass `{}`, and there is none", file.name),
            match did_you_mean(name, catalog.pass_names()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("the passes are {}", catalog.pass_names().collect::<Vec<_>>().join(", ")),
            },
        )),
    }
}
