//! Reading, writing, migrating, editing and expanding graphs.

mod edits;
mod files;
mod subgraphs;

use super::*;
use crate::diagnostic::{Diagnostic, SourceText};

/// A graph that is read without a word.
fn clean(text: &str) -> Graph {
    let (graph, found) = read(&SourceText::new("t.ron", text));
    assert!(found.is_empty(), "{text}\n{found:#?}");
    graph.unwrap()
}

/// `code line:column message` of each.
fn told(found: &[Diagnostic]) -> Vec<String> {
    let one = |d: &Diagnostic| {
        let at = d.place.span.as_ref().map_or_else(String::new, |span| {
            let (line, column) = span.line_column();
            format!("{line}:{column} ")
        });
        format!("{} {at}{}", d.code, d.message)
    };
    found.iter().map(one).collect()
}
