//! Graphs that nodes stand for: those that are open, else their files. Read again when they change.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use super::tab::Tab;
use crate::diagnostic::{SourceText, has_errors};
use crate::graph::{self, Graph};

/// A graph as a file had it.
type Read = (Option<SystemTime>, Option<Arc<Graph>>);

/// Graphs by path.
#[derive(Default)]
pub(super) struct Library {
    open: BTreeMap<PathBuf, (u64, Arc<Graph>)>,
    files: RefCell<BTreeMap<PathBuf, Read>>,
}

/// A path without `.` and `..`, as far as that can be said without looking at files.
pub(super) fn plain(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            std::path::Component::CurDir => {}
            std::path::Component::ParentDir if out.file_name().is_some() => drop(out.pop()),
            other => out.push(other),
        }
    }
    out
}

impl Library {
    /// Takes over the graphs of tabs that changed.
    pub(super) fn refresh(&mut self, tabs: &[Tab], active: usize) {
        let keys: Vec<PathBuf> = tabs.iter().map(|t| plain(t.key())).collect();
        self.open.retain(|key, _| keys.contains(key));
        // A graph cannot hold itself, so that the one that is being edited is taken over when it is left.
        for (_, (tab, key)) in tabs.iter().zip(keys).enumerate().filter(|(i, _)| *i != active) {
            let revision = tab.document.revision();
            if self.open.get(&key).is_none_or(|(known, _)| *known != revision) {
                self.open.insert(key, (revision, Arc::new(tab.graph().clone())));
            }
        }
    }

    /// The graph at a path that is mentioned in a file.
    pub(super) fn get(&self, mentioned_in: &Path, path: &str) -> Option<Arc<Graph>> {
        let full = plain(&mentioned_in.parent().unwrap_or(Path::new("")).join(path));
        if let Some((_, graph)) = self.open.get(&full) {
            return Some(graph.clone());
        }
        let modified = std::fs::metadata(&full).and_then(|m| m.modified()).ok();
        let mut files = self.files.borrow_mut();
        if let Some((stamp, graph)) = files.get(&full)
            && *stamp == modified
        {
            return graph.clone();
        }
        let graph = std::fs::read_to_string(&full).ok().and_then(|text| {
            let (graph, found) = graph::read(&SourceText::new(full.display().to_string(), text));
            graph.filter(|_| !has_errors(&found)).map(Arc::new)
        });
        files.insert(full, (modified, graph.clone()));
        graph
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_made_plain() {
        for (path, expected) in [("a/../b.ron", "b.ron"), ("./a/./b", "a/b"), ("../a", "../a"), ("/x/y/../../z", "/z")]
        {
            assert_eq!(plain(Path::new(path)), PathBuf::from(expected), "{path}");
        }
    }
}
