//! From graphs and a catalogue to resolved wiring: which output feeds which port, through which conversions, under
//! which lights. Everything that a person can get wrong in a graph is found here and reported together.
//!
//! The order of the work: collect the nodes of all graphs (`collect`), join light programs to surface programs
//! (`join`), sort, follow lights through their shadows (`lights`), resolve the ports of each node together
//! (`resolve`), and choose what the fragment shader writes (`root`). Nothing recurses on the depth of a graph.

mod assign;
mod collect;
mod inputs;
mod join;
mod lights;
mod resolve;
mod root;
mod spaces;

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use std::sync::Arc;

use crate::compile::{NamedGraph, Output};
use crate::diagnostic::{Diagnostic, Place, SourceText, Span, has_errors};
use crate::graph;
use crate::node::{Catalog, Definition, Port};
use crate::semantic::{Chain, Conversions, Kind, Quantity, Shape, Type, Value};

pub use inputs::Inputs;
pub use root::{Root, light_called};

/// Resolved wiring, in evaluation order.
pub struct Woven {
    /// Nodes; each comes after everything that feeds it.
    pub nodes: Vec<Node>,
    /// What is written.
    pub root: Root,
}

/// A node with all of its inputs decided.
pub struct Node {
    /// Name, with the graph's name and a `/` before it if there are several graphs.
    pub id: Arc<str>,
    /// What it computes.
    pub definition: Arc<Definition>,
    /// What `T` stands for, for generic definitions.
    pub generic: Option<Shape>,
    /// What feeds each input. An input that only matters under a light may be missing when there is none.
    pub inputs: Inputs,
    /// Lights that reach this node through lights and shadows alone, each with the shadows on its way.
    pub lights: BTreeMap<usize, BTreeSet<usize>>,
    /// Where it was written, or else in which text.
    span: Option<Span>,
    source: Option<Arc<SourceText>>,
    /// Where in `id` its name within its own graph begins.
    name_at: usize,
}

/// What feeds an input.
#[derive(Clone)]
pub enum Wire {
    /// An output of another node.
    Output {
        /// Index of the node.
        node: usize,
        /// Name of the output.
        output: String,
        /// Conversions on the way.
        chain: Rc<Chain>,
    },
    /// An output of the light in whose context the node is evaluated.
    Light {
        /// Name of the output.
        output: String,
        /// Conversions on the way.
        chain: Rc<Chain>,
    },
    /// Irradiance of the light in context, after the shadows between it and this node.
    Irradiance,
    /// Nothing: the value is a parameter.
    Value(Value),
    /// Something that the compiler provides.
    Source(String),
    /// The space of the light in context.
    Space,
    /// A map in that space.
    Map,
    /// The sampler that the definition describes.
    Sampler,
    /// An image by path, with the file that mentions it.
    Image(String, String),
}

impl Node {
    /// Where it was written.
    pub fn place(&self) -> Place {
        let place = match (&self.span, &self.source) {
            (Some(span), _) => Place::span(span.clone()),
            (None, Some(source)) => Place::file(&source.name),
            (None, None) => Place::default(),
        };
        place.node(&self.id[self.name_at..])
    }

    /// Type of an output once generics are chosen.
    pub fn output_type(&self, port: &Port) -> Type {
        instantiated(&port.ty, self.generic.as_ref())
    }
}

/// The type with `T` replaced.
pub fn instantiated(ty: &Type, generic: Option<&Shape>) -> Type {
    match (&ty.shape, generic) {
        (Shape::Generic, Some(shape)) => Type::new(ty.meaning, shape.clone()),
        _ => ty.clone(),
    }
}

/// Whether a definition is a light: it gives irradiance and takes none.
pub fn is_light(definition: &Definition) -> bool {
    let gives = |q| definition.main.outputs.iter().any(|p| p.ty.meaning.quantity == q);
    gives(Quantity::Irradiance) && !is_lit(definition)
}

/// Whether a definition is a shadow or filter: its first output says which share of light gets through.
pub fn is_shadow(definition: &Definition) -> bool {
    definition.main.outputs.first().is_some_and(|p| p.ty.meaning.quantity == Quantity::Visibility)
}

/// Whether a definition takes the light of one light at a time.
pub fn is_lit(definition: &Definition) -> bool {
    definition.inputs().any(|p| p.ty.meaning.quantity == Quantity::Irradiance)
}

/// Whether a definition's result is seen: its first output is radiance.
pub fn is_surface(definition: &Definition) -> bool {
    definition.main.outputs.first().is_some_and(|p| p.ty.meaning.quantity == Quantity::Radiance)
}

/// Whether an input of a lit definition can only come from a light.
pub(crate) fn is_light_port(definition: &Definition, port: &Port) -> bool {
    let meaning = port.ty.meaning;
    meaning.quantity == Quantity::Irradiance
        || (is_lit(definition)
            && port.default.is_none()
            && !port.hidden
            && matches!(meaning.kind, Kind::Direction | Kind::Distance))
}

/// A link between collected nodes.
pub(crate) struct Link<'a> {
    pub(crate) from: usize,
    pub(crate) from_port: Option<String>,
    pub(crate) to: usize,
    pub(crate) to_port: Option<String>,
    pub(crate) place: LinkPlace<'a>,
}

/// Where a link comes from; its place in a file is looked up when somebody asks.
pub(crate) enum LinkPlace<'a> {
    /// A link of this graph.
    Written { graph: usize, link: &'a graph::Link },
    /// Drawn between two graphs, from and to the nodes with these indices.
    Joined { from: usize, to: usize },
}

/// A node as collected: its definition is missing if it could not be had.
pub(crate) struct Found<'a> {
    pub(crate) id: Arc<str>,
    pub(crate) graph: usize,
    /// Its name in that graph.
    pub(crate) name: &'a str,
    pub(crate) definition: Option<Arc<Definition>>,
    pub(crate) values: BTreeMap<String, Value>,
    /// The file that each path among the values counts from, if it is not `base`.
    pub(crate) bases: BTreeMap<String, String>,
    pub(crate) base: Option<Arc<SourceText>>,
    /// Ports whose value or link was refused, and `*` for links that could have led anywhere: what is missing there
    /// has been reported already.
    pub(crate) refused: BTreeSet<String>,
}

impl Found<'_> {
    /// Whether nothing can be said about what feeds this node or what it feeds.
    pub(crate) fn is_doubtful(&self) -> bool {
        self.definition.is_none() || self.refused.contains("*")
    }
}

/// Resolves the wiring of `graphs` together. The result is there only if no error was found.
pub fn weave(graphs: &[NamedGraph], catalog: &Catalog, output: &Output) -> (Option<Woven>, Vec<Diagnostic>) {
    let mut diagnostics = Vec::new();
    let mut collected = collect::collect(graphs, catalog, &mut diagnostics);
    join::join(graphs, &collected.nodes, &mut collected.links, &mut diagnostics);
    let Some(order) = collect::order(&collected, &mut diagnostics) else {
        in_file_order(graphs, &mut diagnostics);
        return (None, diagnostics);
    };
    collected.reorder(&order);
    let lights = lights::follow(&collected, &mut diagnostics);
    let conversions = Conversions::default();
    let nodes = resolve::resolve(&collected, lights, &conversions, &mut diagnostics);
    spaces::check(&collected, &nodes, &mut diagnostics);
    let root = root::choose(graphs, &collected, &nodes, output, &conversions, &mut diagnostics);
    in_file_order(graphs, &mut diagnostics);
    // A node that could not be resolved is missing, so every index would be off: there is no partial result.
    match (nodes.into_iter().collect::<Option<Vec<Node>>>(), root) {
        (Some(nodes), Some(root)) if !has_errors(&diagnostics) => (Some(Woven { nodes, root }), diagnostics),
        _ => (None, diagnostics),
    }
}

/// What is reported together comes in the order in which a person reads the files; what has no line comes last.
fn in_file_order(graphs: &[NamedGraph], diagnostics: &mut [Diagnostic]) {
    let files: Vec<Option<&String>> = graphs.iter().map(|g| g.graph.source.as_ref().map(|s| &s.name)).collect();
    diagnostics.sort_by_key(|d| {
        let span = d.place.span.as_ref();
        let file = span.map(|s| files.iter().position(|f| *f == Some(&s.source.name)).unwrap_or(files.len()));
        (span.is_none(), file, span.map(|s| (s.source.name.clone(), s.range.start)))
    });
}
