//! From the maps that a program asks for to passes with complete text.

use std::collections::BTreeMap;

use super::{Light, Map, Pass, Plan, Space};
use crate::diagnostic::{Diagnostic, Place};
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
            inputs: spec.inputs.iter().map(|input| format!("{}.{input}", info.id)).collect(),
        });
        plan.lights.push(Light { name: info.id.clone(), space });
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
                    let names: Vec<String> = catalog.pass_names().map(|n| format!("`{n}`")).collect();
                    let help = format!("the passes are {}", names.join(", "));
                    out.push(Diagnostic::error("ST0300", message, place(program, demand)).help(help));
                }
            }
        }
        let light = program.nodes[demand.light].id.clone();
        plan.maps.push(Map { light, passes, filtered: demand.filtered });
    }
    (plan, out)
}

fn place(program: &Program, demand: &MapDemand) -> Place {
    Place::default().node(program.nodes[demand.node].id.clone()).port(demand.port.clone())
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
    if file.is_skipped(arguments) {
        return;
    }
    let axes: Vec<Option<&String>> =
        if file.axes.is_empty() { vec![None] } else { file.axes.iter().map(Some).collect() };
    for axis in axes {
        let mut chosen = arguments.clone();
        chosen.extend(axis.map(|a| ("axis".to_owned(), a.clone())));
        let wgsl = match file.text(&chosen, catalog) {
            Ok(text) => text,
            Err(found) => {
                let told = found.into_iter().map(|mut d| {
                    d.place.node.get_or_insert_with(|| program.nodes[demand.node].id.clone());
                    d
                });
                out.extend(told);
                continue;
            }
        };
        // What is not said takes the pass's default, so that equal passes are equal however they were asked for.
        for option in &file.options {
            chosen.entry(option.name.clone()).or_insert_with(|| option.default.clone());
        }
        let targets = match chosen.get("format").map(String::as_str) {
            None | Some("auto") => file.targets.clone(),
            Some(format) => vec![format.to_owned()],
        };
        passes.push(Pass {
            name: file.name.clone(),
            kind: file.kind,
            choices: chosen,
            wgsl,
            targets,
            clear: file.clear.clone(),
        });
    }
}
