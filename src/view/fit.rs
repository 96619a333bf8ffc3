//! Which output goes with which input, as far as it can be said of two nodes alone.

use std::sync::Arc;

use crate::diagnostic::SourceText;
use crate::graph::{Graph, Node};
use crate::node::{Catalog, Choices, Definition, Port, custom};
use crate::semantic::{Conversions, Kind, Quantity, Shape, Type};
use crate::weave::{is_light, is_light_port, is_lit, is_shadow};

/// The definition of a node; none where it stands for a subgraph, or where its kind is not known or does not read.
pub(super) fn definition_of(graph: &Graph, catalog: &Catalog, name: &str) -> Option<Arc<Definition>> {
    definition(graph.nodes.get(name)?, name, catalog)
}

/// The definition of a node that may not be in a graph.
pub(super) fn definition(node: &Node, name: &str, catalog: &Catalog) -> Option<Arc<Definition>> {
    if node.graph.is_some() {
        return None;
    }
    if let Some(text) = &node.wgsl {
        return custom(name, text, &SourceText::new("", ""), &node.options, catalog).ok();
    }
    let file = catalog.get(&node.kind)?;
    file.definition(&node.options).or_else(|_| file.definition(&Choices::new())).ok()
}

/// What converting costs. A value of any width fits if one width does.
pub(super) fn cost(conversions: &Conversions, value: &Type, port: &Type) -> Option<u32> {
    if value.shape != Shape::Generic {
        return conversions.chain(value, port).map(|chain| chain.cost);
    }
    let widths = (1..=4).map(|width| Type::new(value.meaning, Shape::F32(width)));
    widths.filter_map(|value| conversions.chain(&value, port)).map(|chain| chain.cost).min()
}

/// Whether a link can lead to the port at all: what is left is never seen, or made by the compiler.
pub(super) fn is_open(port: &Port) -> bool {
    !port.hidden && !matches!(port.ty.meaning.kind, Kind::Map | Kind::Space | Kind::Sampler)
}

/// Whether one node lights another: such a link names no ports.
pub(super) fn lights(from: &Definition, to: &Definition) -> bool {
    (is_light(from) || is_shadow(from)) && (is_lit(to) || is_shadow(to))
}

/// Whether only light can feed the port.
pub(super) fn takes_light(definition: &Definition, port: &Port) -> bool {
    is_light_port(definition, port)
}

/// An output and an input that go together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Pair {
    pub(super) output: String,
    pub(super) input: String,
    pub(super) cost: u32,
}

/// One side of a wire: a node's name and definition, and the port if it is given.
#[derive(Clone, Copy)]
pub(super) struct Side<'a> {
    pub(super) name: &'a str,
    pub(super) definition: &'a Definition,
    pub(super) port: Option<&'a str>,
}

/// The best pair: of the same role, then without default, then by what converting costs, then the first. `free` says
/// which inputs may be chosen.
pub(super) fn best(
    conversions: &Conversions,
    from: Side<'_>,
    to: Side<'_>,
    free: &dyn Fn(&str) -> bool,
) -> Option<Pair> {
    let outputs = || from.definition.main.outputs.iter().filter(|o| from.port.is_none_or(|name| name == o.name));
    let given = |port: &Port| to.port.is_none_or(|name| name == port.name);
    let inputs = to.definition.inputs().filter(|p| given(p) && is_open(p) && free(&p.name));
    let inputs = inputs.filter(|p| to.port.is_some() || !takes_light(to.definition, p));
    let pairs = inputs.flat_map(|input| {
        outputs().filter_map(move |output| {
            let cost = cost(conversions, &output.ty, &input.ty)?;
            let other_role = output.name != input.name && from.name != input.name;
            let pair = Pair { output: output.name.clone(), input: input.name.clone(), cost };
            Some(((other_role, input.default.is_some(), cost), pair))
        })
    });
    pairs.min_by_key(|(key, _)| *key).map(|(_, pair)| pair)
}

/// The quantity of light that a type is, if it is one that travels from light to surface.
pub(super) fn is_light_type(ty: &Type) -> bool {
    matches!(ty.meaning.quantity, Quantity::Irradiance | Quantity::Visibility)
}
