//! From resolved wiring to expressions, node by node in evaluation order.

use super::evaluate::{Context, Worth, combines, is_seen, takes_surfaces};
use super::{Bake, Id, NodeInfo, Op, Program, Varying};
use crate::node::{Default, Definition, Port};
use crate::semantic::{Shape, Value};
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
    program.root = Some(root(&mut program, woven, &worth));
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
    let (shadow, surface) = (is_shadow(definition), is_surface(definition));
    let of_a_light = |wire: &Wire| matches!(wire, Wire::Light { .. } | Wire::Irradiance | Wire::Space | Wire::Map);
    let lit = is_lit(definition) || (!shadow && node.inputs.values().any(of_a_light));
    let on_lights = shadow && !node.lights.is_empty();
    let fed = Fed::of(woven, worth, index);
    // Whether it has another value under each light, and not only because what it combines has.
    let depends = lit || on_lights || !(fed.values.is_empty() || surface && takes_surfaces(definition));
    let mut lights = fed.surfaces;
    if depends {
        lights.extend(node.lights.keys());
        lights.extend(fed.values);
    }
    for light in lights {
        if program.unshadowed && on_lights && definition.main.outputs.len() == 1 {
            let one = program.unit(definition);
            result.lit.insert(light, vec![one]);
            continue;
        }
        let Some(mut outputs) = program.call(&at(Some(light)), false) else { continue };
        if program.unshadowed && shadow {
            outputs[0] = program.unit(definition);
        } else if shadow
            && let Some((view, share)) = program.next_view_of_light(light, Some(index))
            && let Some(next) = program.call(&Context { view: Some(view), ..at(Some(light)) }, false)
        {
            let mixed = |(here, there): (&Id, &Id)| program.mix(*here, *there, share);
            outputs = outputs.iter().zip(&next).map(mixed).collect();
        }
        result.lit.insert(light, outputs);
    }
    if definition.ambient.is_some() {
        result.plain = program.call(&at(None), true);
    } else if surface {
        if !depends && (fed.always || !takes_surfaces(definition)) {
            result.plain = program.call(&at(None), false);
        }
    } else if !lit && !on_lights {
        result.plain = program.call(&at(None), false);
        if program.unshadowed
            && shadow
            && let Some(outputs) = &mut result.plain
        {
            outputs[0] = program.unit(definition);
        }
    }
    result
}

/// What feeds a node that is not the same under every light.
struct Fed {
    /// Lights under which a surface that it combines is seen.
    surfaces: BTreeSet<usize>,
    /// Lights under which a value that it takes is another.
    values: BTreeSet<usize>,
    /// Whether something that it combines is seen without a light.
    always: bool,
}

impl Fed {
    fn of(woven: &Woven, worth: &[Worth], index: usize) -> Self {
        let mut fed = Self { surfaces: BTreeSet::new(), values: BTreeSet::new(), always: false };
        let definition = &woven.nodes[index].definition;
        let ports: &[Port] = if takes_surfaces(definition) { &definition.main.inputs } else { &[] };
        for (name, wire) in woven.nodes[index].inputs.iter() {
            let combined = ports.iter().find(|port| &port.name == name && combines(definition, port));
            match (wire, combined) {
                (Wire::Output { node, .. }, Some(_)) => {
                    fed.surfaces.extend(worth[*node].lit.keys());
                    fed.always |= worth[*node].plain.is_some();
                }
                // As a value, a surface is the same under every light: what is seen of it under all.
                (Wire::Output { node, output, .. }, None) if !is_seen(&woven.nodes[*node].definition, output) => {
                    fed.values.extend(worth[*node].lit.keys());
                }
                (Wire::Value(value), Some(port)) => fed.always |= shines(value, port),
                _ => {}
            }
        }
        fed
    }
}

/// Whether light of this value is to be seen: a default of nothing is not.
fn shines(value: &Value, port: &Port) -> bool {
    let dark = value.numbers().is_some_and(|n| n.iter().all(|x| *x == 0.0));
    !dark || !matches!(&port.default, Some(Default::Value(default)) if default == value)
}

/// The colour that is written.
fn root(program: &mut Program, woven: &Woven, worth: &[Worth]) -> Id {
    let nowhere = |light| Context { woven, worth, index: 0, light, view: None };
    match &woven.root {
        Root::Surface { node } => {
            let output = &woven.nodes[*node].definition.main.outputs[0].name;
            program.value(&nowhere(None), *node, output)
        }
        Root::Value { node, output, chain } => {
            let value = program.value(&nowhere(None), *node, output);
            program.converted(value, chain, Some(*node), output)
        }
        Root::Irradiance { lights } => {
            let terms: Vec<Id> =
                lights.iter().filter_map(|(l, s)| program.irradiance(&nowhere(Some(*l)), *l, s)).collect();
            program.fold("+", &terms, "irradiance").unwrap_or_else(|| program.zero(&Shape::F32(3)))
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
            let lit = |program: &mut Program| program.literal("vec3f(1.0)", "visibility");
            program.fold("*", &terms, "visibility").unwrap_or_else(|| lit(program))
        }
        Root::Normal { node } => {
            let wire = node.and_then(|n| Some((n, woven.nodes[n].inputs.get("normal")?)));
            if let Some((index, Wire::Output { node: from, output, chain })) = wire {
                let value = program.value(&nowhere(None), *from, output);
                return program.converted(value, chain, Some(index), "normal");
            }
            let normal = program.add(Op::Varying(Varying::NormalWorld), Vec::new(), "normal_world", None);
            program.template("normalize($0)", vec![normal], "normal_world_unit", None)
        }
        Root::Depth => {
            let depth = program.source("depth");
            program.template("vec3f($0)", vec![depth], "depth_shown", None)
        }
    }
}
