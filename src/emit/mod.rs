//! From a program to WGSL text that reads as a careful person would write it, with the origin of every byte.
//!
//! Only what the root reaches is written, in an order that depends on nothing but the program. Each node has a comment
//! line and a line of its own; a conversion stands inside the expression that needs it, or on a line of its own when
//! several do. The printer cannot fail.

mod bindings;
mod block;
mod body;
mod functions;
mod layout;
mod names;
mod parts;
mod rates;
mod stages;
mod text;

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::diagnostic::Diagnostic;
use crate::module::{Attribute, FRAME_WGSL, Module, OBJECT_WGSL};
use crate::node::Catalog;
use crate::plan::{Plan, plan};
use crate::program::{Id, Op, Program, Resource, Varying};

pub(crate) use block::larger_than;
use names::Names;
use text::Text;

/// What of a program is reached from its root.
pub(crate) struct Reached {
    /// Expressions, operands before users.
    pub(crate) order: Vec<Id>,
    /// How often each expression is read, by index.
    pub(crate) uses: Vec<u32>,
    pub(crate) varyings: BTreeSet<Varying>,
    pub(crate) inputs: BTreeSet<&'static str>,
    pub(crate) functions: BTreeSet<usize>,
    pub(crate) resources: BTreeSet<Resource>,
}

impl Reached {
    /// Whether an expression has a line of its own: the result of a node, or what is read more than once.
    pub(crate) fn has_line(&self, program: &Program, id: Id) -> bool {
        let expression = program.get(id);
        let leaf = expression.operands.is_empty() || matches!(expression.op, Op::Member(_));
        expression.result || (self.uses[id.0 as usize] > 1 && !leaf)
    }
}

/// Follows operands from the roots, without recursion, but not those of `cut`: another stage computes them.
fn reach(program: &Program, roots: &[Id], cut: &BTreeSet<Id>) -> Reached {
    let mut reached = Reached {
        order: Vec::new(),
        uses: vec![0; program.expressions.len()],
        varyings: BTreeSet::new(),
        inputs: BTreeSet::new(),
        functions: BTreeSet::new(),
        resources: BTreeSet::new(),
    };
    let mut seen = vec![false; program.expressions.len()];
    let mut open: Vec<(Id, bool)> = roots.iter().rev().map(|root| (*root, false)).collect();
    while let Some((id, done)) = open.pop() {
        if done {
            reached.order.push(id);
            continue;
        }
        if std::mem::replace(&mut seen[id.0 as usize], true) {
            continue;
        }
        open.push((id, true));
        let expression = program.get(id);
        if !cut.contains(&id) {
            open.extend(expression.operands.iter().rev().map(|o| (*o, false)));
        }
        match &expression.op {
            Op::Call(f) | Op::Template { function: Some(f), .. } => drop(reached.functions.insert(*f)),
            Op::Varying(v) => drop(reached.varyings.insert(*v)),
            Op::Input(name) => drop(reached.inputs.insert(name)),
            Op::Resource(r) => drop(reached.resources.insert(r.clone())),
            _ => {}
        }
    }
    for id in reached.order.iter().filter(|id| !cut.contains(id)) {
        let expression = program.get(*id);
        let mut read = |position: usize| {
            if let Some(operand) = expression.operands.get(position) {
                reached.uses[operand.0 as usize] += 1;
            }
        };
        match &expression.op {
            // A template that names an operand twice reads it twice.
            Op::Template { text, .. } => text::slots(text).for_each(read),
            _ => (0..expression.operands.len()).for_each(&mut read),
        }
    }
    roots.iter().for_each(|root| reached.uses[root.0 as usize] += 1);
    reached
}

/// The module and plan of a program. Diagnostics are about node and pass files only.
pub fn emit(program: &Program, catalog: &Catalog, title: &str) -> (Module, Plan, Vec<Diagnostic>) {
    let root = program.root.expect("a program that was built has a root");
    let stages = rates::stages(program, root, catalog);
    let reached = &stages.all;
    let (plan, maps, diagnostics) = plan_of(program, reached, catalog);
    let mut names = Names::default();
    for fixed in [
        "Frame",
        "Object",
        "Parameters",
        "Vertex",
        "Varyings",
        "frame",
        "object",
        "parameters",
        "vs_main",
        "fs_main",
        "in",
        "out",
        "world",
    ] {
        names.claim(fixed);
    }
    for group in block::group_names(program) {
        names.claim(&group);
    }
    let functions = functions::gather(program, reached, catalog, &mut names);
    let block = block::block(program, reached, &plan);
    let (bindings, variables) = bindings::bind(program, reached, &maps, block.bytes > 0, &mut names);
    let attributes = attributes(reached);

    let mut text = Text::default();
    text.line(&format!("// {title}"));
    text.blank();
    text.push(FRAME_WGSL);
    text.blank();
    text.push(OBJECT_WGSL);
    if !block.parameters.is_empty() {
        block.write(&mut text);
    }
    functions.write_structs(&mut text);
    text.blank();
    for binding in &bindings {
        text.line(&bindings::declaration(binding));
    }
    functions.write_functions(&mut text, program);
    let tables = body::Tables { functions: &functions, variables: &variables, reads: &block.reads };
    stages::write_vertex(&mut text, &attributes, program, &stages, &tables, &names);
    body::write_fragment(&mut text, program, &stages, root, &tables, names);
    let (wgsl, source_map) = text.finish();
    let (parameters, parameter_bytes) = (block.parameters, block.bytes);
    (Module { wgsl, bindings, parameters, parameter_bytes, attributes, source_map }, plan, diagnostics)
}

/// The plan of what is reached, and for each program map its index in the plan.
fn plan_of(program: &Program, reached: &Reached, catalog: &Catalog) -> (Plan, Vec<(usize, usize)>, Vec<Diagnostic>) {
    let mut maps: Vec<usize> = Vec::new();
    let mut lights: BTreeSet<(Arc<str>, usize)> = BTreeSet::new();
    for resource in &reached.resources {
        match resource {
            Resource::Map(index) => {
                maps.push(*index);
                let light = program.maps[*index].light;
                lights.insert((program.nodes[light].id.clone(), light));
            }
            Resource::Space(light) => drop(lights.insert((program.nodes[*light].id.clone(), *light))),
            _ => {}
        }
    }
    maps.sort_by_key(|m| (program.nodes[program.maps[*m].light].id.clone(), *m));
    let lights: Vec<usize> = lights.into_iter().map(|(_, light)| light).collect();
    let (plan, diagnostics) = plan(program, &maps, &lights, catalog);
    let order = maps.iter().enumerate().map(|(new, old)| (*old, new)).collect();
    (plan, order, diagnostics)
}

fn attributes(reached: &Reached) -> Vec<Attribute> {
    let mut attributes = BTreeSet::from([Attribute::Position]);
    for varying in &reached.varyings {
        match varying {
            Varying::PositionWorld | Varying::PositionObject => {}
            Varying::NormalWorld | Varying::NormalObject => drop(attributes.insert(Attribute::Normal)),
            Varying::TangentWorld | Varying::TangentObject => drop(attributes.insert(Attribute::Tangent)),
            Varying::Texcoord => drop(attributes.insert(Attribute::Texcoord)),
            Varying::VertexColor => drop(attributes.insert(Attribute::Color)),
        }
    }
    attributes.into_iter().collect()
}
