//! Input that nobody means well with: too much, too deep, broken, or endless. Every one must end, in bounded memory,
//! with a result or with an error that says what is wrong; never with a panic.

#[cfg(unix)]
mod files;
mod fuzz;
mod large;
mod random;

use std::collections::BTreeMap;

use shadetree::compile::{NamedGraph, Options, compile};
use shadetree::diagnostic::{Diagnostic, SourceText, has_errors};
use shadetree::graph;

use crate::support::{catalog, prove};

/// What a text as a graph came to.
pub(super) struct Made {
    /// The text of the shader, if there is one; naga accepted it.
    pub(super) wgsl: Option<String>,
    /// Everything that was found.
    pub(super) found: Vec<Diagnostic>,
}

impl Made {
    #[track_caller]
    pub(super) fn works(self) -> String {
        assert!(!has_errors(&self.found), "{}", crate::support::show(&self.found));
        self.wgsl.expect("no errors, so there is a shader")
    }

    /// The codes of the errors; there must be some, and not too many to read.
    #[track_caller]
    pub(super) fn fails(self) -> Vec<&'static str> {
        assert!(self.wgsl.is_none() && has_errors(&self.found), "it works");
        assert!(self.found.len() <= 300, "{} diagnostics", self.found.len());
        let bytes: usize = self.found.iter().map(|d| d.message.len() + d.help.as_ref().map_or(0, String::len)).sum();
        let notes: usize = self.found.iter().flat_map(|d| &d.notes).map(String::len).sum();
        assert!(bytes + notes < 300_000, "{} bytes of messages", bytes + notes);
        self.found.iter().map(|d| d.code).collect()
    }
}

/// Reads, expands, compiles and proves a graph.
pub(super) fn make(text: &str) -> Made {
    make_named("hostile.ron", text)
}

/// As [`make`], for a graph whose paths count from a file of the package.
pub(super) fn make_named(file: &str, text: &str) -> Made {
    let source = SourceText::new(file, text);
    let (graph, mut found) = graph::read(&source);
    let Some(graph) = graph.filter(|_| !has_errors(&found)) else { return Made { wgsl: None, found } };
    let (graph, more) = graph::expand(&graph, &load);
    found.extend(more);
    let Some(graph) = graph.filter(|_| !has_errors(&found)) else { return Made { wgsl: None, found } };
    let named = NamedGraph { name: "hostile".into(), graph, set: BTreeMap::new() };
    let (compiled, more) = compile(&[named], catalog(), &Options::default());
    found.extend(more);
    let Some(compiled) = compiled else {
        assert!(has_errors(&found), "nothing came out and nothing is wrong: {text}");
        return Made { wgsl: None, found };
    };
    prove(&compiled, text.get(..4000).unwrap_or(text));
    Made { wgsl: Some(compiled.module.wgsl), found }
}

/// Subgraphs from the package's files.
fn load(path: &str, from: &str) -> Result<(String, std::sync::Arc<graph::Graph>), Vec<Diagnostic>> {
    let full = std::path::Path::new(from).parent().unwrap_or(std::path::Path::new("")).join(path);
    let name = full.display().to_string();
    let Ok(text) = std::fs::read_to_string(crate::support::root().join(&full)) else { return Err(Vec::new()) };
    match graph::read(&SourceText::new(&*name, text)) {
        (Some(graph), found) if !has_errors(&found) => Ok((name, std::sync::Arc::new(graph))),
        (_, found) => Err(found),
    }
}
