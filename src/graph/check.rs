//! What can be wrong with a graph without knowing its nodes.

use crate::hash::HashMap;

use super::read::Report;
use super::{End, Graph, Link};
use crate::diagnostic::{Diagnostic, Place, did_you_mean};

/// Most cycles that are told of; breaking a few usually breaks the others.
const MAX_CYCLES: usize = 8;
/// Most nodes of a cycle that are spelled out.
const MAX_PATH: usize = 16;

/// Most mistakes of one graph that are listed.
pub(super) const MAX_REPORTED: usize = 100;

/// One more mistake; beyond the limit only the fact that there are more is kept.
pub(super) fn push(found: &mut Vec<Diagnostic>, diagnostic: Diagnostic, file: Place) {
    if found.len() < MAX_REPORTED {
        found.push(diagnostic);
    } else if found.len() == MAX_REPORTED {
        let message = format!("more than {MAX_REPORTED} mistakes; the rest are not listed");
        found.push(Diagnostic::error("ST0066", message, file).help("correct these first"));
    }
}

/// Reports an end whose node does not exist.
pub(super) fn end_exists(
    graph: &Graph,
    end: Option<&End>,
    what: &str,
    place: impl FnOnce() -> Place,
    report: &mut Report,
) {
    let Some(end) = end.filter(|end| !graph.nodes.contains_key(&end.node)) else {
        return;
    };
    if report.is_full() {
        return report.push(Diagnostic::error("ST0056", "", Place::default()));
    }
    let message = format!("{what} names the node `{}`, which is not in the graph", end.node);
    let error = Diagnostic::error("ST0056", message, place());
    report.push(match did_you_mean(&end.node, graph.nodes.keys().map(String::as_str)) {
        Some(near) => error.help(format!("did you mean `{near}`?")),
        None => error.help(listed(graph)),
    });
}

/// The nodes that there are, in words.
fn listed(graph: &Graph) -> String {
    let names: Vec<String> = graph.nodes.keys().take(MAX_PATH).map(|name| format!("`{name}`")).collect();
    let more = if graph.nodes.len() > names.len() { ", ..." } else { "" };
    if names.is_empty() { "the graph has no nodes".into() } else { format!("its nodes are {}{more}", names.join(", ")) }
}

/// Reports a link that cannot be.
pub(super) fn link(graph: &Graph, link: &Link, report: &mut Report) {
    for (end, from) in [(&link.from, true), (&link.to, false)] {
        // The place of a node that is not there is only its text.
        let place = || graph.end_place(link, from, false).span.map_or_else(|| graph.link_place(link), Place::span);
        end_exists(graph, Some(end), "the link", place, report);
    }
    if link.from.node == link.to.node {
        let message = format!("the link leads from `{}` to itself", link.from.node);
        let help = "remove it: what a node computes cannot depend on itself";
        report.push(Diagnostic::error("ST0057", message, graph.link_place(link)).help(help));
    }
}

/// The cycles among the links.
pub(super) fn cycles(graph: &Graph) -> impl Iterator<Item = Diagnostic> {
    find_cycles(graph, MAX_CYCLES).into_iter().map(|cycle| {
        let place = graph.link_place(&graph.links[cycle.closing]);
        let error = Diagnostic::error("ST0059", format!("the links form a cycle: {}", spell(&cycle.nodes)), place);
        error.help("remove one of its links")
    })
}

/// A cycle: its nodes in the order of the links, and the index of the link from the last to the first.
pub(super) struct Cycle {
    pub(super) nodes: Vec<String>,
    closing: usize,
}

/// The cycle in words: `a -> b -> a`.
pub(super) fn spell(nodes: &[String]) -> String {
    let mut path: Vec<&str> = nodes.iter().map(String::as_str).take(MAX_PATH).collect();
    if nodes.len() > MAX_PATH {
        path.push("...");
    }
    path.extend(nodes.first().map(String::as_str));
    path.join(" -> ")
}

/// Up to `most` cycles of two and more nodes, each found once. Iterative depth-first search. Links of a node that stands
/// for a subgraph do not count: what comes in there may have nothing to do with what goes out. They are looked at once
/// the subgraph is in place.
pub(super) fn find_cycles(graph: &Graph, most: usize) -> Vec<Cycle> {
    #[derive(Clone, Copy, PartialEq)]
    enum Mark {
        New,
        Open,
        Done,
    }
    let names: Vec<&String> = graph.nodes.iter().filter(|(_, n)| n.graph.is_none()).map(|(name, _)| name).collect();
    let numbers: HashMap<&String, usize> = names.iter().enumerate().map(|(i, name)| (*name, i)).collect();
    let mut next: Vec<Vec<(usize, usize)>> = vec![Vec::new(); names.len()];
    for (index, link) in graph.links.iter().enumerate() {
        if let (Some(&from), Some(&to)) = (numbers.get(&link.from.node), numbers.get(&link.to.node))
            && from != to
        {
            next[from].push((to, index));
        }
    }
    let mut marks = vec![Mark::New; names.len()];
    let mut cycles = Vec::new();
    for root in 0..names.len() {
        if marks[root] != Mark::New {
            continue;
        }
        let mut path = vec![(root, 0)];
        marks[root] = Mark::Open;
        while let Some((node, step)) = path.last_mut() {
            let Some(&(to, closing)) = next[*node].get(*step) else {
                marks[*node] = Mark::Done;
                path.pop();
                continue;
            };
            *step += 1;
            match marks[to] {
                Mark::Done => {}
                Mark::New => {
                    marks[to] = Mark::Open;
                    path.push((to, 0));
                }
                Mark::Open => {
                    let start = path.iter().position(|(n, _)| *n == to).unwrap_or(0);
                    let nodes = path[start..].iter().map(|(n, _)| names[*n].clone()).collect();
                    cycles.push(Cycle { nodes, closing });
                    if cycles.len() >= most {
                        return cycles;
                    }
                }
            }
        }
    }
    cycles
}
