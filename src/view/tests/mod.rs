//! Documents, commands and layout against what they are expected to do.

mod arranging;
mod commands;
mod documents;
mod properties;
mod showing;
mod subgraphs;

use std::collections::BTreeSet;

use crate::diagnostic::SourceText;
use crate::graph::{self, Edit, End, Graph, Link, apply};
use crate::node::Catalog;

/// A graph that is read without a word.
fn clean(text: &str) -> Graph {
    let (graph, found) = graph::read(&SourceText::new("t.ron", text));
    assert!(found.is_empty(), "{text}\n{found:#?}");
    graph.unwrap()
}

/// A graph of these nodes (`name kind`) and links.
fn small(nodes: &[&str], links: &[&str]) -> Graph {
    let node = |text: &&str| {
        let (name, kind) = text.split_once(' ').unwrap();
        format!("\"{name}\": (kind: \"{kind}\")")
    };
    let nodes: Vec<String> = nodes.iter().map(node).collect();
    let links: Vec<String> = links.iter().map(|link| format!("\"{link}\"")).collect();
    clean(&format!("Graph(version: 1, nodes: {{{}}}, links: [{}])", nodes.join(", "), links.join(", ")))
}

fn catalog() -> Catalog {
    Catalog::embedded()
}

fn end(text: &str) -> End {
    End::parse(text).unwrap()
}

fn set(names: &[&str]) -> BTreeSet<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn links(graph: &Graph) -> Vec<String> {
    graph.links.iter().map(Link::to_string).collect()
}

/// The graph after an edit, and that taking it back restores every byte.
fn after(graph: &Graph, edit: Edit) -> Graph {
    let mut changed = graph.clone();
    let inverse = apply(&mut changed, edit).unwrap();
    let mut back = changed.clone();
    apply(&mut back, inverse).unwrap();
    assert_eq!(graph::write(&back), graph::write(graph));
    changed
}
