//! From resolved wiring to expressions, node by node in evaluation order.

use super::evaluate::{Context, Worth, takes_surfaces};
use super::{Bake, Id, NodeInfo, Op, Program, Varying};
use crate::node::Definition;
use crate::semantic::Quantity;
use crate::weave::{Root, Wire, Woven, is_light, is_lit, is_shadow, is_surface};

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The program of a woven tree.
pub fn build(woven: &Woven, bake: Bake, unshadowed: bool) -> Program {
    let mut program = Program { bake, unshadowed, ..Program::default() };
    let mut count: BTreeMap<&str, u32> = BTreeMap::new();
    let last = |id: &'_ str| id.rfind('/').map_or(0, |at| at + 1);
    for node in &woven.nodes {
        *count.entry(&node.id[last(&node.id)..]).or_default() += 1;
    }
    let short = |id: &Arc<str>| match last(id) {
        0 => id.clone(),
        at if count[&id[at..]] == 1 => id[at..].into(),
        _ => id.clone(),
    };
    program.nodes = woven
        .nodes
        .iter()
        .map(|n| {
            let id = n.id.clone();
            NodeInfo { short: short(&id), id, definition: n.definition.clone(), generic: n.generic.clone() }
        })
        .collect();
    let mut worth: Vec<Worth> = Vec::with_capacity(woven.nodes.len());
    for index in 0..woven.nodes.len() {
        let value = evaluate(&mut program, woven, &worth, index);
        worth.push(value);
    }
    program.root = root(&mut program, woven, &worth);
    program
}

/// What a node is worth under no light and under each.
fn evaluate(program: &mut Program, woven: &Woven, worth: &[Worth], index: usize) -> Worth {
    let node = &woven.nodes[index];
    let definition: &Definition = &node.definition;
    let at = |light| Context { woven, worth, index, light, view: None };
    let mut result = Worth::default();
    if is_light(definition) {
        result.plain = program.call(&at(None), false);
        return result;
    }
    if program.unshadowed && is_shadow(definition) {
        let scalar = definition.main.outputs[0].ty.shape.width() == Some(1);
        let one = program.add(Op::Literal(if scalar { "1.0" } else { "vec3f(1.0)" }.into()), Vec::new(), "lit", None);
        result.lit.extend(node.lights.keys().map(|light| (*light, vec![one])));
        return result;
    }
    let mut lights: BTreeSet<usize> = node.lights.keys().copied().collect();
    let mut lit_inputs = false;
    for wire in node.inputs.values() {
        if let Wire::Output { node: from, .. } = wire {
            lights.extend(worth[*from].lit.keys());
            lit_inputs |= !worth[*from].lit.is_empty() && !is_surface(&woven.nodes[*from].definition);
        }
    }
    let depends = is_lit(definition) || (is_shadow(definition) && !node.lights.is_empty()) || lit_inputs;
    let combines = takes_surfaces(definition);
    for light in lights {
        let base_is_lit = || {
            node.inputs
                .values()
                .any(|w| matches!(w, Wire::Output { node, .. } if worth[*node].lit.contains_key(&light)))
        };
        if (depends || (combines && base_is_lit()))
            && let Some(mut outputs) = program.call(&at(Some(light)), false)
        {
            if is_shadow(definition)
                && let Some((view, share)) = program.next_view_of_light(light, Some(index))
                && let Some(next) = program.call(&Context { view: Some(view), ..at(Some(light)) }, false)
            {
                let mixed = |(here, there): (&Id, &Id)| program.mix(*here, *there, share);
                outputs = outputs.iter().zip(&next).map(mixed).collect();
            }
            result.lit.insert(light, outputs);
        }
    }
    let ambient_base = || {
        node.inputs.iter().any(|(name, w)| {
            let radiance = definition.input(name).is_some_and(|p| p.ty.meaning.quantity == Quantity::Radiance);
            radiance && matches!(w, Wire::Output { node, .. } if worth[*node].plain.is_some())
        })
    };
    result.plain = if definition.ambient.is_some() {
        program.call(&at(None), true)
    } else if !depends && (!combines || ambient_base()) {
        program.call(&at(None), false)
    } else {
        None
    };
    result
}

/// The colour that is written.
fn root(program: &mut Program, woven: &Woven, worth: &[Worth]) -> Option<Id> {
    let nowhere = |light| Context { woven, worth, index: 0, light, view: None };
    match &woven.root {
        Root::Surface { node } => {
            let worth = &worth[*node];
            let terms: Vec<Id> = worth.lit.values().chain(&worth.plain).filter_map(|o| o.first().copied()).collect();
            if terms.is_empty() {
                return Some(program.add(Op::Literal("vec3f(0.0)".into()), Vec::new(), "nothing", None));
            }
            Some(program.fold("+", &terms, "radiance"))
        }
        Root::Value { node, output, chain } => {
            let position = woven.nodes[*node].definition.main.outputs.iter().position(|o| &o.name == output)?;
            let worth = &worth[*node];
            let terms: Vec<Id> = match &worth.plain {
                Some(plain) => vec![plain[position]],
                None => worth.lit.values().map(|o| o[position]).collect(),
            };
            let terms: Vec<Id> = terms.into_iter().map(|t| program.converted(t, chain, Some(*node), output)).collect();
            if terms.is_empty() {
                return Some(program.add(Op::Literal("vec3f(0.0)".into()), Vec::new(), "nothing", None));
            }
            Some(program.fold("+", &terms, "shown"))
        }
        Root::Irradiance { lights } => {
            let terms: Vec<Id> =
                lights.iter().filter_map(|(l, s)| program.irradiance(&nowhere(Some(*l)), *l, s)).collect();
            Some(program.fold("+", &terms, "irradiance"))
        }
        Root::Visibility { light, shadows } => {
            let mut terms = Vec::new();
            for (shadow, visibility) in program.visibilities(worth, *light, shadows) {
                let scalar = woven.nodes[shadow].definition.main.outputs[0].ty.shape.width() == Some(1);
                terms.push(if scalar {
                    program.template("vec3f($0)", vec![visibility], "visibility", None)
                } else {
                    visibility
                });
            }
            if terms.is_empty() {
                return Some(program.add(Op::Literal("vec3f(1.0)".into()), Vec::new(), "visibility", None));
            }
            Some(program.fold("*", &terms, "visibility"))
        }
        Root::Normal { node } => {
            let wire = node.and_then(|n| Some((n, woven.nodes[n].inputs.get("normal")?)));
            if let Some((index, Wire::Output { node: from, output, chain })) = wire {
                let position = woven.nodes[*from].definition.main.outputs.iter().position(|o| &o.name == output)?;
                if let Some(plain) = &worth[*from].plain {
                    let value = plain[position];
                    return Some(program.converted(value, chain, Some(index), "normal"));
                }
            }
            let normal = program.add(Op::Varying(Varying::NormalWorld), Vec::new(), "normal_world", None);
            Some(program.template("normalize($0)", vec![normal], "normal_world_unit", None))
        }
        Root::Depth => {
            let depth = program.source("depth");
            Some(program.template("vec3f($0)", vec![depth], "depth_shown", None))
        }
    }
}
