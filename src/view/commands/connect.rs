//! Links between ports.

use std::collections::BTreeSet;

use super::{find_link, relink};
use crate::graph::{Edit, End, Graph, Link};
use crate::hash::HashMap;
use crate::node::Catalog;
use crate::semantic::Conversions;
use crate::view::fit::{Side, best, definition_of, is_open, lights, takes_light};

/// A link between two ends. Another link that is pinned to the same input makes place. A link from a light to what it
/// lights names no input, as the weaver finds it.
///
/// # Errors
/// Why they cannot be linked, in words.
pub fn connect(graph: &Graph, catalog: &Catalog, from: &End, to: &End) -> Result<Edit, String> {
    for end in [from, to] {
        if !graph.nodes.contains_key(&end.node) {
            return Err(format!("there is no node `{}`", end.node));
        }
    }
    if from.node == to.node {
        return Err("what a node computes cannot depend on itself".into());
    }
    let mut to = to.clone();
    let (source, target) = (definition_of(graph, catalog, &from.node), definition_of(graph, catalog, &to.node));
    if let Some(name) = &from.port
        && let Some(source) = &source
        && source.output(name).is_none()
    {
        return Err(format!("`{}` has no output `{name}`", from.node));
    }
    if let (Some(name), Some(target)) = (&to.port, &target)
        && target.input(name).is_none_or(|port| !is_open(port))
    {
        return Err(format!("`{}` has no input `{name}` that can be linked", to.node));
    }
    if let (Some(source), Some(target)) = (&source, &target) {
        let by_light = |name: &String| target.input(name).is_some_and(|port| takes_light(target, port));
        if lights(source, target) && to.port.as_ref().is_none_or(by_light) {
            to.port = None;
        } else {
            let given = Side { name: &from.node, definition: source, port: from.port.as_deref() };
            let wanted = Side { name: &to.node, definition: target, port: to.port.as_deref() };
            if best(&Conversions::default(), given, wanted, &|_| true).is_none() {
                return Err(mismatch(given, wanted));
            }
        }
    }
    if find_link(graph, from, &to).is_some() {
        return Err("they are linked already".into());
    }
    let rivals: Vec<&Link> = graph.links.iter().filter(|link| to.port.is_some() && link.to == to).collect();
    if leads_to(graph, &to.node, &from.node, &rivals) {
        return Err(format!("`{}` feeds `{}` already, and nothing can feed itself", to.node, from.node));
    }
    let mut edits: Vec<Edit> = rivals.iter().map(|link| Edit::Unlink(link.from.clone(), link.to.clone())).collect();
    edits.push(Edit::Link(Box::new(Link::new(from.clone(), to))));
    Ok(Edit::Batch(edits))
}

fn mismatch(from: Side<'_>, to: Side<'_>) -> String {
    let outputs = from.definition.main.outputs.iter().filter(|o| from.port.is_none_or(|name| name == o.name));
    let given: Vec<String> = outputs.map(|o| o.ty.to_string()).take(4).collect();
    let given = given.join(", ");
    match to.port.and_then(|name| to.definition.input(name)) {
        Some(port) => format!("`{}` gives {given}, and `{}.{}` takes {}", from.name, to.name, port.name, port.ty),
        None => format!("`{}` gives {given}, and no input of `{}` takes that", from.name, to.name),
    }
}

/// Whether links lead from one node to another, not counting some. Links of nodes that stand for subgraphs do not count:
/// what comes in there may have nothing to do with what goes out.
pub(super) fn leads_to(graph: &Graph, from: &str, to: &str, without: &[&Link]) -> bool {
    let plain = |name: &str| graph.nodes.get(name).is_some_and(|node| node.graph.is_none());
    if !plain(from) || !plain(to) {
        return false;
    }
    let mut next: HashMap<&str, Vec<&str>> = HashMap::default();
    for link in &graph.links {
        if plain(&link.from.node)
            && plain(&link.to.node)
            && !without.iter().any(|w| (&w.from, &w.to) == (&link.from, &link.to))
        {
            next.entry(&link.from.node).or_default().push(&link.to.node);
        }
    }
    let mut seen = BTreeSet::from([from]);
    let mut open = vec![from];
    while let Some(node) = open.pop() {
        if node == to {
            return true;
        }
        open.extend(next.get(node).into_iter().flatten().filter(|next| seen.insert(**next)));
    }
    false
}

/// Pins a link that names no ports, or others, to two ports. Its note and its bends stay.
pub fn pin(graph: &Graph, from: &End, to: &End, from_port: &str, to_port: &str) -> Edit {
    let mut edits = Vec::new();
    if let Some(link) = find_link(graph, from, to) {
        relink(graph, link, End::port(&from.node, from_port), End::port(&to.node, to_port), &mut edits);
    }
    Edit::Batch(edits)
}
