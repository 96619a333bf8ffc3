//! New nodes, alone or on a wire.

use super::{Pending, find_link, free_name};
use crate::graph::{Edit, End, Graph, Link, Node};
use crate::node::{Catalog, Definition};
use crate::semantic::Conversions;
use crate::view::fit::{Side, best, definition, definition_of, lights};

/// What a node that is written in the graph begins with.
const CUSTOM: &str = "fn custom(x: f32) -> f32 {\n    return x;\n}\n";

/// What is put on a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Insert<'a> {
    /// A new node of this kind.
    Kind(&'a str),
    /// A node of the graph that has no links.
    Node(&'a str),
}

/// A name for a node of a kind: shadows can stand for each other, so what is left of their kind is no name.
fn short(catalog: &Catalog, kind: &str) -> String {
    let category = catalog.get(kind).and_then(|file| file.header().ok()).map(|header| header.category.clone());
    if category.as_deref() == Some("shadow") {
        return "shadow".to_owned();
    }
    let base = kind.strip_suffix("_light").unwrap_or(kind);
    let base = base.strip_suffix("2d").or_else(|| base.strip_suffix("3d")).unwrap_or(base);
    let base = base.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end_matches('_');
    if base.is_empty() { kind.to_owned() } else { base.to_owned() }
}

fn fresh(kind: &str) -> Node {
    let wgsl = (kind == "custom").then(|| CUSTOM.to_owned());
    Node { kind: kind.to_owned(), wgsl, ..Node::default() }
}

fn added(name: &str, node: Node, at: [f64; 2]) -> Vec<Edit> {
    vec![Edit::AddNode(name.to_owned(), Box::new(node)), Edit::Move(name.to_owned(), Some(at))]
}

/// A new node, and its name: a short form of its kind.
pub fn add(graph: &Graph, catalog: &Catalog, kind: &str, at: [f64; 2]) -> (Edit, String) {
    let name = free_name(graph, &short(catalog, kind));
    (Edit::Batch(added(&name, fresh(kind), at)), name)
}

/// A new node at the loose end of a wire, linked through the port that fits best, and its name. None if none fits.
pub fn add_linked(
    graph: &Graph,
    catalog: &Catalog,
    kind: &str,
    at: [f64; 2],
    wire: &Pending,
) -> Option<(Edit, String)> {
    let name = free_name(graph, &short(catalog, kind));
    let node = fresh(kind);
    let own = definition(&node, &name, catalog);
    let other = definition_of(graph, catalog, &wire.end.node);
    graph.nodes.get(&wire.end.node)?;
    let conversions = Conversions::default();
    let mut edits = added(&name, node, at);
    let (mine, theirs) = (own.as_deref(), other.as_deref());
    let (from, to) = if wire.from_output {
        let port = wire.end.port.as_deref();
        (wire.end.clone(), input(&conversions, (&wire.end.node, theirs, port), (&name, mine))?)
    } else {
        (output(&conversions, (&name, mine), (&wire.end.node, theirs, wire.end.port.as_deref()))?, wire.end.clone())
    };
    if to.port.is_some() {
        let rivals = graph.links.iter().filter(|link| link.to == to);
        edits.extend(rivals.map(|link| Edit::Unlink(link.from.clone(), link.to.clone())));
    }
    edits.push(Edit::Link(Box::new(Link::new(from, to))));
    Some((Edit::Batch(edits), name))
}

/// A node's name, definition and pinned port.
type Known<'a> = (&'a str, Option<&'a Definition>, Option<&'a str>);

/// Where a link from a known end goes into a node that nothing else feeds.
fn input(conversions: &Conversions, from: Known<'_>, to: (&str, Option<&Definition>)) -> Option<End> {
    let (Some(source), Some(own)) = (from.1, to.1) else { return Some(End::node(to.0)) };
    if lights(source, own) {
        return Some(End::node(to.0));
    }
    let from = Side { name: from.0, definition: source, port: from.2 };
    let pair = best(conversions, from, Side { name: to.0, definition: own, port: None }, &|_| true)?;
    Some(End::port(to.0, pair.input))
}

/// Where a link to a known end starts: the first output is not said.
fn output(conversions: &Conversions, from: (&str, Option<&Definition>), to: Known<'_>) -> Option<End> {
    let (Some(own), Some(target)) = (from.1, to.1) else { return Some(End::node(from.0)) };
    if lights(own, target) {
        return Some(End::node(from.0));
    }
    let to = Side { name: to.0, definition: target, port: to.2 };
    let pair = best(conversions, Side { name: from.0, definition: own, port: None }, to, &|_| true)?;
    let first = own.main.outputs.first().is_some_and(|o| o.name == pair.output);
    Some(if first { End::node(from.0) } else { End::port(from.0, pair.output) })
}

/// Puts a node on a link: what fed the one end feeds the node, and the node feeds the other end as the link did. None if
/// there is no such link, or the node does not fit or has links of its own.
pub fn insert_on_link(
    graph: &Graph,
    catalog: &Catalog,
    from: &End,
    to: &End,
    kind_or_node: Insert<'_>,
    at: [f64; 2],
) -> Option<(Edit, String)> {
    let link = find_link(graph, from, to)?;
    let (name, own, mut edits) = match kind_or_node {
        Insert::Kind(kind) => {
            let name = free_name(graph, &short(catalog, kind));
            let node = fresh(kind);
            let own = definition(&node, &name, catalog);
            let edits = added(&name, node, at);
            (name, own, edits)
        }
        Insert::Node(name) => {
            graph.nodes.get(name)?;
            if graph.links.iter().any(|link| link.from.node == name || link.to.node == name) {
                return None;
            }
            let edits = vec![Edit::Move(name.to_owned(), Some(at))];
            (name.to_owned(), definition_of(graph, catalog, name), edits)
        }
    };
    let conversions = Conversions::default();
    let source = definition_of(graph, catalog, &from.node);
    let target = definition_of(graph, catalog, &to.node);
    let first = input(&conversions, (&from.node, source.as_deref(), from.port.as_deref()), (&name, own.as_deref()))?;
    let second = output(&conversions, (&name, own.as_deref()), (&to.node, target.as_deref(), to.port.as_deref()))?;
    edits.push(Edit::Unlink(from.clone(), to.clone()));
    edits.push(Edit::Link(Box::new(Link::new(from.clone(), first))));
    let mut rest = Link { from: second, span: None, ..link.clone() };
    rest.to = to.clone();
    edits.push(Edit::Link(Box::new(rest)));
    Some((Edit::Batch(edits), name))
}
