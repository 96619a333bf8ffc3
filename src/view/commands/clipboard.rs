//! Copies of nodes: as a text, from a text, beside themselves.

use std::collections::{BTreeMap, BTreeSet};

use super::names::Names;
use crate::diagnostic::{Diagnostic, SourceText, has_errors};
use crate::graph::{Edit, End, Frame, Graph, Link, Spans, read, write};

/// How far a copy lies from what it is a copy of, in points, to the right and down.
const ASIDE: f64 = 32.0;

/// Nodes as a graph of their own: with the links between them, where they lie, and frames that stand around nothing else.
pub(super) fn part(graph: &Graph, nodes: &BTreeSet<String>) -> Graph {
    let own = |end: &End| nodes.contains(&end.node);
    let mut part = Graph {
        nodes: graph
            .nodes
            .iter()
            .filter(|(n, _)| nodes.contains(*n))
            .map(|(n, node)| (n.clone(), node.clone()))
            .collect(),
        links: graph.links.iter().filter(|l| own(&l.from) && own(&l.to)).cloned().collect(),
        layout: graph.layout.iter().filter(|(n, _)| nodes.contains(*n)).map(|(n, at)| (n.clone(), *at)).collect(),
        collapsed: graph.collapsed.intersection(nodes).cloned().collect(),
        frames: graph
            .frames
            .iter()
            .filter(|(_, f)| stands_around(f, graph, nodes))
            .map(|(n, f)| (n.clone(), f.clone()))
            .collect(),
        ..Graph::default()
    };
    let bends = graph.waypoints.iter().filter(|((from, to), _)| own(from) && own(to));
    part.waypoints = bends.map(|(ends, points)| (ends.clone(), points.clone())).collect();
    part
}

/// Whether a frame holds some of these nodes and no other.
fn stands_around(frame: &Frame, graph: &Graph, nodes: &BTreeSet<String>) -> bool {
    let inside = |[x, y]: [f64; 2]| {
        let [left, top] = frame.at;
        (left..left + frame.size[0]).contains(&x) && (top..top + frame.size[1]).contains(&y)
    };
    let mut held = graph.layout.iter().filter(|(_, at)| inside(**at)).peekable();
    held.peek().is_some() && held.all(|(name, _)| nodes.contains(name))
}

/// Nodes as a canonical text, with the links between them, where they lie, and frames that stand around nothing else.
pub fn copy(graph: &Graph, nodes: &BTreeSet<String>) -> String {
    write(&part(graph, nodes))
}

/// Adds the nodes of a text under free names, with its links and frames, and says what they are called. `at` is where
/// the top left one comes; without it they lie a little aside of where the text says.
///
/// # Errors
/// What is wrong with the text.
pub fn paste(graph: &Graph, text: &str, at: Option<[f64; 2]>) -> Result<(Edit, BTreeSet<String>), Vec<Diagnostic>> {
    let (part, found) = read(&SourceText::new("clipboard", text));
    match part {
        Some(part) if !has_errors(&found) => {
            let (edits, names) = put(graph, part, at);
            Ok((Edit::Batch(edits), names.into_values().collect()))
        }
        _ => Err(found),
    }
}

/// Adds copies of nodes a little aside, and says what they are called. With `keep_inputs`, what feeds a node from outside
/// feeds its copy, too.
pub fn duplicate(graph: &Graph, nodes: &BTreeSet<String>, keep_inputs: bool) -> (Edit, BTreeSet<String>) {
    let (mut edits, names) = put(graph, part(graph, nodes), None);
    for link in graph.links.iter().filter(|l| keep_inputs && !names.contains_key(&l.from.node)) {
        if let Some(name) = names.get(&link.to.node) {
            let to = End { node: name.clone(), port: link.to.port.clone() };
            edits.push(Edit::Link(Box::new(Link { to, span: None, ..link.clone() })));
        }
    }
    (Edit::Batch(edits), names.into_values().collect())
}

/// Edits that put one graph into another, and the new names by the old ones.
fn put(graph: &Graph, part: Graph, at: Option<[f64; 2]>) -> (Vec<Edit>, BTreeMap<String, String>) {
    let corners = || part.layout.values().chain(part.frames.values().map(|frame| &frame.at));
    let corner = corners().fold([f64::INFINITY; 2], |[x, y], at| [x.min(at[0]), y.min(at[1])]);
    let by = match at {
        Some(at) if corner.iter().all(|x| x.is_finite()) => [at[0] - corner[0], at[1] - corner[1]],
        _ => [ASIDE; 2],
    };
    let moved = |[x, y]: [f64; 2]| [x + by[0], y + by[1]];
    let (mut names, mut frames) = (Names::default(), Names::default());
    let taken = |name: &str| graph.nodes.contains_key(name);
    let new: BTreeMap<String, String> =
        part.nodes.keys().map(|name| (name.clone(), names.free(name, &taken))).collect();
    let end = |end: &End| End { node: new.get(&end.node).cloned().unwrap_or_default(), port: end.port.clone() };
    let mut edits = Vec::new();
    for (name, mut node) in part.nodes {
        let Some(new) = new.get(&name) else { continue };
        // The text that it was read from is gone when somebody asks.
        node.spans = Spans::default();
        edits.push(Edit::AddNode(new.clone(), Box::new(node)));
        let place = part.layout.get(&name).map(|place| moved(*place)).or(at);
        edits.extend(place.map(|place| Edit::Move(new.clone(), Some(place))));
        if part.collapsed.contains(&name) {
            edits.push(Edit::SetCollapsed(new.clone(), true));
        }
    }
    for link in part.links {
        let link = Link { from: end(&link.from), to: end(&link.to), span: None, ..link };
        edits.push(Edit::Link(Box::new(link)));
    }
    for ((from, to), points) in part.waypoints {
        let points = points.into_iter().map(moved).collect();
        edits.push(Edit::SetWaypoints(end(&from), end(&to), points));
    }
    for (title, mut frame) in part.frames {
        frame.at = moved(frame.at);
        let title = frames.numbered(&title, ' ', &|name| graph.frames.contains_key(name));
        edits.push(Edit::SetFrame(title, Some(Box::new(frame))));
    }
    (edits, new)
}
