//! Documentation of a node, from nothing but its definition.

use std::fmt::Write as _;

use serde_json::{Map, Value as Json, json as make};

use super::definition::{Default, Definition, Port};
use crate::semantic::Value;

/// As Markdown: a heading, the description, tables of inputs, outputs and options.
pub fn markdown(definition: &Definition) -> String {
    let header = &definition.header;
    let mut out = format!("## {} (`{}`)\n\n", header.label, definition.kind);
    let _ = write!(out, "Category: {}", header.category);
    if !header.synonyms.is_empty() {
        let _ = write!(out, ". Also: {}", header.synonyms.join(", "));
    }
    out.push_str("\n\n");
    if !header.description.is_empty() {
        let _ = write!(out, "{}\n\n", header.description);
    }
    let inputs: Vec<&Port> = definition.inputs().filter(|p| !p.hidden).collect();
    if !inputs.is_empty() {
        out.push_str("| input | meaning | type | default | range | |\n|---|---|---|---|---|---|\n");
        for port in inputs {
            let row = [
                format!("`{}`", port.name),
                port.ty.meaning.to_string(),
                format!("`{}`", shape(definition, port)),
                default(port),
                with_unit(range(port), port),
                port.doc.clone(),
            ];
            let _ = writeln!(out, "| {} |", row.map(|cell| cell.replace('|', "\\|")).join(" | "));
        }
        out.push('\n');
    }
    out.push_str("| output | meaning | type | |\n|---|---|---|---|\n");
    for port in &definition.main.outputs {
        let doc = port.doc.replace('|', "\\|");
        let _ = writeln!(out, "| `{}` | {} | `{}` | {doc} |", port.name, port.ty.meaning, shape(definition, port));
    }
    if !header.options.is_empty() {
        out.push_str("\n| option | choices | default | |\n|---|---|---|---|\n");
        for option in &header.options {
            let doc = option.doc.replace('|', "\\|");
            let _ = writeln!(out, "| `{}` | {} | {} | {doc} |", option.name, option.choices.join(", "), option.default);
        }
    }
    if !header.cheaper.is_empty() {
        let _ =
            writeln!(out, "\nCheaper: {}", header.cheaper.iter().map(|c| c.doc.as_str()).collect::<Vec<_>>().join(" "));
    }
    out
}

/// As plain text for a terminal.
pub fn text(definition: &Definition) -> String {
    let header = &definition.header;
    let mut out = format!("{} - {} ({})\n", definition.kind, header.label, header.category);
    if !header.description.is_empty() {
        let _ = writeln!(out, "{}", header.description);
    }
    if !header.synonyms.is_empty() {
        let _ = writeln!(out, "also: {}", header.synonyms.join(", "));
    }
    let inputs: Vec<&Port> = definition.inputs().filter(|p| !p.hidden).collect();
    let outputs: Vec<&Port> = definition.main.outputs.iter().collect();
    for (title, ports) in [("inputs", inputs), ("outputs", outputs)] {
        if ports.is_empty() {
            continue;
        }
        let _ = writeln!(out, "\n{title}:");
        let width = ports.iter().map(|p| p.name.len()).max().unwrap_or(0);
        for port in ports {
            let _ = write!(out, "  {:width$}  {} ({})", port.name, port.ty.meaning, shape(definition, port));
            for (word, detail) in [("=", default(port)), ("in", with_unit(range(port), port))] {
                if !detail.is_empty() {
                    let _ = write!(out, " {word} {detail}");
                }
            }
            let _ = writeln!(out, "\n  {:width$}  {}", "", port.doc);
        }
    }
    if !header.options.is_empty() {
        out.push_str("\noptions:\n");
        for option in &header.options {
            let choices = option.choices.join(" | ");
            let _ = writeln!(out, "  {}: {choices} = {}\n    {}", option.name, option.default, option.doc);
        }
    }
    if !header.cheaper.is_empty() {
        out.push_str("\ncheaper:\n");
        for form in &header.cheaper {
            let _ = writeln!(out, "  {}", form.doc);
        }
    }
    out
}

/// As JSON: everything that the Markdown says, in fixed key order.
pub fn json(definition: &Definition) -> Json {
    let header = &definition.header;
    let options: Vec<Json> = header
        .options
        .iter()
        .map(|o| make!({ "name": o.name, "choices": o.choices, "default": o.default, "doc": o.doc }))
        .collect();
    let ports =
        |ports: &mut dyn Iterator<Item = &Port>| -> Vec<Json> { ports.map(|p| port_json(definition, p)).collect() };
    make!({
        "kind": definition.kind,
        "label": header.label,
        "category": header.category,
        "synonyms": header.synonyms,
        "description": header.description,
        "file": header.source.name,
        "generic": header.generic.iter().map(crate::semantic::Shape::wgsl).collect::<Vec<_>>(),
        "commutative": header.commutative,
        "inputs": ports(&mut definition.inputs().filter(|p| !p.hidden)),
        "outputs": ports(&mut definition.main.outputs.iter()),
        "options": options,
        "cheaper": header.cheaper.iter().map(|c| &c.doc).collect::<Vec<_>>(),
    })
}

fn port_json(definition: &Definition, port: &Port) -> Json {
    let mut object = Map::new();
    object.insert("name".into(), port.name.clone().into());
    object.insert("meaning".into(), port.ty.meaning.to_string().into());
    object.insert("type".into(), shape(definition, port).into());
    match &port.default {
        Some(Default::Source(name)) => object.insert("source".into(), name.clone().into()),
        Some(Default::Value(Value::Bool(b))) => object.insert("default".into(), (*b).into()),
        Some(Default::Value(Value::Text(t))) => object.insert("default".into(), t.clone().into()),
        Some(Default::Value(Value::Numbers(n))) if n.len() == 1 => object.insert("default".into(), n[0].into()),
        Some(Default::Value(Value::Numbers(n))) => object.insert("default".into(), n.clone().into()),
        None => None,
    };
    for (key, limit) in [("min", port.range.0), ("max", port.range.1)] {
        if let Some(limit) = limit {
            object.insert(key.into(), limit.into());
        }
    }
    if !port.unit.is_empty() {
        object.insert("unit".into(), port.unit.clone().into());
    }
    object.insert("doc".into(), port.doc.clone().into());
    Json::Object(object)
}

/// The WGSL type; all widths for a generic port.
fn shape(definition: &Definition, port: &Port) -> String {
    if port.ty.shape == crate::semantic::Shape::Generic {
        let widths: Vec<String> = definition.header.generic.iter().map(crate::semantic::Shape::wgsl).collect();
        return widths.join(" or ");
    }
    port.ty.shape.wgsl()
}

fn default(port: &Port) -> String {
    match &port.default {
        Some(Default::Value(value)) => value.to_string(),
        Some(Default::Source(name)) => format!("@{name}"),
        None => String::new(),
    }
}

fn range(port: &Port) -> String {
    let end = |limit: Option<f64>| limit.map(|x| x.to_string()).unwrap_or_default();
    match port.range {
        (None, None) => String::new(),
        (low, high) => format!("{}..{}", end(low), end(high)),
    }
}

fn with_unit(range: String, port: &Port) -> String {
    match (range.is_empty(), port.unit.is_empty()) {
        (true, _) => port.unit.clone(),
        (_, true) => range,
        _ => format!("{range} {}", port.unit),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::node::{Choices, NodeFile};

    const SPIN: &str = "\
//! label: Spin
//! category: math
//! synonyms: turn
//! option way: left | right = left - Which way.
//! Turns a value.

/// a (angle; = 30; 0..90; in deg): How far.
/// n (normal world; = @normal_world): About what.
/// k (scalar; = 2; hidden): Internal.
/// -> b (scalar): Turned | done.
fn spin(a: f32, n: vec3f, k: f32) -> f32 { return a * n.x * k; }
";

    #[test]
    fn all_forms_say_the_same() {
        let file = NodeFile::new("math/spin.wgsl".into(), SPIN.into(), false);
        let d = file.definition(&Choices::new()).unwrap();
        let markdown = markdown(&d);
        assert!(markdown.contains("| `a` | angle | `f32` | 30 | 0..90 deg | How far. |"), "{markdown}");
        assert!(markdown.contains("| `way` | left, right | left | Which way. |"), "{markdown}");
        assert!(markdown.contains("Turned \\| done.") && !markdown.contains("Internal"), "{markdown}");
        let text = text(&d);
        assert!(text.contains("  n  normal world (vec3f) = @normal_world"));
        let json = json(&d);
        assert_eq!(json["inputs"][0]["max"], 90.0);
        assert_eq!(json["inputs"][1]["source"], "normal_world");
        assert_eq!(json["inputs"].as_array().map(Vec::len), Some(2));
        assert_eq!(json["options"][0]["choices"][1], "right");
    }
}
