//! Puts the content of subgraph files in place of the nodes that stand for them.
//!
//! The node `stone` that stands for a file with a node `noise` becomes the node `stone/noise`. Links to and from
//! `stone` lead on to what the file exposes; its parameters and options are set where the file says, over what the file
//! itself sets. A parameter can also name an inner port outright: `"noise.scale"`.
//!
//! A link that names no port leads to the one input that is exposed, or where none is, to the node that the file
//! exports; away from a subgraph it starts at what the file exports: its `output`, else its one exposed output, else
//! the one node that nothing follows.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::reroute::Router;
use super::{End, Graph, Link, MAX_LINKS, MAX_NESTING, MAX_NODES, check};
use crate::diagnostic::{Diagnostic, Place, has_errors};
use crate::ron;

/// Loads a subgraph: from its path as written and the canonical path of the file that says so (for the root: the name
/// of its source), to its own canonical path and itself. A graph that was read with errors is to be an `Err`.
pub type Loader<'a> = &'a dyn Fn(&str, &str) -> Result<(String, Arc<Graph>), Vec<Diagnostic>>;

/// A graph file: its canonical path and what it holds.
type Loaded = (String, Arc<Graph>);

/// Most bytes of graph text that subgraphs put in place, counted once for each use.
const MAX_TEXT: usize = 4 * ron::MAX_BYTES;

/// A node that stood for a subgraph.
pub(super) struct Stand {
    /// The subgraph.
    pub(super) inner: Arc<Graph>,
    /// The graph that the node was in, and its name there.
    pub(super) outer: Arc<Graph>,
    pub(super) name: String,
    /// Where a link away from it starts, in the subgraph's own names.
    pub(super) exported: Option<End>,
}

/// A graph to be put in place.
struct Task {
    graph: Arc<Graph>,
    /// Canonical paths of the files that led here, this one last.
    chain: Vec<Arc<str>>,
    /// What its node names are prefixed with: empty for the root, else ending in `/`.
    prefix: String,
    muted: bool,
}

#[derive(Default)]
struct Expander {
    flat: Graph,
    /// By full name.
    stands: BTreeMap<String, Stand>,
    /// Full names of the stands, outer before inner.
    order: Vec<String>,
    /// Links in full names, whose ends may be stands, and where each end is written.
    links: Vec<(Link, [Place; 2])>,
    loaded: BTreeMap<(String, String), Option<Loaded>>,
    text: usize,
    found: Vec<Diagnostic>,
}

/// Puts every subgraph in place. With errors there is no graph.
pub fn expand(root: &Graph, load: Loader<'_>) -> (Option<Graph>, Vec<Diagnostic>) {
    if root.nodes.values().all(|node| node.graph.is_none()) {
        return (Some(root.clone()), Vec::new());
    }
    let mut expander = Expander::default();
    let file: Arc<str> = root.source.as_ref().map_or_else(|| Arc::from(""), |source| source.name.as_str().into());
    let graph = Arc::new(root.clone());
    let mut tasks = vec![Task { graph: graph.clone(), chain: vec![file], prefix: String::new(), muted: false }];
    while let Some(task) = tasks.pop() {
        if expander.place(&task, load, &mut tasks).is_none() {
            return (None, expander.found);
        }
    }
    expander.finish(&graph)
}

impl Expander {
    fn push(&mut self, diagnostic: Diagnostic) {
        check::push(&mut self.found, diagnostic, Place::default());
    }

    /// Puts one graph in place, but for its subgraphs, which become tasks. Nothing: a limit is passed.
    fn place(&mut self, task: &Task, load: Loader<'_>, tasks: &mut Vec<Task>) -> Option<()> {
        let Task { graph, prefix, .. } = task;
        let nodes = self.flat.nodes.len() + self.order.len() + graph.nodes.len();
        self.text += graph.nodes.values().filter_map(|n| n.spans.whole.as_ref()).map(|s| s.range.len()).sum::<usize>();
        let links = self.links.len() + graph.links.len();
        for (what, size, most) in
            [("nodes", nodes, MAX_NODES), ("links", links, MAX_LINKS), ("bytes", self.text, MAX_TEXT)]
        {
            if size > most {
                let message = format!("with its subgraphs the graph has more than {most} {what}");
                let help = "an image or a node of your own does more with fewer nodes";
                self.push(Diagnostic::error("ST0060", message, graph.file_place()).help(help));
                return None;
            }
        }
        for (name, node) in &graph.nodes {
            let full = format!("{prefix}{name}");
            let Some(path) = &node.graph else {
                let mut node = node.clone();
                node.muted |= task.muted;
                self.flat.nodes.insert(full, node);
                continue;
            };
            if task.chain.len() > MAX_NESTING {
                let message = format!("subgraphs are nested more than {MAX_NESTING} deep at `{full}`");
                let help = "put what the innermost files hold into the files that use them";
                self.push(Diagnostic::error("ST0063", message, graph.kind_place(name)).help(help));
                return None;
            }
            let Some((file, inner)) = self.load(task, name, path, load) else {
                continue;
            };
            tasks.push(Task {
                graph: inner.clone(),
                chain: task.chain.iter().cloned().chain([file.into()]).collect(),
                prefix: format!("{full}/"),
                muted: task.muted || node.muted,
            });
            let exported = exported(&inner);
            self.stands.insert(full.clone(), Stand { inner, outer: graph.clone(), name: name.clone(), exported });
            self.order.push(full);
        }
        for link in &graph.links {
            let mut moved = link.clone();
            moved.from.node.insert_str(0, prefix);
            moved.to.node.insert_str(0, prefix);
            self.links.push((moved, [true, false].map(|from| graph.end_place(link, from, true))));
        }
        Some(())
    }

    fn load(&mut self, task: &Task, name: &str, path: &str, load: Loader<'_>) -> Option<(String, Arc<Graph>)> {
        let place = task.graph.kind_place(name);
        let by = task.chain.last().map_or_else(String::new, |file| file.to_string());
        let key = (path.to_string(), by.clone());
        if !self.loaded.contains_key(&key) {
            let result = match load(path, &by) {
                Ok(loaded) => Some(loaded),
                Err(found) => {
                    for mut diagnostic in found {
                        // What has no place in a text is about the path, and that stands here.
                        if diagnostic.place.span.is_none() {
                            diagnostic.place = place.clone();
                        }
                        self.push(diagnostic);
                    }
                    if !has_errors(&self.found) {
                        let message = format!("the graph `{path}` could not be loaded");
                        self.push(Diagnostic::error("ST0068", message, place.clone()));
                    }
                    None
                }
            };
            self.loaded.insert(key.clone(), result);
        }
        let (file, inner) = self.loaded.get(&key).cloned().flatten()?;
        if let Some(start) = task.chain.iter().position(|f| **f == *file) {
            let cycle: Vec<&str> = task.chain[start..].iter().map(|f| &**f).chain([file.as_str()]).collect();
            let message = match cycle[..] {
                [one, _] => format!("the graph file {one} contains itself"),
                _ => format!("these graph files contain each other: {}", cycle.join(" -> ")),
            };
            let help = "remove this node, or move what both need into a third file";
            self.push(Diagnostic::error("ST0062", message, place).help(help));
            return None;
        }
        Some((file, inner))
    }

    /// Leads links, parameters, options, the output and what is exposed to the nodes in place.
    fn finish(mut self, root: &Graph) -> (Option<Graph>, Vec<Diagnostic>) {
        if has_errors(&self.found) {
            return (None, self.found);
        }
        let mut router = Router::new(&self.stands, &mut self.flat, &mut self.found);
        // Inner before outer, so that the outer setting stays.
        for full in self.order.iter().rev() {
            router.settings(full);
        }
        let mut links: BTreeMap<(End, End), Link> = BTreeMap::new();
        for (link, [start, end]) in self.links {
            let Some(from) = router.output(link.from.clone(), &start) else {
                continue;
            };
            for to in router.inputs(link.to.clone(), &end) {
                let ends = (from.clone(), to.clone());
                links.entry(ends).or_insert_with(|| Link { from: from.clone(), to, ..link.clone() });
            }
            if links.len() > MAX_LINKS || router.exhausted() {
                let message = format!("with its subgraphs the graph has more than {MAX_LINKS} links");
                self.found.push(Diagnostic::error("ST0060", message, root.file_place()));
                return (None, self.found);
            }
        }
        let place = root.output_place();
        let output = match &root.output {
            Some(output) => Some(output.clone()),
            // Inside a subgraph other nodes may have nothing that follows them, so what is meant is said.
            None => exported(root).filter(|end| self.stands.contains_key(&end.node)),
        };
        let output = output.and_then(|end| router.output(end, &place));
        let expose = router.expose(&root.expose, &root.file_place());
        let flat = &mut self.flat;
        flat.links = links.into_values().collect();
        flat.output = output;
        flat.expose = expose;
        flat.output_span.clone_from(&root.output_span);
        flat.name.clone_from(&root.name);
        flat.note.clone_from(&root.note);
        flat.unknown.clone_from(&root.unknown);
        flat.source.clone_from(&root.source);
        // Frames and bends belong to the canvas of one file.
        flat.layout = root.layout.clone();
        flat.layout.retain(|name, _| flat.nodes.contains_key(name));
        for cycle in check::cycles(flat) {
            check::push(&mut self.found, cycle, Place::default());
        }
        self.found.sort_by_key(|d| d.place.span.as_ref().map(|s| (s.source.name.clone(), s.range.start)));
        let graph = if has_errors(&self.found) { None } else { Some(self.flat) };
        (graph, self.found)
    }
}

/// Where a link away from a graph starts: what it exports.
fn exported(graph: &Graph) -> Option<End> {
    if let Some(output) = &graph.output {
        return Some(output.clone());
    }
    let mut outputs = graph.expose.outputs.values();
    if let (Some(only), None) = (outputs.next(), outputs.next()) {
        return Some(only.clone());
    }
    let followed: BTreeSet<&String> = graph.links.iter().map(|link| &link.from.node).collect();
    let mut last = graph.nodes.keys().filter(|name| !followed.contains(name));
    match (last.next(), last.next()) {
        (Some(only), None) => Some(End::node(only)),
        _ => None,
    }
}
