//! From a program to WGSL text that reads as a careful person would write it, with the origin of every byte.
//!
//! Only what the root reaches is written, in an order that depends on nothing but the program. Each node has a comment
//! line and a line of its own; a conversion stands inside the expression that needs it, or on a line of its own when
//! several do. The printer cannot fail.

mod bindings;
mod body;
mod functions;
mod layout;
mod names;
mod parts;
mod stages;
mod text;

use std::collections::BTreeSet;

use crate::diagnostic::Diagnostic;
use crate::module::{Attribute, FRAME_WGSL, Module, OBJECT_WGSL, Parameter};
use crate::node::{Catalog, Default};
use crate::plan::{Plan, plan};
use crate::program::{Id, Op, Program, Resource, Varying};
use crate::semantic::Shape;

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

/// Follows operands from the root, without recursion.
fn reach(program: &Program, root: Id) -> Reached {
    let mut reached = Reached {
        order: Vec::new(),
        uses: vec![0; program.expressions.len()],
        varyings: BTreeSet::new(),
        inputs: BTreeSet::new(),
        functions: BTreeSet::new(),
        resources: BTreeSet::new(),
    };
    let mut seen = vec![false; program.expressions.len()];
    let mut open = vec![(root, false)];
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
        open.extend(expression.operands.iter().rev().map(|o| (*o, false)));
        match &expression.op {
            Op::Call(f) | Op::Template { function: Some(f), .. } => drop(reached.functions.insert(*f)),
            Op::Varying(v) => drop(reached.varyings.insert(*v)),
            Op::Input(name) => drop(reached.inputs.insert(name)),
            Op::Resource(r) => drop(reached.resources.insert(r.clone())),
            _ => {}
        }
    }
    for id in &reached.order {
        let expression = program.get(*id);
        for (position, operand) in expression.operands.iter().enumerate() {
            // A template that names an operand twice reads it twice.
            let times = match &expression.op {
                Op::Template { text, .. } => text::slots(text, position),
                _ => 1,
            };
            reached.uses[operand.0 as usize] += times;
        }
    }
    reached.uses[root.0 as usize] += 1;
    reached
}

/// Number of members and size in bytes of a program's parameter block, but for what only the spaces of maps need.
pub fn parameter_block(program: &Program) -> (usize, u32) {
    let Some(root) = program.root else { return (0, 0) };
    let (members, bytes, _) = parameters(program, &reach(program, root), &Plan::default());
    (members.len(), bytes)
}

/// The module and plan of a program. Diagnostics are about node and pass files only.
pub fn emit(program: &Program, catalog: &Catalog, title: &str) -> (Module, Plan, Vec<Diagnostic>) {
    let Some(root) = program.root else { return (Module::default(), Plan::default(), Vec::new()) };
    let reached = reach(program, root);
    let (plan, maps, diagnostics) = plan_of(program, &reached, catalog);
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
    let functions = functions::gather(program, &reached, catalog, &mut names);
    let (parameters, parameter_bytes, members) = parameters(program, &reached, &plan);
    let (bindings, variables) = bindings::bind(program, &reached, &maps, parameter_bytes > 0, &mut names);
    let attributes = attributes(&reached);

    let mut text = Text::default();
    text.line(&format!("// {title}"));
    text.blank();
    text.push(FRAME_WGSL);
    text.blank();
    text.push(OBJECT_WGSL);
    if !parameters.is_empty() {
        text.blank();
        text.line("struct Parameters {");
        for parameter in &parameters {
            let (node, port) = parameter.path.rsplit_once('.').unwrap_or((&parameter.path, ""));
            let start = text.len();
            let ty = if parameter.shape == Shape::Bool { "u32".to_owned() } else { parameter.shape.wgsl() };
            text.line(&format!("    {}: {ty},", parameter.name));
            text.origin(start, node, Some(port));
        }
        text.line("}");
    }
    functions.write_structs(&mut text);
    text.blank();
    for binding in &bindings {
        text.line(&bindings::declaration(binding));
    }
    functions.write_functions(&mut text, program);
    stages::write_vertex(&mut text, &attributes, &reached);
    body::write_fragment(&mut text, program, &reached, root, &functions, &variables, &members, names);
    let (wgsl, source_map) = text.finish();
    (Module { wgsl, bindings, parameters, parameter_bytes, attributes, source_map }, plan, diagnostics)
}

/// The plan of what is reached, and for each program map its index in the plan.
fn plan_of(program: &Program, reached: &Reached, catalog: &Catalog) -> (Plan, Vec<(usize, usize)>, Vec<Diagnostic>) {
    let mut maps: Vec<usize> = Vec::new();
    let mut lights: BTreeSet<(String, usize)> = BTreeSet::new();
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

/// Members of the parameter block: those that are read, and those that the spaces of maps are made from.
fn parameters(program: &Program, reached: &Reached, plan: &Plan) -> (Vec<Parameter>, u32, Vec<Option<String>>) {
    let mut wanted: BTreeSet<usize> = BTreeSet::new();
    for id in &reached.order {
        if let Op::Parameter(index) = program.get(*id).op {
            wanted.insert(index);
        }
    }
    let spaces: BTreeSet<&String> =
        plan.lights.iter().filter_map(|l| l.space.as_ref()).flat_map(|s| &s.inputs).collect();
    let path = |p: &crate::program::Parameter| format!("{}.{}", program.nodes[p.node].id, p.port);
    wanted.extend((0..program.parameters.len()).filter(|i| spaces.contains(&path(&program.parameters[*i]))));

    let mut order: Vec<usize> = wanted.into_iter().collect();
    // By node and port name, so that the block does not depend on the order of the graph.
    order.sort_by_key(|i| path(&program.parameters[*i]));
    let shapes: Vec<Shape> = order
        .iter()
        .map(|i| {
            let parameter = &program.parameters[*i];
            let port = program.nodes[parameter.node].definition.input(&parameter.port);
            port.map_or(Shape::F32(1), |p| program.shape_of(parameter.node, p))
        })
        .collect();
    let (offsets, bytes) = layout::offsets(shapes.iter());
    let mut members = vec![None; program.parameters.len()];
    let mut block = Names::default();
    let mut out = Vec::new();
    for ((index, shape), offset) in order.into_iter().zip(shapes).zip(offsets) {
        let parameter = &program.parameters[index];
        let info = &program.nodes[parameter.node];
        let Some(port) = info.definition.input(&parameter.port) else { continue };
        let name = block.fresh(&format!("{}_{}", info.short, parameter.port));
        members[index] = Some(name.clone());
        let default = match &port.default {
            Some(Default::Value(value)) => value.clone(),
            _ => parameter.value.clone(),
        };
        out.push(Parameter {
            path: path(parameter),
            name,
            shape,
            offset,
            meaning: port.ty.meaning.to_string(),
            unit: port.unit.clone(),
            range: port.range,
            default,
            value: parameter.value.clone(),
            doc: port.doc.clone(),
        });
    }
    (out, bytes, members)
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
