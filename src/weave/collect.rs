//! The nodes and links of all graphs in one list, each node with its definition and its values checked.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::hash::HashMap;
use petgraph::algo::toposort;
use petgraph::graph::{DiGraph, NodeIndex};

use super::{Found, Link, LinkPlace};
use crate::compile::{MAX_REPORTED, NamedGraph};
use crate::diagnostic::{Diagnostic, Place, SourceText, Span, did_you_mean};
use crate::graph::{self, Setting};
use crate::node::{self, Catalog, Definition, Port};
use crate::semantic::{Shape, Value};

/// All nodes and links.
pub(crate) struct Collected<'a> {
    pub(crate) graphs: &'a [NamedGraph],
    pub(crate) nodes: Vec<Found<'a>>,
    pub(crate) links: Vec<Link<'a>>,
    /// Links into each node, by index into `links`; valid after [`Collected::reorder`].
    pub(crate) incoming: Vec<Vec<usize>>,
}

impl<'a> Collected<'a> {
    /// Where a node was written.
    pub(crate) fn place(&self, node: usize) -> Place {
        let found = &self.nodes[node];
        self.graphs[found.graph].graph.place(found.name)
    }

    /// Where a link was written.
    pub(crate) fn link_place(&self, link: &Link<'_>) -> Place {
        match &link.place {
            LinkPlace::Written { graph, link } => self.graphs[*graph].graph.link_place(link),
            LinkPlace::Joined { from, to } => {
                let source = self.graphs[self.nodes[*from].graph].graph.source.as_ref();
                let place = Place { file: source.map(|s| s.name.clone()), ..Place::default() };
                place.node(&*self.nodes[*to].id)
            }
        }
    }

    /// Puts the nodes into this order.
    pub(crate) fn reorder(&mut self, order: &[usize]) {
        let mut place = vec![0; order.len()];
        for (new, &old) in order.iter().enumerate() {
            place[old] = new;
        }
        let mut nodes: Vec<Option<Found<'a>>> = self.nodes.drain(..).map(Some).collect();
        self.nodes = order.iter().filter_map(|&old| nodes[old].take()).collect();
        for link in &mut self.links {
            (link.from, link.to) = (place[link.from], place[link.to]);
            if let LinkPlace::Joined { from, to } = &mut link.place {
                (*from, *to) = (link.from, link.to);
            }
        }
        self.links
            .sort_by(|a, b| (a.to, &a.to_port, a.from, &a.from_port).cmp(&(b.to, &b.to_port, b.from, &b.from_port)));
        self.incoming = vec![Vec::new(); self.nodes.len()];
        for (i, link) in self.links.iter().enumerate() {
            self.incoming[link.to].push(i);
        }
    }
}

/// Name of a node among all graphs.
pub(crate) fn identifier(graphs: &[NamedGraph], graph: usize, node: &str) -> Arc<str> {
    if graphs.len() > 1 { format!("{}/{node}", graphs[graph].name).into() } else { node.into() }
}

pub(crate) fn collect<'a>(graphs: &'a [NamedGraph], catalog: &Catalog, out: &mut Vec<Diagnostic>) -> Collected<'a> {
    let mut collected = Collected { graphs, nodes: Vec::new(), links: Vec::new(), incoming: Vec::new() };
    for (index, named) in graphs.iter().enumerate() {
        check_overrides(named, out);
        let mut position = HashMap::default();
        for (name, node) in &named.graph.nodes {
            if node.muted {
                continue;
            }
            position.insert(name.as_str(), collected.nodes.len());
            let definition = definition(&named.graph, name, node, catalog, out);
            let mut refused = BTreeSet::new();
            let values = match &definition {
                Some(d) => values(named, name, node, d, &mut refused, out),
                None => BTreeMap::new(),
            };
            let file = |port: &String| Some((port.clone(), node.spans.params.get(port)?.source.name.clone()));
            let source = node.spans.whole.as_ref().map(|s| &s.source).or(named.graph.source.as_ref());
            collected.nodes.push(Found {
                id: identifier(graphs, index, name),
                graph: index,
                definition,
                bases: values.keys().filter_map(file).collect(),
                values,
                refused,
                base: source.cloned(),
                name,
            });
        }
        for (link, from, to) in bypass(&named.graph) {
            // A link to a node that is not there was reported when the graph was read.
            let (Some(&f), Some(&t)) = (position.get(from.node.as_str()), position.get(to.node.as_str())) else {
                continue;
            };
            let place = LinkPlace::Written { graph: index, link };
            let woven = Link { from: f, from_port: from.port.clone(), to: t, to_port: to.port.clone(), place };
            if check_ports(&collected.nodes, &woven, &named.graph, link, out) {
                collected.links.push(woven);
            } else {
                collected.nodes[f].refused.insert("*".to_owned());
                collected.nodes[t].refused.insert("*".to_owned());
            }
        }
    }
    collected
}

/// Links with muted nodes passed over: what fed a muted node feeds whatever it fed.
fn bypass(graph: &graph::Graph) -> Vec<(&graph::Link, &graph::End, &graph::End)> {
    if graph.nodes.values().all(|n| !n.muted) {
        return graph.links.iter().map(|link| (link, &link.from, &link.to)).collect();
    }
    let muted = |name: &str| graph.nodes.get(name).is_some_and(|n| n.muted);
    // One source is enough to heal a wire; of several the first feeds on, as their order is by name.
    let mut source: HashMap<&str, Option<&graph::End>> = HashMap::default();
    for link in graph.links.iter().filter(|l| muted(&l.to.node)) {
        source.entry(&link.to.node).or_insert(Some(&link.from));
    }
    let mut links = Vec::with_capacity(graph.links.len());
    for link in graph.links.iter().filter(|l| !muted(&l.to.node)) {
        let mut from = Some(&link.from);
        let mut passed = Vec::new();
        while let Some(end) = from.filter(|end| muted(&end.node)) {
            passed.push(end.node.as_str());
            // Taken out while it is followed, so that a cycle ends.
            from = source.insert(&end.node, None).flatten();
        }
        for name in passed {
            source.insert(name, from);
        }
        links.extend(from.map(|from| (link, from, &link.to)));
    }
    links
}

fn definition(
    graph: &graph::Graph,
    name: &str,
    node: &graph::Node,
    catalog: &Catalog,
    out: &mut Vec<Diagnostic>,
) -> Option<Arc<Definition>> {
    let chosen = if let Some(text) = &node.wgsl {
        let nowhere = SourceText::new(String::new(), String::new());
        let source = node.spans.whole.as_ref().map(|s| &s.source).or(graph.source.as_ref()).unwrap_or(&nowhere);
        let found = node::custom(name, text, source, &node.options, catalog);
        found.map_err(|found| found.into_iter().map(|d| own_place(graph, name, d)).collect())
    } else if node.kind == "custom" {
        let message = "a `custom` node needs its WGSL";
        let help = "add `wgsl: \"fn name(x: f32) -> f32 { return x; }\"` to the node";
        out.push(Diagnostic::error("ST0200", message, graph.kind_place(name)).help(help));
        return None;
    } else if let Some(file) = catalog.get(&node.kind) {
        if !node.options.is_empty()
            && let Ok(header) = file.header()
            && !check_options(graph, name, node, file, &header, out)
        {
            return file.definition(&BTreeMap::new()).ok();
        }
        file.definition(&node.options)
    } else {
        let message = format!("there is no node called `{}`", node.kind);
        let error = Diagnostic::error("ST0200", message, graph.kind_place(name));
        // Looking through all names takes long, and nobody reads a hundred suggestions.
        let nearest = if out.len() < MAX_REPORTED { catalog.nearest(&node.kind) } else { None };
        out.push(match nearest {
            Some(near) => error.help(format!("did you mean `{near}`?")),
            None => error.help("`shadetree nodes` lists all nodes; `--nodes DIR` adds a folder of your own"),
        });
        return None;
    };
    chosen.map_err(|mut found| out.append(&mut found)).ok()
}

/// A mistake in a node's own WGSL, with its place in the graph file. Lines and columns of the WGSL itself stay where the
/// text has escapes, as it then stands nowhere in the file as it is.
fn own_place(graph: &graph::Graph, name: &str, mut found: Diagnostic) -> Diagnostic {
    if found.code == "ST0133" {
        let option = found.place.port.take().unwrap_or_default();
        found.place = graph.setting_place(name, Setting::Option, &option);
        return found;
    }
    let (Some(outer), Some(inner)) = (graph.wgsl_span(name), &mut found.place.span) else {
        if found.place.span.is_none() {
            found.place = graph.place(name);
        }
        return found;
    };
    if outer.source.text.get(outer.range.clone()) == Some(inner.source.text.as_str()) {
        let start = outer.range.start;
        *inner = Span::new(&outer.source, start + inner.range.start..start + inner.range.end);
        return found;
    }
    let (line, column) = outer.line_column();
    found.note(format!("this text is written at {}:{line}:{column}, with escapes", outer.source.name))
}

fn check_options(
    graph: &graph::Graph,
    name: &str,
    node: &graph::Node,
    file: &node::NodeFile,
    header: &node::Header,
    out: &mut Vec<Diagnostic>,
) -> bool {
    let before = out.len();
    for (option, choice) in &node.options {
        let place = graph.option_place(name, option);
        let Some(spec) = header.options.iter().find(|o| &o.name == option) else {
            let place = graph.setting_place(name, Setting::Option, option);
            let error = Diagnostic::error("ST0201", format!("`{}` has no option `{option}`", node.kind), place);
            let names: Vec<&str> = header.options.iter().map(|o| o.name.as_str()).collect();
            let is_input = file.definition(&BTreeMap::new()).is_ok_and(|d| d.input(option).is_some());
            out.push(if is_input {
                error.help(format!("`{option}` is an input: write it under `params`"))
            } else {
                suggest(error, option, &names, "its options are")
            });
            continue;
        };
        if !spec.choices.contains(choice) {
            let message = format!("option `{option}` of `{}` cannot be `{choice}`", node.kind);
            let names: Vec<&str> = spec.choices.iter().map(String::as_str).collect();
            let help = format!("it can be {}", quoted(&names));
            out.push(Diagnostic::error("ST0202", message, place).help(help));
        }
    }
    out.len() == before
}

/// Help with the nearest name, or else with all names.
pub(crate) fn suggest(error: Diagnostic, wanted: &str, names: &[&str], verb: &str) -> Diagnostic {
    match did_you_mean(wanted, names.iter().copied()) {
        Some(near) => error.help(format!("did you mean `{near}`?")),
        None if names.is_empty() => error.help("there are none"),
        None => error.help(format!("{verb} {}", quoted(names))),
    }
}

fn quoted(names: &[&str]) -> String {
    names.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", ")
}

fn values(
    named: &NamedGraph,
    name: &str,
    node: &graph::Node,
    definition: &Definition,
    refused: &mut BTreeSet<String>,
    out: &mut Vec<Diagnostic>,
) -> BTreeMap<String, Value> {
    let mut values = BTreeMap::new();
    if node.params.is_empty() && named.set.is_empty() {
        return values;
    }
    let prefix = format!("{name}.");
    let overrides = named.set.iter().filter_map(|(path, v)| Some((path.strip_prefix(&prefix)?, v)));
    let overrides = overrides.map(|(port, v)| (port, v, named.graph.param_place(name, port)));
    let given = node.params.iter().map(|(port, v)| (port.as_str(), v, named.graph.param_place(name, port)));
    for (port, value, place) in given.chain(overrides) {
        let Some(input) = definition.input(port).filter(|p| !p.hidden) else {
            let place = named.graph.setting_place(name, Setting::Param, port);
            let error = Diagnostic::error("ST0203", format!("`{}` has no input `{port}`", definition.kind), place);
            let settable = definition.inputs().filter(|p| !p.hidden && !super::is_light_port(definition, p));
            let names: Vec<&str> = settable.map(|p| p.name.as_str()).collect();
            out.push(if definition.header.options.iter().any(|o| o.name == port) {
                error.help(format!("`{port}` is an option: write it under `options`"))
            } else {
                suggest(error, port, &names, "its inputs are")
            });
            continue;
        };
        match check_value(input, value) {
            None => drop(values.insert(port.to_owned(), value.clone())),
            Some((code, message, help)) => {
                refused.insert(port.to_owned());
                out.push(Diagnostic::error(code, message, place.port(port)).help(help));
            }
        }
    }
    values
}

/// What is wrong with a value for an input: code, message, help.
fn check_value(input: &Port, value: &Value) -> Option<(&'static str, String, String)> {
    let port = &input.name;
    if !value.fits(&input.ty.shape) {
        let message = format!("`{port}` cannot take {value}: it is {}", input.ty);
        let help = match input.ty.shape {
            Shape::Bool => "write true or false".to_owned(),
            Shape::Texture => "write the path of an image file, in quotes".to_owned(),
            Shape::F32(1) => "write one number".to_owned(),
            Shape::F32(n) => format!("write one number for all components, or {n} numbers in brackets"),
            Shape::I32 | Shape::U32 => "write a whole number".to_owned(),
            _ => "link a node that gives one".to_owned(),
        };
        return Some(("ST0204", message, help));
    }
    let numbers = value.numbers().unwrap_or_default();
    if let Some(bad) = numbers.iter().find(|x| !x.is_finite() || x.abs() > f64::from(f32::MAX)) {
        let help = format!("write a number between {:e} and {:e}", f32::MIN, f32::MAX);
        return Some(("ST0205", format!("`{port}` cannot be {bad:e}: the shader has no such number"), help));
    }
    let (low, high) = input.range;
    let outside = numbers.iter().find(|&&x| low.is_some_and(|l| x < l) || high.is_some_and(|h| x > h))?;
    let unit = if input.unit.is_empty() { String::new() } else { format!(" {}", input.unit) };
    let message = format!("`{port}` = {outside}{unit} is out of range");
    let help = match (low, high) {
        (Some(low), Some(high)) => format!("it must lie between {low} and {high}{unit}"),
        (Some(low), None) => format!("it must be at least {low}{unit}"),
        (_, high) => format!("it must be at most {}{unit}", high.unwrap_or_default()),
    };
    Some(("ST0206", message, help))
}

fn check_overrides(named: &NamedGraph, out: &mut Vec<Diagnostic>) {
    for path in named.set.keys() {
        let Some((node, _)) = path.rsplit_once('.') else {
            let message = format!("`{path}` cannot be set: it names no port");
            let error = Diagnostic::error("ST0207", message, named.graph.file_place());
            out.push(error.help("write the name of a node, a dot, and the name of its port"));
            continue;
        };
        if !named.graph.nodes.contains_key(node) {
            let message = format!("`{path}` cannot be set: graph `{}` has no node `{node}`", named.name);
            let names: Vec<&str> = named.graph.nodes.keys().map(String::as_str).collect();
            let error = Diagnostic::error("ST0207", message, named.graph.file_place());
            out.push(suggest(error, node, &names, "its nodes are"));
        }
    }
}

/// Whether the ports that a link names exist.
fn check_ports(
    nodes: &[Found<'_>],
    link: &Link<'_>,
    graph: &graph::Graph,
    written: &graph::Link,
    out: &mut Vec<Diagnostic>,
) -> bool {
    let before = out.len();
    if let (Some(port), Some(d)) = (&link.from_port, &nodes[link.from].definition)
        && d.output(port).is_none()
    {
        let message = format!("`{}` ({}) has no output `{port}`", nodes[link.from].id, d.kind);
        let names: Vec<&str> = d.main.outputs.iter().map(|p| p.name.as_str()).collect();
        let place = graph.end_place(written, true, true);
        out.push(suggest(Diagnostic::error("ST0208", message, place), port, &names, "its outputs are"));
    }
    if let (Some(port), Some(d)) = (&link.to_port, &nodes[link.to].definition)
        && d.input(port).is_none_or(|p| p.hidden)
    {
        let message = format!("`{}` ({}) has no input `{port}`", nodes[link.to].id, d.kind);
        let names: Vec<&str> = d.inputs().filter(|p| !p.hidden).map(|p| p.name.as_str()).collect();
        let place = graph.end_place(written, false, true);
        out.push(suggest(Diagnostic::error("ST0208", message, place), port, &names, "its inputs are"));
    }
    out.len() == before
}

/// An order in which every node comes after what feeds it; the same for every order of the file.
pub(crate) fn order(collected: &Collected<'_>, out: &mut Vec<Diagnostic>) -> Option<Vec<usize>> {
    let mut graph = DiGraph::<(), ()>::with_capacity(collected.nodes.len(), collected.links.len());
    for _ in &collected.nodes {
        graph.add_node(());
    }
    let mut ends: Vec<(usize, usize)> = collected.links.iter().map(|l| (l.from, l.to)).collect();
    ends.sort_unstable();
    ends.dedup();
    graph.extend_with_edges(ends.into_iter().map(|(a, b)| (NodeIndex::new(a), NodeIndex::new(b))));
    match toposort(&graph, None) {
        Ok(order) => Some(order.into_iter().map(NodeIndex::index).collect()),
        Err(cycle) => {
            let node = &collected.nodes[cycle.node_id().index()];
            let message = format!("`{}` feeds itself", node.id);
            let help = "remove one link of the cycle; what must come from the last frame cannot be said by links";
            out.push(Diagnostic::error("ST0209", message, collected.place(cycle.node_id().index())).help(help));
            None
        }
    }
}
