//! Taking nodes away.

use std::collections::BTreeSet;

use super::connect::leads_to;
use crate::graph::{Edit, End, Graph, Link};
use crate::hash::{HashMap, HashSet};

/// Removes nodes. With `heal`, what fed a removed node feeds what it fed, as with a muted one: of several the first.
pub fn delete(graph: &Graph, nodes: &BTreeSet<String>, heal: bool) -> Edit {
    let gone: Vec<&String> = nodes.iter().filter(|name| graph.nodes.contains_key(*name)).collect();
    let mut edits: Vec<Edit> = gone.iter().map(|name| Edit::RemoveNode((*name).clone())).collect();
    if heal {
        edits.extend(healed(graph, nodes).into_iter().map(|link| Edit::Link(Box::new(link))));
    }
    Edit::Batch(edits)
}

fn healed(graph: &Graph, nodes: &BTreeSet<String>) -> Vec<Link> {
    let gone = |name: &str| nodes.contains(name);
    let mut source: HashMap<&str, Option<&End>> = HashMap::default();
    for link in graph.links.iter().filter(|l| gone(&l.to.node)) {
        source.entry(&link.to.node).or_insert(Some(&link.from));
    }
    let stays: HashSet<(&End, &End)> = graph.links.iter().map(|link| (&link.from, &link.to)).collect();
    // Through a subgraph a cycle may be none, which without it is one.
    let has_subgraph = nodes.iter().any(|name| graph.nodes.get(name).is_some_and(|n| n.graph.is_some()));
    let mut made = BTreeSet::new();
    let mut links: Vec<Link> = Vec::new();
    let mut trial = has_subgraph.then(|| {
        let mut trial = graph.clone();
        trial.links.retain(|l| !gone(&l.from.node) && !gone(&l.to.node));
        trial
    });
    for link in graph.links.iter().filter(|l| gone(&l.from.node) && !gone(&l.to.node)) {
        let mut from = Some(&link.from);
        let mut passed = Vec::new();
        while let Some(end) = from.filter(|end| gone(&end.node)) {
            passed.push(end.node.as_str());
            // Taken out while it is followed, so that a cycle ends.
            from = source.insert(&end.node, None).flatten();
        }
        for name in passed {
            source.insert(name, from);
        }
        let Some(from) = from.filter(|from| from.node != link.to.node) else { continue };
        if stays.contains(&(from, &link.to)) || !made.insert((from, &link.to)) {
            continue;
        }
        let new = Link::new(from.clone(), link.to.clone());
        if let Some(trial) = &mut trial {
            if leads_to(trial, &link.to.node, &from.node, &[]) {
                continue;
            }
            trial.links.push(new.clone());
        }
        links.push(new);
    }
    links
}
