//! What a node's card shows.

use std::collections::BTreeSet;

use super::fit::{definition, definition_of, is_open};
use crate::graph::{End, Graph, Node};
use crate::node::{Catalog, Default, Definition, OptionSpec, Port};
use crate::semantic::{Kind, Meaning, Shape, Type, Value};

/// A port as a card shows it.
#[derive(Clone, Debug)]
pub struct PortView {
    /// Its name in files.
    pub name: String,
    /// Its name for people.
    pub label: String,
    /// Meaning and shape; a number of any width where nothing is known.
    pub ty: Type,
    /// What it does.
    pub doc: String,
    /// Whether a link is pinned to it. Links that name no port are not counted here.
    pub linked: bool,
    /// What it takes when nothing is linked and no value is given.
    pub default: Option<Default>,
    /// The value that the graph gives.
    pub value: Option<Value>,
    /// Inclusive limits per component, in the unit of the file.
    pub range: (Option<f64>, Option<f64>),
    /// Unit of values in files; empty for none.
    pub unit: String,
    /// Whether nobody can link or set it: the compiler provides it.
    pub hidden: bool,
}

/// A node as a card shows it.
#[derive(Default, Clone, Debug)]
pub struct NodeView {
    /// Its name in the graph.
    pub name: String,
    /// What it is, for people.
    pub title: String,
    /// Family; empty if it is not known.
    pub category: String,
    /// Inputs, in the order of the definition.
    pub inputs: Vec<PortView>,
    /// Outputs, in the order of the definition.
    pub outputs: Vec<PortView>,
    /// Options, each with the choice that is made now.
    pub options: Vec<(OptionSpec, String)>,
    /// What it does.
    pub doc: String,
    /// Whether its kind exists and reads, or its subgraph is loaded.
    pub known: bool,
    /// The path of the subgraph that it stands for.
    pub subgraph: Option<String>,
}

/// What the card of a node shows. `subgraph` is the file that the node stands for, if it is one and loaded. A name that
/// is not in the graph gives an empty card.
pub fn node_view(graph: &Graph, catalog: &Catalog, node: &str, subgraph: Option<&Graph>) -> NodeView {
    let empty = Node::default();
    let given = graph.nodes.get(node).unwrap_or(&empty);
    let mut view = NodeView {
        name: node.to_owned(),
        title: title(given, node),
        category: String::new(),
        inputs: Vec::new(),
        outputs: Vec::new(),
        options: Vec::new(),
        doc: String::new(),
        known: false,
        subgraph: given.graph.clone(),
    };
    if let Some(inner) = subgraph.filter(|_| given.graph.is_some()) {
        of_subgraph(&mut view, given, inner, catalog);
    } else if let Some(definition) = definition(given, node, catalog) {
        of_definition(&mut view, given, &definition);
    }
    mentioned(&mut view, graph, given);
    for link in &graph.links {
        for (end, ports) in [(&link.from, &mut view.outputs), (&link.to, &mut view.inputs)] {
            let pinned = end.port.as_ref().filter(|_| end.node == node);
            let port = pinned.and_then(|name| ports.iter_mut().find(|p| p.name == *name));
            port.into_iter().for_each(|p| p.linked = true);
        }
    }
    view
}

/// A name for people: the kind, or the stem of the subgraph's path.
fn title(node: &Node, name: &str) -> String {
    let file = node.graph.as_deref().map(|path| path.rsplit(['/', '\\']).next().unwrap_or(path));
    let stem = file.map(|file| file.strip_suffix(".ron").unwrap_or(file));
    let title = stem.unwrap_or(&node.kind);
    words(if title.is_empty() { name } else { title })
}

fn words(name: &str) -> String {
    name.replace('_', " ")
}

fn of_definition(view: &mut NodeView, node: &Node, definition: &Definition) {
    let header = &definition.header;
    view.title.clone_from(&header.label);
    view.category.clone_from(&header.category);
    view.doc.clone_from(&header.description);
    view.known = true;
    view.inputs = definition.inputs().map(|p| port_view(p, node.params.get(&p.name).cloned())).collect();
    view.outputs = definition.main.outputs.iter().map(|p| port_view(p, None)).collect();
    view.options = options(node, definition);
}

fn options(node: &Node, definition: &Definition) -> Vec<(OptionSpec, String)> {
    let current = |o: &OptionSpec| node.options.get(&o.name).unwrap_or(&o.default).clone();
    definition.header.options.iter().map(|o| (o.clone(), current(o))).collect()
}

fn port_view(port: &Port, value: Option<Value>) -> PortView {
    PortView {
        name: port.name.clone(),
        label: words(&port.name),
        ty: port.ty.clone(),
        doc: port.doc.clone(),
        linked: false,
        default: port.default.clone(),
        value,
        range: port.range,
        unit: port.unit.clone(),
        hidden: !is_open(port),
    }
}

/// A port of which only the name is known.
fn bare(name: &str) -> PortView {
    PortView {
        name: name.to_owned(),
        label: words(name),
        ty: Type::new(Meaning::of(Kind::Number), Shape::Generic),
        doc: String::new(),
        linked: false,
        default: None,
        value: None,
        range: (None, None),
        unit: String::new(),
        hidden: false,
    }
}

/// What the file exposes, with what it says of it as defaults.
fn of_subgraph(view: &mut NodeView, node: &Node, inner: &Graph, catalog: &Catalog) {
    view.known = true;
    view.category = "subgraph".into();
    view.doc.clone_from(&inner.note);
    if !inner.name.is_empty() {
        view.title.clone_from(&inner.name);
    }
    let named = |port: &str, mut view: PortView| {
        view.name = port.to_owned();
        view.label = words(port);
        view
    };
    let input = |end: &End| {
        let name = end.port.as_ref()?;
        let definition = definition_of(inner, catalog, &end.node)?;
        let mut port = port_view(definition.input(name)?, None);
        let set = inner.nodes.get(&end.node).and_then(|n| n.params.get(name)).cloned();
        port.default = set.map(Default::Value).or(port.default);
        Some(port)
    };
    for (public, ends) in &inner.expose.inputs {
        let mut port = named(public, ends.iter().find_map(input).unwrap_or_else(|| bare(public)));
        port.value = node.params.get(public).cloned();
        view.inputs.push(port);
    }
    for (public, end) in &inner.expose.outputs {
        let definition = definition_of(inner, catalog, &end.node);
        let outputs = definition.as_deref().map_or(&[][..], |d| &d.main.outputs);
        let port = outputs.iter().find(|o| end.port.as_ref().is_none_or(|name| *name == o.name));
        view.outputs.push(named(public, port.map_or_else(|| bare(public), |p| port_view(p, None))));
    }
    for (public, ends) in &inner.expose.options {
        let option = |end: &End| {
            let given = inner.nodes.get(&end.node)?;
            let definition = definition_of(inner, catalog, &end.node)?;
            options(given, &definition).into_iter().find(|(spec, _)| Some(&spec.name) == end.port.as_ref())
        };
        if let Some((mut spec, inside)) = ends.iter().find_map(option) {
            spec.name.clone_from(public);
            spec.default = inside;
            let current = node.options.get(public).unwrap_or(&spec.default).clone();
            view.options.push((spec, current));
        }
    }
}

/// Ports that links and values name although the definition does not, or is not there: they can be seen and removed.
fn mentioned(view: &mut NodeView, graph: &Graph, node: &Node) {
    let ends = |from: bool| {
        let end = move |link: &'_ crate::graph::Link| if from { link.from.clone() } else { link.to.clone() };
        let own = graph.links.iter().map(end).filter(|end| end.node == view.name);
        own.filter_map(|end| end.port).collect::<BTreeSet<String>>()
    };
    let (outputs, mut inputs) = (ends(true), ends(false));
    inputs.extend(node.params.keys().cloned());
    for (names, ports) in [(inputs, &mut view.inputs), (outputs, &mut view.outputs)] {
        let known: BTreeSet<String> = ports.iter().map(|p| p.name.clone()).collect();
        ports.extend(names.difference(&known).map(|name| bare(name)));
    }
    for port in &mut view.inputs {
        if port.value.is_none() {
            port.value = node.params.get(&port.name).cloned();
        }
    }
}
