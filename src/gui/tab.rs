//! One open graph: its document, its file, and how it is looked at. None of the looks is part of the document.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::canvas::{Camera, Cards, Gesture};
use super::feed::Wiring;
use crate::graph::{End, Graph};
use crate::view::{Document, pin};

/// An open graph.
pub(super) struct Tab {
    pub(super) document: Document,
    /// Its file; none before it is first saved.
    pub(super) path: Option<PathBuf>,
    /// What it goes by while it has no file: a path that no file has.
    made_up: PathBuf,
    /// The text of the file when it was last read or written here.
    pub(super) on_disk: Option<String>,
    /// Revision that the recovery file holds.
    pub(super) recovered: u64,
    pub(super) selection: BTreeSet<String>,
    /// Revision of which what is selected is known to be there.
    tidied: Option<u64>,
    /// The selected link, by its ends.
    pub(super) link: Option<(End, End)>,
    /// The selected frame.
    pub(super) frame: Option<String>,
    pub(super) camera: Camera,
    /// Whether all nodes were brought into view once.
    pub(super) fitted: bool,
    pub(super) cards: Cards,
    pub(super) gesture: Gesture,
    /// The graph that this one was opened from, and the node there that stands for it.
    pub(super) outer: Option<(PathBuf, String)>,
}

impl Tab {
    pub(super) fn new(graph: Graph, path: Option<PathBuf>, number: usize) -> Self {
        let document = Document::new(graph);
        let recovered = document.revision();
        Self {
            document,
            path,
            made_up: PathBuf::from(format!("untitled-{number}.ron")),
            on_disk: None,
            recovered,
            selection: BTreeSet::new(),
            tidied: None,
            link: None,
            frame: None,
            camera: Camera::default(),
            fitted: false,
            cards: Cards::default(),
            gesture: Gesture::default(),
            outer: None,
        }
    }

    /// The path that it goes by: its file's, or a made-up one.
    pub(super) fn key(&self) -> &Path {
        self.path.as_deref().unwrap_or(&self.made_up)
    }

    pub(super) fn graph(&self) -> &Graph {
        self.document.graph()
    }

    /// What the tab is called.
    pub(super) fn title(&self) -> String {
        let stem = self.key().file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
        if self.document.is_changed() { format!("{stem} *") } else { stem }
    }

    /// Forgets what is no longer there, as after an undo.
    pub(super) fn tidy(&mut self) {
        let revision = self.document.revision();
        if self.tidied == Some(revision) {
            return;
        }
        self.tidied = Some(revision);
        let graph = self.document.graph();
        self.selection.retain(|name| graph.nodes.contains_key(name));
        if self.link.as_ref().is_some_and(|(from, to)| !graph.links.iter().any(|l| l.from == *from && l.to == *to)) {
            self.link = None;
        }
        if self.frame.as_ref().is_some_and(|f| !graph.frames.contains_key(f)) {
            self.frame = None;
        }
    }

    /// Selects one node.
    pub(super) fn select(&mut self, node: &str) {
        self.selection = BTreeSet::from([node.to_owned()]);
        self.link = None;
        self.frame = None;
    }

    /// Writes the ports that a link came to into it, and keeps it selected.
    pub(super) fn pin(&mut self, wiring: &Wiring, from: &End, to: &End) -> Result<(), String> {
        let found = wiring.get(&(from.node.clone(), to.node.clone())).and_then(|w| w.first());
        let Some(wire) = found.filter(|_| from.port.is_none() || to.port.is_none()) else {
            return Err("the ports of this link are not known yet, or it has them already".into());
        };
        let edit = pin(self.graph(), from, to, &wire.from.1, &wire.to.1);
        self.document.change("Pin link", edit).map_err(|e| e.to_string())?;
        self.link = Some((End::port(&from.node, &wire.from.1), End::port(&to.node, &wire.to.1)));
        Ok(())
    }

    /// The one node that is selected.
    pub(super) fn only(&self) -> Option<&str> {
        let mut names = self.selection.iter();
        names.next().filter(|_| names.next().is_none()).map(String::as_str)
    }

    /// Nodes that feed these, directly or not, with them.
    pub(super) fn upstream(&self) -> BTreeSet<String> {
        let mut feeds: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for link in &self.graph().links {
            feeds.entry(&link.to.node).or_default().push(&link.from.node);
        }
        let mut all = self.selection.clone();
        let mut open: Vec<String> = all.iter().cloned().collect();
        while let Some(name) = open.pop() {
            for from in feeds.get(name.as_str()).into_iter().flatten() {
                if all.insert((*from).to_owned()) {
                    open.push((*from).to_owned());
                }
            }
        }
        all
    }
}
