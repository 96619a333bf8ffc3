//! From text to graph, with everything that is wrong on the way.

use std::hash::BuildHasher;
use std::ops::Range;
use std::sync::Arc;

use foldhash::fast::RandomState;

use super::comments::{Item, Target};
use super::{End, Expose, Graph, Link, MAX_LINKS, check, comments, migrate, read_canvas, read_node};
use crate::diagnostic::{Diagnostic, Place, SourceText, Span};
use crate::hash::HashMap;
use crate::ron::{self, Field, Node, Tree, expect_fields, field, unknown_fields};

/// What was found wrong so far.
pub(super) struct Report {
    pub(super) source: Arc<SourceText>,
    found: Vec<Diagnostic>,
}

impl Report {
    /// Where a range of the text is.
    pub(super) fn at(&self, range: Range<usize>) -> Place {
        Place::span(Span::new(&self.source, range))
    }

    /// One more; beyond the limit only the fact that there are more is kept.
    pub(super) fn push(&mut self, diagnostic: Diagnostic) {
        check::push(&mut self.found, diagnostic, Place::file(&self.source.name));
    }

    /// Whether nothing more will be listed: suggestions are then not worth searching for.
    pub(super) fn is_full(&self) -> bool {
        self.found.len() >= check::MAX_REPORTED
    }

    /// The value of a reading, or nothing and its complaint reported.
    pub(super) fn take<T>(&mut self, reading: Result<T, Box<Diagnostic>>) -> Option<T> {
        reading.map_err(|diagnostic| self.push(*diagnostic)).ok()
    }

    /// Warns of fields that are not known, and gives them out to be kept.
    pub(super) fn unknown(&mut self, fields: &[Field], known: &[&str]) -> Vec<(String, Node)> {
        for warning in unknown_fields(fields, known, &self.source) {
            self.push(warning);
        }
        let unknown = fields.iter().filter(|f| !known.contains(&f.name.as_str()));
        unknown.map(|f| (f.name.clone(), f.value.clone())).collect()
    }

    /// An end, from a text.
    pub(super) fn end(&mut self, node: &Node) -> Option<End> {
        let source = self.source.clone();
        let text = self.take(node.as_str(&source))?;
        let end = End::parse(text).map_err(|message| {
            let help = "write `node` or `node.port`";
            self.push(Diagnostic::error("ST0055", message, node.place(&source)).help(help));
        });
        end.ok()
    }
}

/// Reads a graph. With errors, the graph is what could be made out; it can be shown, but writing it could lose
/// something.
pub fn read(source: &Arc<SourceText>) -> (Option<Graph>, Vec<Diagnostic>) {
    let (document, found) = ron::read(source);
    let mut report = Report { source: source.clone(), found };
    let graph = document.and_then(|document| graph(document, &mut report));
    (graph, report.found)
}

fn graph(mut document: ron::Document, report: &mut Report) -> Option<Graph> {
    let mut fields = root_fields(&mut document.root, report)?;
    if !migrate::migrate(&mut fields, &document.root, report) {
        return None;
    }
    let source = report.source.clone();
    let mut graph = Graph { source: Some(source.clone()), ..Graph::default() };
    for (name, text) in [("name", &mut graph.name), ("note", &mut graph.note)] {
        let given = field(&fields, name).and_then(|node| report.take(node.as_str(&source)));
        *text = given.unwrap_or_default().to_string();
    }
    let mut items = Vec::new();
    let before = report.found.len();
    if let Some(nodes) = field(&fields, "nodes").and_then(|n| report.take(n.as_map(&source))) {
        read_node::nodes(nodes, &mut graph, &mut items, report);
    }
    if report.found[before..].iter().any(|d| d.code == "ST0060") {
        // No node was read, so everything that names one would be wrong.
        return None;
    }
    if let Some(list) = field(&fields, "links").and_then(|n| report.take(n.as_list(&source))) {
        links(list, &mut graph, &mut items, report);
    }
    if let Some(output) = field(&fields, "output") {
        graph.output = report.end(output);
        graph.output_span = Some(Span::new(&source, output.span.clone()));
        check::end_exists(&graph, graph.output.as_ref(), "the output", || output.place(&source), report);
    }
    if let Some(node) = field(&fields, "expose") {
        graph.expose = expose(node, &graph, report);
    }
    read_canvas::canvas(&fields, &mut graph, report);
    let known = ["version", "name", "note", "nodes", "links", "output", "expose"];
    let known: Vec<&str> = known.into_iter().chain(read_canvas::FIELDS).collect();
    graph.unknown = report.unknown(&fields, &known);
    comments::keep(&document, &source.text, items, &mut graph);
    graph.sort_links();
    check::cycles(&graph).for_each(|cycle| report.push(cycle));
    Some(graph)
}

/// The fields of the `Graph(...)`, taken out of it.
fn root_fields(root: &mut Node, report: &mut Report) -> Option<Vec<Field>> {
    match &mut root.value {
        Tree::Struct(Some(name), fields) if name == "Graph" => return Some(std::mem::take(fields)),
        Tree::Tuple(Some(name), items) if name == "Graph" && items.is_empty() => return Some(Vec::new()),
        _ => {}
    }
    let name = match &root.value {
        Tree::Struct(name, _) => name.as_deref(),
        Tree::Tuple(name, items) if items.is_empty() => name.as_deref(),
        _ => None,
    };
    let place = report.at(root.span.start..root.span.start + name.map_or(1, str::len));
    let message = format!("expected `Graph(...)`, found {}", root.value.describe());
    let help = match name {
        Some("Scene" | "Study") => "this is a scene or study file; a graph file is needed here",
        _ => "a graph file is written `Graph(version: 1, nodes: {...}, links: [...])`",
    };
    report.push(Diagnostic::error("ST0050", message, place).help(help));
    None
}

fn links(list: &[Node], graph: &mut Graph, items: &mut Vec<Item<'_>>, report: &mut Report) {
    if list.len() > MAX_LINKS {
        let message = format!("the graph has {} links; at most {MAX_LINKS} are handled", list.len());
        report.push(Diagnostic::error("ST0060", message, report.at(list[MAX_LINKS].span.clone())));
        return;
    }
    let hasher = RandomState::default();
    // By hash of the ends, or the next number that was free.
    let mut seen: HashMap<u64, usize> = HashMap::default();
    for node in list {
        let Some(link) = link(node, report) else {
            continue;
        };
        let mut key = hasher.hash_one(link.ends());
        let other = |index: &usize| graph.links.get(*index).is_some_and(|known| known.ends() != link.ends());
        while seen.get(&key).is_some_and(other) {
            key = key.wrapping_add(1);
        }
        let index = *seen.entry(key).or_insert(graph.links.len());
        items.push(Item { span: node.span.clone(), target: Target::Link(index) });
        if let Some(first) = graph.links.get_mut(index) {
            let message = format!("the link `{link}` is given twice");
            report.push(Diagnostic::warning("ST0058", message, node.place(&report.source)).help("remove one of them"));
            comments::append(&mut first.note, &link.note);
            first.unknown.extend(link.unknown);
            continue;
        }
        check::link(graph, &link, report);
        graph.links.push(link);
    }
}

fn link(node: &Node, report: &mut Report) -> Option<Link> {
    let source = report.source.clone();
    let (ends, fields) = match &node.value {
        Tree::Struct(_, fields) => {
            let Some(ends) = field(fields, "link") else {
                let missing = Diagnostic::error("ST0011", "the link has no field `link`", node.place(&source));
                report.push(missing.help("write `(link: \"from -> to\", note: \"...\")`"));
                return None;
            };
            (ends, fields.as_slice())
        }
        _ => (node, &[][..]),
    };
    let text = report.take(ends.as_str(&source))?;
    match Link::parse(text) {
        Ok(mut link) => {
            link.span = Some(Span::new(&source, ends.span.clone()));
            let note = field(fields, "note").and_then(|n| report.take(n.as_str(&source)));
            link.note = note.unwrap_or_default().to_string();
            link.unknown = report.unknown(fields, &["link", "note"]);
            Some(link)
        }
        Err(message) => {
            let error = Diagnostic::error("ST0055", message, ends.place(&source));
            report.push(error.help("write `from -> to`, each a `node` or a `node.port`"));
            None
        }
    }
}

fn expose(node: &Node, graph: &Graph, report: &mut Report) -> Expose {
    let source = report.source.clone();
    let what = "`(inputs: {...}, outputs: {...}, options: {...})`";
    let fields = report.take(expect_fields(node, &source, what)).unwrap_or_default();
    let mut expose = Expose { unknown: report.unknown(fields, &["inputs", "outputs", "options"]), ..Expose::default() };
    for (name, fans) in [("inputs", &mut expose.inputs), ("options", &mut expose.options)] {
        for (public, value) in entries(fields, name, report) {
            let nodes = match &value.value {
                Tree::List(nodes) => nodes.as_slice(),
                _ => std::slice::from_ref(value),
            };
            let ends = nodes.iter().filter_map(|node| exposed(node, graph, report)).collect();
            fans.insert(public, ends);
        }
    }
    for (public, value) in entries(fields, "outputs", report) {
        if let Some(end) = exposed(value, graph, report) {
            expose.outputs.insert(public, end);
        }
    }
    expose
}

fn exposed(node: &Node, graph: &Graph, report: &mut Report) -> Option<End> {
    let source = report.source.clone();
    let end = report.end(node)?;
    check::end_exists(graph, Some(&end), "an exposed end", || node.place(&source), report);
    Some(end)
}

/// The entries of a map field whose keys are texts.
fn entries<'a>(fields: &'a [Field], name: &str, report: &mut Report) -> Vec<(String, &'a Node)> {
    let source = report.source.clone();
    let map = field(fields, name).and_then(|n| report.take(n.as_map(&source))).unwrap_or_default();
    map.iter().filter_map(|(key, value)| Some((report.take(key.as_str(&source))?.to_string(), value))).collect()
}
