//! The parameter block: which values are in it, in which order, and how the text reads them.

use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::sync::Arc;

use super::names::Names;
use super::text::Text;
use super::{Reached, layout};
use crate::module::Parameter;
use crate::node::{Default, Port};
use crate::plan::Plan;
use crate::program::{NodeInfo, Op, Program};
use crate::semantic::Shape;

/// The most members that stand side by side in the block. Compilers look for a member from the first on (naga's front
/// end does), so that a block of thousands is written as groups of [`GROUP`].
const LARGEST: usize = 256;
/// Members of a group.
const GROUP: usize = 128;

/// The members of the parameter block.
pub(crate) struct Block {
    /// In the order of their offsets.
    pub(crate) parameters: Vec<Parameter>,
    /// Size, a multiple of 16.
    pub(crate) bytes: u32,
    /// By index into the program's parameters: the WGSL that reads it.
    pub(crate) reads: Vec<Option<String>>,
    /// Node and port of each member.
    origins: Vec<(Arc<str>, Arc<str>)>,
}

/// Members in the order of the block, and where they lie.
struct Order<'a> {
    members: Vec<(usize, &'a NodeInfo, &'a Port, Shape)>,
    offsets: Vec<u32>,
    bytes: u32,
}

/// Number of members and size in bytes of a program's parameter block, but for what only the spaces of maps need; none
/// if that is not more than `most` bytes.
pub(crate) fn larger_than(most: u32, program: &Program) -> Option<(usize, u32)> {
    // No member is larger than a 4x4 matrix of 64 bytes.
    if program.parameters.len().saturating_mul(64) <= most as usize {
        return None;
    }
    let order = order(program, &super::reach(program, &[program.root?], &BTreeSet::new()), &Plan::default());
    (order.bytes > most).then_some((order.members.len(), order.bytes))
}

/// Members of the parameter block: those that are read, and those that the spaces of maps are made from.
fn order<'a>(program: &'a Program, reached: &Reached, plan: &Plan) -> Order<'a> {
    let mut wanted = vec![false; program.parameters.len()];
    for id in &reached.order {
        if let Op::Parameter(index) = program.get(*id).op {
            wanted[index] = true;
        }
    }
    let spaces: Vec<&str> =
        plan.lights.iter().filter_map(|l| l.space.as_ref()).flat_map(|s| &s.inputs).map(String::as_str).collect();
    let path = |index: usize| {
        let parameter = &program.parameters[index];
        (&*program.nodes[parameter.node].id, &*parameter.port)
    };
    if !spaces.is_empty() {
        for (index, wanted) in wanted.iter_mut().enumerate().filter(|(_, w)| !**w) {
            let (node, port) = path(index);
            let is_it = |s: &&str| s.strip_suffix(port).and_then(|s| s.strip_suffix('.')) == Some(node);
            *wanted = spaces.iter().any(is_it);
        }
    }
    let mut indices: Vec<usize> = (0..wanted.len()).filter(|i| wanted[*i]).collect();
    // By node and port name, so that the block does not depend on the order of the graph.
    indices.sort_by(|a, b| by_path(path(*a), path(*b)));
    let member = |index: usize| {
        let parameter = &program.parameters[index];
        let info = &program.nodes[parameter.node];
        let port = info.definition.input(&parameter.port)?;
        Some((index, info, port, program.shape_of(parameter.node, port)))
    };
    let members: Vec<_> = indices.into_iter().filter_map(member).collect();
    let group = if members.len() > LARGEST { GROUP } else { usize::MAX };
    let (offsets, bytes) = layout::offsets(members.iter().map(|(.., shape)| shape), group);
    Order { members, offsets, bytes }
}

/// The order of `node.port`, without making those texts.
fn by_path(a: (&str, &str), b: (&str, &str)) -> Ordering {
    if a.0 == b.0 {
        return a.1.cmp(b.1);
    }
    let common = a.0.len().min(b.0.len());
    let order = a.0.as_bytes()[..common].cmp(&b.0.as_bytes()[..common]);
    // One name begins the other: the dot after the shorter meets what the longer goes on with, which is no dot.
    let next = |node: &str| node.as_bytes().get(common).copied().unwrap_or(b'.');
    order.then_with(|| next(a.0).cmp(&next(b.0)))
}

/// The most names of structures that the block of a program takes.
pub(crate) fn group_names(program: &Program) -> impl Iterator<Item = String> {
    let count = program.parameters.len();
    let groups = if count > LARGEST { count.div_ceil(GROUP) } else { 0 };
    (1..=groups).map(group_name)
}

fn group_name(number: usize) -> String {
    format!("ParameterGroup{number}")
}

/// The parameter block of what is reached.
pub(crate) fn block(program: &Program, reached: &Reached, plan: &Plan) -> Block {
    let Order { members, offsets, bytes } = order(program, reached, plan);
    let grouped = members.len() > LARGEST;
    let mut reads = vec![None; program.parameters.len()];
    let mut names = Names::default();
    let mut parameters = Vec::with_capacity(members.len());
    let mut origins = Vec::with_capacity(members.len());
    for (place, ((index, info, port, shape), offset)) in members.into_iter().zip(offsets).enumerate() {
        let parameter = &program.parameters[index];
        let mut name = names.fresh(&[&*info.short, &*parameter.port].join("_"));
        if grouped {
            name = format!("group_{}.{name}", place / GROUP + 1);
        }
        // A bool cannot live in a uniform block.
        let (open, close) = if shape == Shape::Bool { ("(parameters.", " != 0u)") } else { ("parameters.", "") };
        reads[index] = Some([open, &name, close].concat());
        let default = match &port.default {
            Some(Default::Value(value)) => value.clone(),
            _ => parameter.value.clone(),
        };
        origins.push((info.id.clone(), parameter.port.clone()));
        parameters.push(Parameter {
            path: [&*info.id, &*parameter.port].join("."),
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
    Block { parameters, bytes, reads, origins }
}

impl Block {
    /// The structures of the block.
    pub(crate) fn write(&self, text: &mut Text) {
        if self.parameters.len() <= LARGEST {
            write_struct(text, "Parameters", &self.parameters, &self.origins);
            return;
        }
        let groups: Vec<&[Parameter]> = self.parameters.chunks(GROUP).collect();
        for (index, group) in groups.iter().enumerate() {
            write_struct(text, &group_name(index + 1), group, &self.origins[index * GROUP..]);
        }
        text.blank();
        text.line("struct Parameters {");
        for number in 1..=groups.len() {
            text.line(&format!("    @align(16) group_{number}: {},", group_name(number)));
        }
        text.line("}");
    }
}

fn write_struct(text: &mut Text, name: &str, members: &[Parameter], origins: &[(Arc<str>, Arc<str>)]) {
    text.blank();
    text.line(&format!("struct {name} {{"));
    for (member, (node, port)) in members.iter().zip(origins) {
        let start = text.len();
        text.push("    ");
        text.push(member.name.rsplit('.').next().unwrap_or_default());
        text.push(": ");
        match member.shape {
            Shape::Bool => text.push("u32"),
            Shape::F32(1) => text.push("f32"),
            ref shape => text.push(&shape.wgsl()),
        }
        text.push(",\n");
        text.origin(start, node, Some(port));
    }
    text.line("}");
}

#[cfg(test)]
mod tests {
    use super::by_path;

    #[test]
    fn members_are_in_the_order_of_their_paths() {
        let nodes = ["n1", "n1-b", "n1 c", "n10", "n2", "a/n1", "a"];
        let ports = ["a", "b"];
        for (a, p) in nodes.iter().flat_map(|n| ports.map(|p| (n, p))) {
            for (b, q) in nodes.iter().flat_map(|n| ports.map(|p| (n, p))) {
                let paths = format!("{a}.{p}").cmp(&format!("{b}.{q}"));
                assert_eq!(by_path((a, p), (b, q)), paths, "{a}.{p} {b}.{q}");
            }
        }
    }
}
