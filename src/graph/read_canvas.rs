//! Reading where things lie on the canvas and how they are drawn.

use std::collections::{BTreeMap, BTreeSet};

use super::edit_canvas::check_frame;
use super::read::Report;
use super::{End, Frame, Graph, Link, MAX_NODES, MAX_WAYPOINTS};
use crate::diagnostic::{Diagnostic, did_you_mean};
use crate::ron::{Field, Node, expect_fields, field};

/// The fields that are read here.
pub(super) const FIELDS: [&str; 4] = ["layout", "frames", "collapsed", "waypoints"];

pub(super) fn canvas(fields: &[Field], graph: &mut Graph, report: &mut Report) {
    let source = report.source.clone();
    if let Some(map) = field(fields, "layout").and_then(|n| report.take(n.as_map(&source))) {
        graph.layout = layout(map, graph, report);
    }
    if let Some(map) = field(fields, "frames").and_then(|n| report.take(n.as_map(&source))) {
        graph.frames = frames(map, report);
    }
    if let Some(list) = field(fields, "collapsed").and_then(|n| report.take(n.as_list(&source))) {
        graph.collapsed = collapsed(list, graph, report);
    }
    if let Some(map) = field(fields, "waypoints").and_then(|n| report.take(n.as_map(&source))) {
        graph.waypoints = waypoints(map, graph, report);
    }
}

/// Whether a node is there; otherwise that something was said of it.
fn is_there(what: &str, name: &str, at: &Node, graph: &Graph, report: &mut Report) -> bool {
    if graph.nodes.contains_key(name) {
        return true;
    }
    let message = format!("{what} for `{name}`, and no such node");
    // Once nothing more is listed, looking for the nearest of many names is wasted.
    let near = if report.is_full() { None } else { did_you_mean(name, graph.nodes.keys().map(String::as_str)) };
    let help = near.map_or_else(|| "remove it".to_owned(), |near| format!("did you mean `{near}`?"));
    report.push(Diagnostic::warning("ST0056", message, at.place(&report.source)).help(help));
    false
}

fn layout(map: &[(Node, Node)], graph: &Graph, report: &mut Report) -> BTreeMap<String, [f64; 2]> {
    let source = report.source.clone();
    let mut layout = BTreeMap::new();
    for (key, value) in map {
        let Some(name) = report.take(key.as_str(&source)) else { continue };
        let Some(position) = report.take(value.as_array::<2>(&source)) else { continue };
        if is_there("there is a position", name, key, graph, report) {
            layout.insert(name.to_string(), position);
        }
    }
    layout
}

fn frames(map: &[(Node, Node)], report: &mut Report) -> BTreeMap<String, Frame> {
    let source = report.source.clone();
    if map.len() > MAX_NODES {
        let message = format!("the graph has {} frames; at most {MAX_NODES} are handled", map.len());
        let place = map.first().map_or_else(Default::default, |(key, _)| key.place(&source));
        report.push(Diagnostic::error("ST0060", message, place).help("remove some"));
        return BTreeMap::new();
    }
    let mut frames = BTreeMap::new();
    for (key, value) in map {
        let Some(name) = report.take(key.as_str(&source)) else { continue };
        let Some(frame) = frame(value, report) else { continue };
        match check_frame(name, &frame) {
            Ok(()) => drop(frames.insert(name.to_string(), frame)),
            Err(message) => {
                let help = "write `\"title\": (at: (x, y), size: (width, height))`, with sizes above 0";
                report.push(Diagnostic::error("ST0069", message, key.place(&source)).help(help));
            }
        }
    }
    frames
}

fn frame(value: &Node, report: &mut Report) -> Option<Frame> {
    let source = report.source.clone();
    let form = "a frame `(at: (x, y), size: (width, height))`";
    let fields = report.take(expect_fields(value, &source, form))?;
    let mut pair = |name: &str| match field(fields, name) {
        Some(node) => report.take(node.as_array::<2>(&source)),
        None => {
            let message = format!("the frame has no field `{name}`");
            report.push(Diagnostic::error("ST0011", message, value.place(&source)).help(format!("write {form}")));
            None
        }
    };
    let (at, size) = (pair("at"), pair("size"));
    let color = field(fields, "color").and_then(|n| report.take(n.as_array::<3>(&source)));
    let text = field(fields, "text").and_then(|n| report.take(n.as_str(&source))).unwrap_or_default().to_string();
    let unknown = report.unknown(fields, &["at", "size", "color", "text"]);
    Some(Frame { at: at?, size: size?, color, text, unknown })
}

fn collapsed(list: &[Node], graph: &Graph, report: &mut Report) -> BTreeSet<String> {
    let source = report.source.clone();
    let mut collapsed = BTreeSet::new();
    for node in list {
        let Some(name) = report.take(node.as_str(&source)) else { continue };
        if is_there("there is an entry in `collapsed`", name, node, graph, report) {
            collapsed.insert(name.to_string());
        }
    }
    collapsed
}

fn waypoints(map: &[(Node, Node)], graph: &Graph, report: &mut Report) -> BTreeMap<(End, End), Vec<[f64; 2]>> {
    let source = report.source.clone();
    // The links are not sorted yet.
    let links: BTreeSet<(&End, &End)> =
        if map.is_empty() { BTreeSet::new() } else { graph.links.iter().map(Link::ends).collect() };
    let mut waypoints = BTreeMap::new();
    for (key, value) in map {
        let Some(text) = report.take(key.as_str(&source)) else { continue };
        let link = match Link::parse(text) {
            Ok(link) => link,
            Err(message) => {
                let help = "write `from -> to`, as the link does";
                report.push(Diagnostic::error("ST0055", message, key.place(&source)).help(help));
                continue;
            }
        };
        let Some(points) = report.take(value.as_list(&source)) else { continue };
        if points.len() > MAX_WAYPOINTS {
            let message = format!("the link `{link}` has {} bends; at most {MAX_WAYPOINTS} are drawn", points.len());
            report.push(Diagnostic::error("ST0069", message, value.place(&source)).help("remove some"));
            continue;
        }
        let points: Vec<[f64; 2]> = points.iter().filter_map(|p| report.take(p.as_array::<2>(&source))).collect();
        if !links.contains(&link.ends()) {
            let message = format!("there are bends for `{link}`, and no such link");
            report.push(Diagnostic::warning("ST0056", message, key.place(&source)).help("remove them"));
        } else if !points.is_empty() && waypoints.insert((link.from.clone(), link.to.clone()), points).is_some() {
            let message = format!("the bends of `{link}` are given twice");
            report.push(Diagnostic::warning("ST0058", message, key.place(&source)).help("remove one of them"));
        }
    }
    waypoints
}
