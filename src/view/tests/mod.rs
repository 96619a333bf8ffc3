//! Documents, commands and layout against what they are expected to do.

mod documents;

use crate::diagnostic::SourceText;
use crate::graph::{self, Graph};

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
