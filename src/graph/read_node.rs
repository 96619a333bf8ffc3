//! Reading the nodes of a graph.

use super::comments::{Item, Target};
use super::read::Report;
use super::{Graph, MAX_NODES, Node, Setting, Spans, check_name};
use crate::diagnostic::{Diagnostic, Span};
use crate::ron::{self, Tree, expect_fields, field};
use crate::semantic::Value;

const KNOWN: [&str; 7] = ["kind", "graph", "wgsl", "params", "options", "muted", "note"];

pub(super) fn nodes<'a>(
    map: &'a [(ron::Node, ron::Node)],
    graph: &mut Graph,
    items: &mut Vec<Item<'a>>,
    report: &mut Report,
) {
    if map.len() > MAX_NODES {
        let message = format!("the graph has {} nodes; at most {MAX_NODES} are handled", map.len());
        let help = "an image or a node of your own does more with fewer nodes";
        report.push(Diagnostic::error("ST0060", message, report.at(map[MAX_NODES].0.span.clone())).help(help));
        return;
    }
    let source = report.source.clone();
    for (key, value) in map {
        let Some(name) = report.take(key.as_str(&source)) else {
            continue;
        };
        if let Err(message) = check_name(name) {
            let help = "use letters, digits, `_`, `-` and inner spaces";
            let place = key.place(&source);
            let place = if name.is_empty() { place } else { place.node(name) };
            report.push(Diagnostic::error("ST0053", message, place).help(help));
        }
        let span = key.span.start..value.span.end;
        let mut node = node(name, value, report);
        node.spans.name = Some(Span::new(&source, key.span.clone()));
        node.spans.whole = Some(Span::new(&source, span.clone()));
        items.push(Item { span, target: Target::Node(name) });
        graph.nodes.insert(name.to_string(), node);
    }
}

fn node(name: &str, value: &ron::Node, report: &mut Report) -> Node {
    let source = report.source.clone();
    let Some(fields) = report.take(expect_fields(value, &source, "a node `(kind: \"...\")`")) else {
        return Node::default();
    };
    let mut node = Node { unknown: report.unknown(fields, &KNOWN), ..Node::default() };
    let mut text = |field_name: &str| {
        let given = field(fields, field_name)?;
        let text = report.take(given.as_str(&source))?;
        Some((text.to_string(), given))
    };
    let span = |given: &ron::Node| Some(Span::new(&source, given.span.clone()));
    if let Some((kind, given)) = text("kind") {
        node.kind = kind;
        node.spans.kind = span(given);
    }
    if let Some((path, given)) = text("graph") {
        node.graph = Some(path);
        node.spans.kind = span(given);
    }
    if let Some((wgsl, given)) = text("wgsl") {
        let start = given.content_start(&source);
        let raw = source.text[given.span.clone()].starts_with('r');
        let closing = source.text[given.span.clone()].bytes().rev().take_while(|&b| b == b'#').count() + 1;
        let end = if raw { start + wgsl.len() } else { given.span.end.saturating_sub(closing) };
        node.spans.wgsl = Some(Span::new(&source, start..end.max(start)));
        node.wgsl = Some(wgsl);
    }
    if let Some((note, _)) = text("note") {
        node.note = note;
    }
    if let Some(muted) = field(fields, "muted") {
        node.muted = report.take(muted.as_bool(&source)).unwrap_or_default();
    }
    if node.kind.is_empty() == node.graph.is_none() {
        let message = match node.graph {
            Some(_) => format!("the node `{name}` says both a `kind` and a `graph`"),
            None => format!("the node `{name}` does not say what it is"),
        };
        let help = "give it one of `kind: \"...\"` and `graph: \"file.ron\"`";
        report.push(Diagnostic::error("ST0054", message, value.place(&source).node(name)).help(help));
    }
    settings(name, fields, &mut node, report);
    node
}

/// Parameters and options.
fn settings(name: &str, fields: &[ron::Field], node: &mut Node, report: &mut Report) {
    let source = report.source.clone();
    let Node { params, options, spans, .. } = node;
    let Spans { params: param_spans, options: option_spans, names, .. } = spans;
    let mut each = |what: Setting, report: &mut Report, take: &mut dyn FnMut(&str, &ron::Node, &mut Report)| {
        let field_name = if what == Setting::Param { "params" } else { "options" };
        let map = field(fields, field_name).and_then(|n| report.take(n.as_map(&source))).unwrap_or_default();
        for (key, value) in map {
            if let Some(name) = report.take(key.as_str(&source)) {
                names.insert((what, name.to_string()), Span::new(&source, key.span.clone()));
                take(name, value, report);
            }
        }
    };
    each(Setting::Param, report, &mut |key, given, report| {
        if let Some(value) = param(name, key, given, report) {
            param_spans.insert(key.to_string(), Span::new(&source, given.span.clone()));
            params.insert(key.to_string(), value);
        }
    });
    each(Setting::Option, report, &mut |key, given, report| {
        let value = match &given.value {
            Tree::Text(text) | Tree::Number(text) => Some(text.clone()),
            Tree::Bool(b) => Some(b.to_string()),
            _ => report.take(Err(given.expected(&source, "a text in quotes"))),
        };
        if let Some(value) = value {
            option_spans.insert(key.to_string(), Span::new(&source, given.span.clone()));
            options.insert(key.to_string(), value);
        }
    });
}

fn param(node: &str, key: &str, given: &ron::Node, report: &mut Report) -> Option<Value> {
    let source = report.source.clone();
    let at = given.place(&source).node(node).port(key);
    match &given.value {
        Tree::Bool(b) => return Some(Value::Bool(*b)),
        Tree::Text(text) => return Some(Value::Text(text.clone())),
        Tree::Number(_) => {}
        Tree::Tuple(None, items) | Tree::List(items) if matches!(items.len(), 1..=4 | 9 | 16) => {}
        other => {
            let message = format!("`{key}` cannot be {}", other.describe());
            let help = "write `true`, a number, 2 to 4 numbers `(1, 2, 3)`, 9 or 16 for a matrix, or a text";
            report.push(Diagnostic::error("ST0061", message, at).help(help));
            return None;
        }
    }
    match given.as_numbers(&source) {
        Ok(numbers) => Some(Value::Numbers(numbers)),
        Err(mut diagnostic) => {
            diagnostic.place.node = at.node;
            diagnostic.place.port = at.port;
            report.take(Err(diagnostic))
        }
    }
}
