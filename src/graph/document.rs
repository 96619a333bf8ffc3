//! The graph as data.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::sync::Arc;

use crate::diagnostic::{Place, SourceText, Span};
use crate::ron;
use crate::semantic::Value;

/// A shade tree as a person wrote it.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    /// Title for people.
    pub name: String,
    /// What the graph is for.
    pub note: String,
    /// Nodes by name.
    pub nodes: BTreeMap<String, Node>,
    /// Links, sorted by their ends, none twice.
    pub links: Vec<Link>,
    /// The node, and perhaps port, that the graph exports. Unset: the one that nothing follows.
    pub output: Option<End>,
    /// Where `output` was written.
    pub output_span: Option<Span>,
    /// What a graph that contains this one can reach by name.
    pub expose: Expose,
    /// Canvas positions of nodes, in points, y down.
    pub layout: BTreeMap<String, [f64; 2]>,
    /// Frames and remarks on the canvas, by title.
    pub frames: BTreeMap<String, Frame>,
    /// Nodes that are drawn small.
    pub collapsed: BTreeSet<String>,
    /// Where links bend on the canvas, by their ends, in order from their start.
    pub waypoints: BTreeMap<(End, End), Vec<[f64; 2]>>,
    /// Fields of the file that this version does not know, in file order.
    pub unknown: Vec<(String, ron::Node)>,
    /// The text it was read from.
    pub source: Option<Arc<SourceText>>,
}

/// A rectangle with a title on the canvas, which may stand around nodes or be a remark of its own.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    /// Top left corner, in points, y down.
    pub at: [f64; 2],
    /// Width and height, in points, above zero.
    pub size: [f64; 2],
    /// Red, green and blue from 0 to 1, as displays take them (sRGB). Unset: gray.
    pub color: Option<[f64; 3]>,
    /// A remark.
    pub text: String,
    /// Fields that this version does not know, in file order.
    pub unknown: Vec<(String, ron::Node)>,
}

/// One node of a graph.
#[derive(Clone, Debug, Default)]
pub struct Node {
    /// Which definition it is an instance of; empty where `graph` is given.
    pub kind: String,
    /// Path of a graph file that stands in its place, as written: relative to the file that says so.
    pub graph: Option<String>,
    /// The WGSL of a node that is defined in place.
    pub wgsl: Option<String>,
    /// Values of ports by port name; in a node that stands for a subgraph also by exposed name or as `node.port`.
    pub params: BTreeMap<String, Value>,
    /// Structural choices by option name.
    pub options: BTreeMap<String, String>,
    /// A remark.
    pub note: String,
    /// Whether the node is passed over.
    pub muted: bool,
    /// Fields that this version does not know, in file order.
    pub unknown: Vec<(String, ron::Node)>,
    /// Where its parts were written.
    pub spans: Spans,
}

/// Where the parts of a node were written. A part that was never in a text has no span.
#[derive(Clone, Debug, Default)]
pub struct Spans {
    /// The node: from its name to its closing bracket.
    pub whole: Option<Span>,
    /// The node's name.
    pub name: Option<Span>,
    /// The value of `kind`, or of `graph`.
    pub kind: Option<Span>,
    /// The content of `wgsl`, without quotes.
    pub wgsl: Option<Span>,
    /// The value of each parameter. A text that is a path counts from the file of its span.
    pub params: BTreeMap<String, Span>,
    /// The value of each option.
    pub options: BTreeMap<String, Span>,
    /// The name of each parameter and of each option, apart from each other.
    pub names: BTreeMap<(Setting, String), Span>,
}

/// What a name under a node stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Setting {
    /// An entry of `params`.
    Param,
    /// An entry of `options`.
    Option,
}

/// One end of a link: a node, and perhaps one port of it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct End {
    /// Name of the node.
    pub node: String,
    /// Name of the port, where it is pinned.
    pub port: Option<String>,
}

/// One node contributes to another.
#[derive(Clone, Debug)]
pub struct Link {
    /// The contributing end.
    pub from: End,
    /// The end contributed to.
    pub to: End,
    /// A remark.
    pub note: String,
    /// Fields that this version does not know, in file order.
    pub unknown: Vec<(String, ron::Node)>,
    /// Where it was written.
    pub span: Option<Span>,
}

/// What a graph offers where it is used as a subgraph.
#[derive(Clone, Debug, Default)]
pub struct Expose {
    /// Inner ports by public name: links lead to them and parameters set them. One name can feed several ports.
    pub inputs: BTreeMap<String, Vec<End>>,
    /// Inner ports by public name that links lead away from.
    pub outputs: BTreeMap<String, End>,
    /// Inner options, as `node.option`, by public name.
    pub options: BTreeMap<String, Vec<End>>,
    /// Fields that this version does not know, in file order.
    pub unknown: Vec<(String, ron::Node)>,
}

impl Expose {
    /// Whether nothing is exposed.
    pub fn is_empty(&self) -> bool {
        self.inputs.is_empty() && self.outputs.is_empty() && self.options.is_empty() && self.unknown.is_empty()
    }

    /// Every inner end that is named.
    pub fn ends(&self) -> impl Iterator<Item = &End> {
        self.inputs.values().chain(self.options.values()).flatten().chain(self.outputs.values())
    }

    /// Every inner end that is named, to change.
    pub(crate) fn ends_mut(&mut self) -> impl Iterator<Item = &mut End> {
        self.inputs.values_mut().chain(self.options.values_mut()).flatten().chain(self.outputs.values_mut())
    }
}

impl End {
    /// An end at a node, unpinned.
    pub fn node(node: impl Into<String>) -> Self {
        Self { node: node.into(), port: None }
    }

    /// An end at a port.
    pub fn port(node: impl Into<String>, port: impl Into<String>) -> Self {
        Self { node: node.into(), port: Some(port.into()) }
    }

    /// Reads `node` or `node.port`. The error says what is wrong.
    pub fn parse(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let (node, port) = match text.split_once('.') {
            Some((node, port)) => (node.trim_end(), Some(port.trim_start())),
            None => (text, None),
        };
        check_name(node)?;
        if let Some(port) = port {
            let word = |c: char| c.is_alphanumeric() || c == '_';
            if port.is_empty() || !port.chars().all(word) {
                return Err(format!("`{port}` is not the name of a port"));
            }
        }
        Ok(Self { node: node.into(), port: port.map(Into::into) })
    }
}

impl fmt::Display for End {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.port {
            Some(port) => write!(f, "{}.{port}", self.node),
            None => f.write_str(&self.node),
        }
    }
}

impl Link {
    /// A link between two ends.
    pub fn new(from: End, to: End) -> Self {
        Self { from, to, note: String::new(), unknown: Vec::new(), span: None }
    }

    /// Reads `from -> to`. The error says what is wrong.
    pub fn parse(text: &str) -> Result<Self, String> {
        let (from, to) = text.split_once("->").ok_or_else(|| format!("`{text}` has no `->`"))?;
        Ok(Self::new(End::parse(from)?, End::parse(to)?))
    }

    /// What links are sorted and told apart by.
    pub(crate) fn ends(&self) -> (&End, &End) {
        (&self.from, &self.to)
    }
}

impl fmt::Display for Link {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} -> {}", self.from, self.to)
    }
}

/// Whether a node can have this name: letters, digits, `_`, `-` and inner spaces; not empty, at most 100 bytes. What
/// is left out (`.`, `/`, `->`) separates names in links and in expanded graphs.
pub fn check_name(name: &str) -> Result<(), String> {
    let fine = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | ' ');
    if name.is_empty() {
        return Err("a node must have a name".into());
    }
    if name.len() > 100 {
        return Err("a node's name has at most 100 bytes".into());
    }
    if let Some(c) = name.chars().find(|&c| !fine(c)) {
        return Err(format!("`{name}` cannot name a node because of the `{}`", c.escape_debug()));
    }
    if name.starts_with(' ') || name.ends_with(' ') {
        return Err(format!("`{name}` cannot name a node because of the space at its edge"));
    }
    Ok(())
}

impl Graph {
    /// The graph's file.
    pub fn file_place(&self) -> Place {
        self.source.as_ref().map_or_else(Place::default, |source| Place::file(&source.name))
    }

    fn place_at(&self, node: &str, span: Option<&Span>) -> Place {
        let place = match span {
            Some(span) => Place::span(span.clone()),
            None => self.file_place(),
        };
        place.node(node)
    }

    /// Where a node was written: at its name. Its name and the file for a node that was added since.
    pub fn place(&self, node: &str) -> Place {
        let spans = self.nodes.get(node).map(|n| &n.spans);
        self.place_at(node, spans.and_then(|s| s.name.as_ref().or(s.whole.as_ref())))
    }

    /// Where the graph says what it exports; otherwise its file.
    pub fn output_place(&self) -> Place {
        self.output_span.clone().map_or_else(|| self.file_place(), Place::span)
    }

    /// Where a node says its kind or its subgraph; otherwise where the node is.
    pub fn kind_place(&self, node: &str) -> Place {
        let spans = self.nodes.get(node).map(|n| &n.spans);
        self.place_at(node, spans.and_then(|s| s.kind.as_ref().or(s.name.as_ref()).or(s.whole.as_ref())))
    }

    /// Where the value of a parameter was written; otherwise where the node is.
    pub fn param_place(&self, node: &str, param: &str) -> Place {
        let spans = self.nodes.get(node).map(|n| &n.spans);
        self.place_at(node, spans.and_then(|s| s.params.get(param).or(s.name.as_ref()).or(s.whole.as_ref())))
            .port(param)
    }

    /// Where the value of an option was written; otherwise where the node is.
    pub fn option_place(&self, node: &str, option: &str) -> Place {
        let spans = self.nodes.get(node).map(|n| &n.spans);
        self.place_at(node, spans.and_then(|s| s.options.get(option).or(s.name.as_ref()).or(s.whole.as_ref())))
    }

    /// Where the name of a parameter or option was written; otherwise where the node is.
    pub fn setting_place(&self, node: &str, what: Setting, name: &str) -> Place {
        let span = self.nodes.get(node).and_then(|n| n.spans.names.get(&(what, name.to_owned())));
        let place = span.map_or_else(|| self.place(node), |span| Place::span(span.clone()).node(node));
        if what == Setting::Param { place.port(name) } else { place }
    }

    /// Where a node's own WGSL begins and ends, without its quotes.
    pub fn wgsl_span(&self, node: &str) -> Option<Span> {
        self.nodes.get(node)?.spans.wgsl.clone()
    }

    /// Where a link was written, at the node and port that it leads to.
    pub fn link_place(&self, link: &Link) -> Place {
        let place = self.place_at(&link.to.node, link.span.as_ref());
        match &link.to.port {
            Some(port) => place.port(port),
            None => place,
        }
    }

    /// Where one end of a link was written: its whole text, or only the port that it pins.
    pub fn end_place(&self, link: &Link, from: bool, port_only: bool) -> Place {
        let end = if from { &link.from } else { &link.to };
        let place = self.place_at(&end.node, link.span.as_ref().map(|s| part(s, from, port_only)).as_ref());
        end.port.iter().fold(place, |place, port| place.port(port))
    }

    /// Sorts the links by their ends.
    pub(crate) fn sort_links(&mut self) {
        self.links.sort_by(|a, b| a.ends().cmp(&b.ends()));
    }
}

/// The part of a link's text that says one of its ends, or the port of that end.
fn part(link: &Span, from: bool, port_only: bool) -> Span {
    let text = link.source.text.get(link.range.clone()).unwrap_or_default();
    let inner = text.trim_start_matches(['r', '#']).trim_start_matches('"');
    let start = text.len() - inner.len();
    let inner = inner.trim_end_matches('#').trim_end_matches('"');
    // An escape in a link is nobody's habit; then the whole link is shown.
    let Some(arrow) = inner.find("->").filter(|_| !inner.contains('\\')) else { return link.clone() };
    let mut range = if from { 0..arrow } else { arrow + 2..inner.len() };
    if port_only {
        range.start += inner[range.clone()].find('.').map_or(0, |dot| dot + 1);
    }
    let part = &inner[range.clone()];
    let lead = part.len() - part.trim_start().len();
    let at = link.range.start + start + range.start + lead;
    Span::new(&link.source, at..at + part.trim().len())
}
