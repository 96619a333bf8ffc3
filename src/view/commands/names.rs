//! Names that are free.

use std::collections::{BTreeMap, BTreeSet};

use crate::graph::{Graph, check_name};

/// Longest part of a name that a number is put behind, in bytes.
const MAX_BASE: usize = 80;

/// A name for a new node: the wanted one, or with a number behind it. What a name cannot hold is left out.
pub fn free_name(graph: &Graph, wanted: &str) -> String {
    Names::default().free(wanted, &|name| graph.nodes.contains_key(name))
}

/// Names that were given out.
#[derive(Default)]
pub(super) struct Names {
    given: BTreeSet<String>,
    /// The last number behind each name, so that a thousand of the same name take no million looks.
    last: BTreeMap<String, usize>,
}

impl Names {
    /// A node's name that is neither taken nor given out, and is now given out.
    pub(super) fn free(&mut self, wanted: &str, taken: &dyn Fn(&str) -> bool) -> String {
        let fine = |c: &char| c.is_alphanumeric() || matches!(c, '_' | '-' | ' ');
        let kept: String = wanted.chars().filter(fine).collect();
        let kept = if check_name(kept.trim()).is_ok() { kept.trim() } else { cut(kept.trim()) };
        self.numbered(if kept.is_empty() { "node" } else { kept }, '_', taken)
    }

    /// The wanted text, or with a number behind it.
    pub(super) fn numbered(&mut self, wanted: &str, mark: char, taken: &dyn Fn(&str) -> bool) -> String {
        if !taken(wanted) && self.given.insert(wanted.to_owned()) {
            return wanted.to_owned();
        }
        let stem = wanted.trim_end_matches(|c: char| c.is_ascii_digit());
        let base = stem.strip_suffix(mark).filter(|s| !s.is_empty() && stem.len() < wanted.len()).unwrap_or(wanted);
        let base = cut(base);
        let last = self.last.entry(base.to_owned()).or_insert(1);
        loop {
            *last += 1;
            let name = format!("{base}{mark}{last}");
            if !taken(&name) && self.given.insert(name.clone()) {
                return name;
            }
        }
    }
}

/// The first bytes of a text.
fn cut(text: &str) -> &str {
    text.get(..text.floor_char_boundary(MAX_BASE)).unwrap_or_default().trim_end()
}

/// A port's name made of any text.
pub(super) fn port_name(text: &str) -> String {
    let name: String = text.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
    if name.is_empty() { "port".into() } else { name }
}
