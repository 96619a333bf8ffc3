//! The nodes and links of all graphs in one list, each node with its definition and its values checked.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use petgraph::algo::toposort;
use petgraph::graph::{DiGraph, NodeIndex};

use super::{Found, Link};
use crate::compile::{MAX_REPORTED, NamedGraph};
use crate::diagnostic::{Diagnostic, Place, SourceText, did_you_mean};
use crate::graph;
use crate::node::{self, Catalog, Definition, Port};
use crate::semantic::{Shape, Value};

/// All nodes and links.
pub(crate) struct Collected {
    pub(crate) nodes: Vec<Found>,
    pub(crate) links: Vec<Link>,
    /// Links into each node, by index into `links`; valid after [`Collected::reorder`].
    pub(crate) incoming: Vec<Vec<usize>>,
}

impl Collected {
    /// Puts the nodes into this order.
    pub(crate) fn reorder(&mut self, order: &[usize]) {
        let mut place = vec![0; order.len()];
        for (new, &old) in order.iter().enumerate() {
            place[old] = new;
        }
        let mut nodes: Vec<(usize, Found)> = self.nodes.drain(..).enumerate().map(|(old, n)| (place[old], n)).collect();
        nodes.sort_by_key(|(new, _)| *new);
        self.nodes = nodes.into_iter().map(|(_, n)| n).collect();
        for link in &mut self.links {
            (link.from, link.to) = (place[link.from], place[link.to]);
        }
        self.links.sort_by(|a, b| {
            let key = |l: &Link| (l.to, l.to_port.clone(), l.from, l.from_port.clone());
            key(a).cmp(&key(b))
        });
        self.incoming = vec![Vec::new(); self.nodes.len()];
        for (i, link) in self.links.iter().enumerate() {
            self.incoming[link.to].push(i);
        }
    }
}

/// Name of a node among all graphs.
pub(crate) fn identifier(graphs: &[NamedGraph], graph: usize, node: &str) -> String {
    if graphs.len() > 1 { format!("{}/{node}", graphs[graph].name) } else { node.to_owned() }
}

pub(crate) fn collect(graphs: &[NamedGraph], catalog: &Catalog, out: &mut Vec<Diagnostic>) -> Collected {
    let mut collected = Collected { nodes: Vec::new(), links: Vec::new(), incoming: Vec::new() };
    for (index, named) in graphs.iter().enumerate() {
        check_overrides(named, out);
        let mut position = HashMap::new();
        for (name, node) in &named.graph.nodes {
            if node.muted {
                continue;
            }
            position.insert(name.as_str(), collected.nodes.len());
            let definition = definition(&named.graph, name, node, catalog, out);
            let values = match &definition {
                Some(d) => values(named, name, node, d, out),
                None => BTreeMap::new(),
            };
            let source = node.spans.whole.as_ref().map(|s| &s.source).or(named.graph.source.as_ref());
            collected.nodes.push(Found {
                id: identifier(graphs, index, name),
                graph: index,
                definition,
                values,
                base: source.map(|s| s.name.clone()).unwrap_or_default(),
                place: named.graph.place(name),
            });
        }
        for (from, to, place) in bypass(&named.graph) {
            // A link to a node that is not there was reported when the graph was read.
            let (Some(&f), Some(&t)) = (position.get(from.node.as_str()), position.get(to.node.as_str())) else {
                continue;
            };
            let link = Link { from: f, from_port: from.port, to: t, to_port: to.port, place };
            if check_ports(&collected.nodes, &link, out) {
                collected.links.push(link);
            }
        }
    }
    collected
}

/// Links with muted nodes passed over: what fed a muted node feeds whatever it fed.
fn bypass(graph: &graph::Graph) -> Vec<(graph::End, graph::End, Place)> {
    let all = graph.links.iter().map(|l| (l.from.clone(), l.to.clone(), graph.link_place(l)));
    let mut links: Vec<_> = all.collect();
    let muted = graph.nodes.iter().filter(|(_, n)| n.muted).map(|(name, _)| name);
    for name in muted {
        let (touching, mut rest): (Vec<_>, Vec<_>) =
            links.into_iter().partition(|(from, to, _)| &from.node == name || &to.node == name);
        let (into, out): (Vec<_>, Vec<_>) = touching.into_iter().partition(|(_, to, _)| &to.node == name);
        // One source is enough to heal a wire; of several the first feeds on, as their order is by name.
        if let Some((source, _, _)) = into.first() {
            rest.extend(out.into_iter().map(|(_, to, place)| (source.clone(), to, place)));
        }
        links = rest;
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
        node::custom(name, text, source, &node.options, catalog)
    } else if node.kind == "custom" {
        let message = "a `custom` node needs its WGSL";
        let help = "add `wgsl: \"fn name(x: f32) -> f32 { return x; }\"` to the node";
        out.push(Diagnostic::error("ST0200", message, graph.kind_place(name)).help(help));
        return None;
    } else if let Some(file) = catalog.get(&node.kind) {
        if let Ok(header) = file.header()
            && !check_options(graph, name, node, &header, out)
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

fn check_options(
    graph: &graph::Graph,
    name: &str,
    node: &graph::Node,
    header: &node::Header,
    out: &mut Vec<Diagnostic>,
) -> bool {
    let before = out.len();
    for (option, choice) in &node.options {
        let place = graph.option_place(name, option);
        let Some(spec) = header.options.iter().find(|o| &o.name == option) else {
            let error = Diagnostic::error("ST0201", format!("`{}` has no option `{option}`", node.kind), place);
            let names: Vec<&str> = header.options.iter().map(|o| o.name.as_str()).collect();
            out.push(suggest(error, option, &names, "it has"));
            continue;
        };
        if !spec.choices.contains(choice) {
            let message = format!("option `{option}` of `{}` cannot be `{choice}`", node.kind);
            let names: Vec<&str> = spec.choices.iter().map(String::as_str).collect();
            out.push(suggest(Diagnostic::error("ST0202", message, place), choice, &names, "it can be"));
        }
    }
    out.len() == before
}

/// Help with the nearest name, or else with all names.
pub(crate) fn suggest(error: Diagnostic, wanted: &str, names: &[&str], verb: &str) -> Diagnostic {
    match did_you_mean(wanted, names.iter().copied()) {
        Some(near) => error.help(format!("did you mean `{near}`?")),
        None if names.is_empty() => error.help(format!("{verb} none")),
        None => error.help(format!("{verb} {}", names.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", "))),
    }
}

fn values(
    named: &NamedGraph,
    name: &str,
    node: &graph::Node,
    definition: &Definition,
    out: &mut Vec<Diagnostic>,
) -> BTreeMap<String, Value> {
    let mut values = BTreeMap::new();
    let prefix = format!("{name}.");
    let overrides =
        named.set.iter().filter_map(|(path, v)| Some((path.strip_prefix(&prefix)?, v, named.graph.place(name))));
    let given = node.params.iter().map(|(port, v)| (port.as_str(), v, named.graph.param_place(name, port)));
    for (port, value, place) in given.chain(overrides) {
        let Some(input) = definition.input(port).filter(|p| !p.hidden) else {
            let error = Diagnostic::error("ST0203", format!("`{}` has no input `{port}`", definition.kind), place);
            let names: Vec<&str> = definition.inputs().filter(|p| !p.hidden).map(|p| p.name.as_str()).collect();
            out.push(suggest(error, port, &names, "it has"));
            continue;
        };
        match check_value(input, value) {
            None => drop(values.insert(port.to_owned(), value.clone())),
            Some((code, message, help)) => out.push(Diagnostic::error(code, message, place.port(port)).help(help)),
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
        return Some(("ST0205", format!("`{port}` cannot be {bad}"), "write a finite number".into()));
    }
    let (low, high) = input.range;
    let outside = numbers.iter().find(|&&x| low.is_some_and(|l| x < l) || high.is_some_and(|h| x > h))?;
    let text = |limit: Option<f64>| limit.map(|x| x.to_string()).unwrap_or_default();
    let unit = if input.unit.is_empty() { String::new() } else { format!(" {}", input.unit) };
    let message = format!("`{port}` = {outside}{unit} is out of range");
    Some(("ST0206", message, format!("it must lie in {}..{}{unit}", text(low), text(high))))
}

fn check_overrides(named: &NamedGraph, out: &mut Vec<Diagnostic>) {
    for path in named.set.keys() {
        let node = path.rsplit_once('.').map_or(path.as_str(), |(node, _)| node);
        if !named.graph.nodes.contains_key(node) {
            let message = format!("`{path}` cannot be set: graph `{}` has no node `{node}`", named.name);
            let names: Vec<&str> = named.graph.nodes.keys().map(String::as_str).collect();
            out.push(suggest(Diagnostic::error("ST0207", message, named.graph.file_place()), node, &names, "it has"));
        }
    }
}

/// Whether the ports that a link names exist.
fn check_ports(nodes: &[Found], link: &Link, out: &mut Vec<Diagnostic>) -> bool {
    let before = out.len();
    if let (Some(port), Some(d)) = (&link.from_port, &nodes[link.from].definition)
        && d.output(port).is_none()
    {
        let message = format!("`{}` ({}) has no output `{port}`", nodes[link.from].id, d.kind);
        let names: Vec<&str> = d.main.outputs.iter().map(|p| p.name.as_str()).collect();
        out.push(suggest(Diagnostic::error("ST0208", message, link.place.clone()), port, &names, "it has"));
    }
    if let (Some(port), Some(d)) = (&link.to_port, &nodes[link.to].definition)
        && d.input(port).is_none_or(|p| p.hidden)
    {
        let message = format!("`{}` ({}) has no input `{port}`", nodes[link.to].id, d.kind);
        let names: Vec<&str> = d.inputs().filter(|p| !p.hidden).map(|p| p.name.as_str()).collect();
        out.push(suggest(Diagnostic::error("ST0208", message, link.place.clone()), port, &names, "it has"));
    }
    out.len() == before
}

/// An order in which every node comes after what feeds it; the same for every order of the file.
pub(crate) fn order(collected: &Collected, out: &mut Vec<Diagnostic>) -> Option<Vec<usize>> {
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
            out.push(Diagnostic::error("ST0209", message, node.place.clone()).help(help));
            None
        }
    }
}
