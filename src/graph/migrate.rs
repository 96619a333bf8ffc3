//! Older forms of the file, step by step to the present one, on the tree: spans stay those of the text that was read.
//!
//! - Version 0 wrote links as `(from: "a.port", to: "b")` and positions as a `position: (x, y)` field of each node.

use super::VERSION;
use super::read::Report;
use crate::diagnostic::Diagnostic;
use crate::ron::{Field, Node, Tree};

/// One step each: from the version that is its index to the next.
const STEPS: [fn(&mut Vec<Field>); VERSION as usize] = [from_0];

/// Brings the fields of a `Graph(...)` to the present version. Says whether they can be read at all.
pub(super) fn migrate(fields: &mut Vec<Field>, root: &Node, report: &mut Report) -> bool {
    let Some(field) = fields.iter_mut().find(|f| f.name == "version") else {
        let start = root.span.start..root.span.start + "Graph".len();
        let message = "the graph does not say which version of the format it is written in";
        let missing = Diagnostic::error("ST0051", message, report.at(start));
        report.push(missing.help(format!("write `version: {VERSION},` as its first field")));
        return true;
    };
    let place = field.value.place(&report.source);
    let Ok(version) = field.value.as_u64(&report.source, u64::from(u32::MAX)) else {
        let message = format!("a version is a whole number, not {}", field.value.value.describe());
        report.push(Diagnostic::error("ST0051", message, place).help(format!("this format is `version: {VERSION}`")));
        return true;
    };
    if version > u64::from(VERSION) {
        let message = format!("the graph is of version {version}, and versions up to {VERSION} can be read here");
        report.push(Diagnostic::error("ST0052", message, place).help("use a newer shadetree"));
        return false;
    }
    field.value.value = Tree::Number(VERSION.to_string());
    for step in &STEPS[version as usize..] {
        step(fields);
    }
    true
}

fn from_0(fields: &mut Vec<Field>) {
    for field in fields.iter_mut().filter(|f| f.name == "links") {
        if let Tree::List(links) = &mut field.value.value {
            links.iter_mut().for_each(link_from_0);
        }
    }
    let mut positions = Vec::new();
    for field in fields.iter_mut().filter(|f| f.name == "nodes") {
        let Tree::Map(nodes) = &mut field.value.value else {
            continue;
        };
        for (name, node) in nodes {
            let Tree::Struct(_, parts) = &mut node.value else {
                continue;
            };
            if let Some(index) = parts.iter().position(|f| f.name == "position") {
                positions.push((name.clone(), parts.remove(index).value));
            }
        }
    }
    if positions.is_empty() {
        return;
    }
    match fields.iter_mut().find(|f| f.name == "layout") {
        Some(Field { value: Node { value: Tree::Map(layout), .. }, .. }) => layout.extend(positions),
        Some(_) => {} // Not a map: told when it is read.
        None => {
            let span = positions[0].1.span.clone();
            let value = Node { span: span.clone(), value: Tree::Map(positions) };
            fields.push(Field { name: "layout".into(), name_span: span, value });
        }
    }
}

fn link_from_0(link: &mut Node) {
    let Tree::Struct(_, fields) = &mut link.value else {
        return;
    };
    let end = |name: &str| {
        fields.iter().find_map(|f| match &f.value.value {
            Tree::Text(text) if f.name == name => Some(text.clone()),
            _ => None,
        })
    };
    let (Some(from), Some(to)) = (end("from"), end("to")) else {
        return;
    };
    let text = Tree::Text(format!("{from} -> {to}"));
    fields.retain(|f| f.name != "from" && f.name != "to");
    if fields.is_empty() {
        link.value = text;
    } else {
        let value = Node { span: link.span.clone(), value: text };
        fields.insert(0, Field { name: "link".into(), name_span: link.span.clone(), value });
    }
}
