//! The one text of a graph: sorted, one node or link a line, positions last, so that moving a node changes nothing
//! else and two people's changes merge line by line.

use std::collections::BTreeMap;

use super::write_canvas::canvas;
use super::{End, Expose, Graph, Link, Node, VERSION};
use crate::ron;
use crate::semantic::Value;

/// The canonical text of a graph. Reading it gives the same graph, and writing that gives the same text.
pub fn write(graph: &Graph) -> String {
    let mut out = format!("Graph(\n    version: {VERSION},\n");
    for (field, text) in [("name", &graph.name), ("note", &graph.note)] {
        if !text.is_empty() {
            out += &format!("    {field}: {},\n", ron::text(text));
        }
    }
    let nodes = graph.nodes.iter().map(|(name, node)| format!("{}: {}", ron::text(name), node_text(node)));
    block(&mut out, 1, "nodes", ['{', '}'], nodes);
    let mut links: Vec<&Link> = graph.links.iter().collect();
    links.sort_by(|a, b| a.ends().cmp(&b.ends()));
    block(&mut out, 1, "links", ['[', ']'], links.into_iter().map(link_text));
    if let Some(output) = &graph.output {
        out += &format!("    output: {},\n", end_text(output));
    }
    expose(&mut out, &graph.expose);
    for (name, value) in &graph.unknown {
        out += &format!("    {}: {},\n", ron::identifier(name), ron::inline(value));
    }
    canvas(&mut out, graph);
    out.push_str(")\n");
    out
}

/// `field: {` one item a line `},`; nothing where there are no items.
pub(super) fn block(
    out: &mut String,
    level: usize,
    field: &str,
    [open, close]: [char; 2],
    items: impl Iterator<Item = String>,
) {
    let indent = "    ".repeat(level);
    let mut items = items.peekable();
    if items.peek().is_none() {
        return;
    }
    *out += &format!("{indent}{field}: {open}\n");
    for item in items {
        *out += &format!("{indent}    {item},\n");
    }
    *out += &format!("{indent}{close},\n");
}

fn node_text(node: &Node) -> String {
    let mut fields = Vec::new();
    if !node.kind.is_empty() {
        fields.push(format!("kind: {}", ron::text(&node.kind)));
    }
    for (field, text) in [("graph", &node.graph), ("wgsl", &node.wgsl)] {
        if let Some(text) = text {
            fields.push(format!("{field}: {}", ron::text(text)));
        }
    }
    let params = node.params.iter().map(|(name, value)| format!("{}: {}", ron::text(name), value_text(value)));
    inline_map(&mut fields, "params", params);
    let options = node.options.iter().map(|(name, value)| format!("{}: {}", ron::text(name), ron::text(value)));
    inline_map(&mut fields, "options", options);
    if node.muted {
        fields.push("muted: true".into());
    }
    remark(&mut fields, &node.note, &node.unknown);
    format!("({})", fields.join(", "))
}

fn inline_map(fields: &mut Vec<String>, field: &str, items: impl Iterator<Item = String>) {
    let items: Vec<String> = items.collect();
    if !items.is_empty() {
        fields.push(format!("{field}: {{{}}}", items.join(", ")));
    }
}

pub(super) fn remark(fields: &mut Vec<String>, note: &str, unknown: &[(String, ron::Node)]) {
    if !note.is_empty() {
        fields.push(format!("note: {}", ron::text(note)));
    }
    for (name, value) in unknown {
        fields.push(format!("{}: {}", ron::identifier(name), ron::inline(value)));
    }
}

fn link_text(link: &Link) -> String {
    let ends = ron::text(&link.to_string());
    if link.note.is_empty() && link.unknown.is_empty() {
        return ends;
    }
    let mut fields = vec![format!("link: {ends}")];
    remark(&mut fields, &link.note, &link.unknown);
    format!("({})", fields.join(", "))
}

fn end_text(end: &End) -> String {
    ron::text(&end.to_string())
}

fn value_text(value: &Value) -> String {
    match value {
        Value::Bool(b) => b.to_string(),
        Value::Text(text) => ron::text(text),
        Value::Numbers(numbers) => {
            let numbers: Vec<String> = numbers.iter().map(|x| ron::number(*x)).collect();
            match numbers.as_slice() {
                [one] => one.clone(),
                many => format!("({})", many.join(", ")),
            }
        }
    }
}

fn expose(out: &mut String, expose: &Expose) {
    if expose.is_empty() {
        return;
    }
    let fans = |ends: &BTreeMap<String, Vec<End>>| -> Vec<String> {
        let one = |(name, ends): (&String, &Vec<End>)| {
            let ends: Vec<String> = ends.iter().map(end_text).collect();
            match ends.as_slice() {
                [end] => format!("{}: {end}", ron::text(name)),
                ends => format!("{}: [{}]", ron::text(name), ends.join(", ")),
            }
        };
        ends.iter().map(one).collect()
    };
    out.push_str("    expose: (\n");
    block(out, 2, "inputs", ['{', '}'], fans(&expose.inputs).into_iter());
    let outputs = expose.outputs.iter().map(|(name, end)| format!("{}: {}", ron::text(name), end_text(end)));
    block(out, 2, "outputs", ['{', '}'], outputs);
    block(out, 2, "options", ['{', '}'], fans(&expose.options).into_iter());
    for (name, value) in &expose.unknown {
        *out += &format!("        {}: {},\n", ron::identifier(name), ron::inline(value));
    }
    out.push_str("    ),\n");
}
