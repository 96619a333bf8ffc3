//! Nodes that become a file of their own, and what a file exposes.

use std::collections::{BTreeMap, BTreeSet};

use super::clipboard::part;
use super::free_name;
use super::names::{Names, port_name};
use crate::graph::{Edit, End, Expose, Graph, Link, Node};
use crate::node::Catalog;
use crate::semantic::Value;
use crate::view::fit::definition_of;
use crate::weave::is_surface;

/// Makes a graph of nodes, which goes into the file of this path, and an edit that puts one node in their place. Gives
/// the edit, the graph and the name of the node. Exposed is whatever links cross, and every value that was set.
///
/// # Errors
/// Why it cannot be made, in words.
pub fn make_subgraph(
    graph: &Graph,
    catalog: &Catalog,
    nodes: &BTreeSet<String>,
    path: &str,
    title: &str,
) -> Result<(Edit, Graph, String), String> {
    let nodes: BTreeSet<String> = nodes.iter().filter(|name| graph.nodes.contains_key(*name)).cloned().collect();
    if nodes.is_empty() {
        return Err("no nodes are chosen".into());
    }
    let file = path.rsplit(['/', '\\']).next().unwrap_or(path);
    let stem = file.strip_suffix(".ron").unwrap_or(file);
    if stem.is_empty() {
        return Err("the file needs a name".into());
    }
    let mut inner = part(graph, &nodes);
    inner.name = title.to_owned();
    rebase(&mut inner, path)?;
    let stand = free_name(graph, if stem.is_empty() { title } else { stem });
    let mut work =
        Work { stand: &stand, inner, inputs: Fan::default(), outputs: Fan::default(), options: Fan::default() };
    let own = |end: &End| nodes.contains(&end.node);
    let mut edits: Vec<Edit> = nodes.iter().map(|name| Edit::RemoveNode(name.clone())).collect();
    edits.extend(work.inner.frames.keys().map(|title| Edit::SetFrame(title.clone(), None)));
    let node = Node { graph: Some(path.to_owned()), ..Node::default() };
    edits.push(Edit::AddNode(stand.clone(), Box::new(node)));
    edits.extend(middle(&work.inner).map(|at| Edit::Move(stand.clone(), Some(at))));
    for link in graph.links.iter().filter(|l| own(&l.from) != own(&l.to)) {
        let from = if own(&link.from) { work.output(&link.from) } else { link.from.clone() };
        let to = if own(&link.to) { work.input(&link.to) } else { link.to.clone() };
        edits.push(Edit::Link(Box::new(Link { from: from.clone(), to: to.clone(), span: None, ..link.clone() })));
        if let Some(points) = graph.waypoints.get(&(link.from.clone(), link.to.clone())) {
            edits.push(Edit::SetWaypoints(from, to, points.clone()));
        }
    }
    if graph.expose.ends().any(own) {
        edits.push(Edit::SetExpose(Box::new(work.outer_expose(&graph.expose, &nodes))));
    }
    if let Some(output) = graph.output.as_ref().filter(|end| own(end)) {
        edits.push(Edit::SetOutput(Some(work.output(output))));
    }
    work.inner.output = exported(graph, catalog, &work.inner);
    let set: Vec<End> =
        work.inner.nodes.iter().flat_map(|(name, n)| n.params.keys().map(move |p| (name, p))).map(param_end).collect();
    for end in set {
        work.input(&end);
    }
    let Work { mut inner, inputs, outputs, options, .. } = work;
    let single = |fan: Fan| fan.public.into_iter().map(|(end, name)| (name, vec![end])).collect::<BTreeMap<_, _>>();
    inner.expose.outputs = outputs.public.into_iter().map(|(end, name)| (name, end)).collect();
    (inner.expose.inputs, inner.expose.options) = (single(inputs), single(options));
    Ok((Edit::Batch(edits), inner, stand))
}

/// The end of a parameter; in a node that stands for a subgraph itself it may name an inner port, which is not exposed.
fn param_end((node, param): (&String, &String)) -> End {
    End::port(node, param)
}

/// Public names by what they stand for.
#[derive(Default)]
struct Fan {
    public: BTreeMap<End, String>,
    names: Names,
}

impl Fan {
    fn name(&mut self, end: &End) -> String {
        if let Some(name) = self.public.get(end) {
            return name.clone();
        }
        let wanted = port_name(end.port.as_deref().unwrap_or(&end.node));
        let name = self.names.numbered(&wanted, '_', &|_| false);
        self.public.insert(end.clone(), name.clone());
        name
    }
}

struct Work<'a> {
    stand: &'a str,
    inner: Graph,
    inputs: Fan,
    outputs: Fan,
    options: Fan,
}

impl Work<'_> {
    fn input(&mut self, end: &End) -> End {
        // `a.b` inside a subgraph inside cannot be exposed.
        if end.port.as_ref().is_some_and(|port| port.contains('.')) {
            return end.clone();
        }
        End::port(self.stand, self.inputs.name(end))
    }

    fn output(&mut self, end: &End) -> End {
        End::port(self.stand, self.outputs.name(end))
    }

    /// What the outer graph exposes, through what the inner one does.
    fn outer_expose(&mut self, outer: &Expose, nodes: &BTreeSet<String>) -> Expose {
        let own = |end: &End| nodes.contains(&end.node);
        let mut expose = outer.clone();
        for end in expose.inputs.values_mut().flatten().filter(|end| own(end)) {
            *end = self.input(end);
        }
        for end in expose.options.values_mut().flatten().filter(|end| own(end)) {
            *end = End::port(self.stand, self.options.name(end));
        }
        for end in expose.outputs.values_mut().filter(|end| own(end)) {
            *end = self.output(end);
        }
        expose
    }
}

/// What the inner graph exports: what the outer one does, else what nothing follows there, a surface first.
fn exported(graph: &Graph, catalog: &Catalog, inner: &Graph) -> Option<End> {
    if let Some(output) = graph.output.as_ref().filter(|end| inner.nodes.contains_key(&end.node)) {
        return Some(output.clone());
    }
    let followed: BTreeSet<&String> = graph.links.iter().map(|link| &link.from.node).collect();
    let last: Vec<&String> = inner.nodes.keys().filter(|name| !followed.contains(name)).collect();
    let seen = |name: &&&String| definition_of(graph, catalog, name).is_some_and(|d| is_surface(&d));
    if let Some(name) = last.iter().find(seen).or(last.first()) {
        return Some(End::node(*name));
    }
    let crossing = |link: &&Link| inner.nodes.contains_key(&link.from.node) && !inner.nodes.contains_key(&link.to.node);
    graph.links.iter().find(crossing).map(|link| link.from.clone())
}

/// Where the nodes lie on average.
fn middle(graph: &Graph) -> Option<[f64; 2]> {
    let count = graph.layout.len() as f64;
    let sum = graph.layout.values().fold([0.0; 2], |sum, at| [sum[0] + at[0] / count, sum[1] + at[1] / count]);
    (!graph.layout.is_empty()).then(|| sum.map(f64::round))
}

/// Lets relative paths count from the folder of the new file.
fn rebase(graph: &mut Graph, path: &str) -> Result<(), String> {
    let folders: Vec<&str> = match path.rsplit_once(['/', '\\']) {
        Some((folder, _)) => folder.split(['/', '\\']).filter(|f| !matches!(*f, "" | ".")).collect(),
        None => Vec::new(),
    };
    let absolute = |path: &str| path.starts_with(['/', '\\']) || path.get(1..2) == Some(":");
    let odd = absolute(path) || folders.contains(&"..");
    let up = "../".repeat(folders.len());
    for node in graph.nodes.values_mut() {
        let texts = node.params.values_mut().filter_map(|value| match value {
            Value::Text(text) => Some(text),
            _ => None,
        });
        for text in texts.chain(&mut node.graph).filter(|text| !absolute(text)) {
            if odd {
                return Err(format!("`{text}` is found from the folder of this file; put the new one there or below"));
            }
            text.insert_str(0, &up);
        }
    }
    Ok(())
}

/// Changes what a graph exposes.
fn exposing(graph: &Graph, node: &str, change: impl FnOnce(&mut Expose)) -> Edit {
    if !graph.nodes.contains_key(node) {
        return Edit::Batch(Vec::new());
    }
    let mut expose = graph.expose.clone();
    change(&mut expose);
    Edit::SetExpose(Box::new(expose))
}

/// A public name as it can be used in links.
fn public(name: &str) -> String {
    port_name(name.trim())
}

/// Exposes an input under a public name, beside others of that name: one value then sets them all.
pub fn expose(graph: &Graph, node: &str, port: &str, public_name: &str) -> Edit {
    exposing(graph, node, |expose| {
        let ends = expose.inputs.entry(public(public_name)).or_default();
        let end = End::port(node, port);
        if !ends.contains(&end) {
            ends.push(end);
        }
    })
}

/// Exposes an output under a public name, in place of another of that name.
pub fn expose_output(graph: &Graph, node: &str, port: &str, public_name: &str) -> Edit {
    exposing(graph, node, |expose| drop(expose.outputs.insert(public(public_name), End::port(node, port))))
}

/// Exposes an option under a public name, beside others of that name.
pub fn expose_option(graph: &Graph, node: &str, option: &str, public_name: &str) -> Edit {
    exposing(graph, node, |expose| {
        let ends = expose.options.entry(public(public_name)).or_default();
        let end = End::port(node, option);
        if !ends.contains(&end) {
            ends.push(end);
        }
    })
}

/// Exposes a port or option no longer, under any name.
pub fn unexpose(graph: &Graph, node: &str, port: &str) -> Edit {
    let end = End::port(node, port);
    exposing(graph, node, |expose| {
        for fans in [&mut expose.inputs, &mut expose.options] {
            fans.values_mut().for_each(|ends| ends.retain(|e| *e != end));
            fans.retain(|_, ends| !ends.is_empty());
        }
        expose.outputs.retain(|_, e| *e != end);
    })
}
