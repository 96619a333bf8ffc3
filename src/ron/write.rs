//! From tree to text: one spelling for each value, on one line but for the line breaks inside raw strings.

use std::fmt::Write;

use super::{Node, Tree};

/// The shortest decimal that reads back as the same number. RON's words stand for what is not finite.
pub fn number(x: f64) -> String {
    if x.is_nan() {
        return "NaN".into();
    }
    let plain = format!("{x}");
    let exponent = format!("{x:e}");
    if exponent.len() < plain.len() && plain.len() > 12 { exponent } else { plain }
}

/// A text in quotes: raw where that saves escapes and every character can be seen, escaped otherwise.
pub fn text(text: &str) -> String {
    let hidden = |c: char| (c.is_control() && !matches!(c, '\n' | '\t')) || matches!(c, '\u{2028}' | '\u{2029}');
    if text.contains(['\n', '"', '\\']) && !text.contains(hidden) {
        let mut hashes = 1;
        let mut run = None;
        for c in text.chars() {
            run = match (c, run) {
                ('"', _) => Some(0),
                ('#', Some(n)) => Some(n + 1),
                _ => None,
            };
            hashes = hashes.max(run.map_or(0, |n: usize| n + 1));
        }
        let hashes = "#".repeat(hashes);
        return format!("r{hashes}\"{text}\"{hashes}");
    }
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        escape(&mut out, c, '"');
    }
    out.push('"');
    out
}

fn escape(out: &mut String, c: char, quote: char) {
    match c {
        '\\' => out.push_str("\\\\"),
        '\n' => out.push_str("\\n"),
        '\r' => out.push_str("\\r"),
        '\t' => out.push_str("\\t"),
        '\0' => out.push_str("\\0"),
        c if c == quote => out.extend(['\\', c]),
        c if c.is_control() || matches!(c, '\u{2028}' | '\u{2029}') => {
            out.push_str(&format!("\\u{{{:x}}}", u32::from(c)));
        }
        c => out.push(c),
    }
}

/// A value in its one spelling.
pub fn inline(node: &Node) -> String {
    let mut out = String::new();
    write(&mut out, node);
    out
}

fn write(out: &mut String, node: &Node) {
    match &node.value {
        Tree::Bool(b) => {
            // Writing to a String cannot fail.
            let _ = write!(out, "{b}");
        }
        Tree::Number(written) => out.push_str(written),
        Tree::Char(c) => {
            out.push('\'');
            escape(out, *c, '\'');
            out.push('\'');
        }
        Tree::Text(content) => out.push_str(&text(content)),
        Tree::Option(None) => out.push_str("None"),
        Tree::Option(Some(inner)) => {
            out.push_str("Some(");
            write(out, inner);
            out.push(')');
        }
        Tree::List(items) => series(out, "[", items, "]", write),
        Tree::Map(entries) => series(out, "{", entries, "}", |out, (key, value)| {
            write(out, key);
            out.push_str(": ");
            write(out, value);
        }),
        Tree::Tuple(name, items) => {
            out.push_str(&name.as_deref().map(identifier).unwrap_or_default());
            series(out, "(", items, ")", write);
        }
        Tree::Struct(name, fields) => {
            out.push_str(&name.as_deref().map(identifier).unwrap_or_default());
            series(out, "(", fields, ")", |out, field| {
                out.push_str(&identifier(&field.name));
                out.push_str(": ");
                write(out, &field.value);
            });
        }
        Tree::Ident(word) => out.push_str(&identifier(word)),
    }
}

fn series<T>(out: &mut String, open: &str, items: &[T], close: &str, mut one: impl FnMut(&mut String, &T)) {
    out.push_str(open);
    for (index, item) in items.iter().enumerate() {
        if index > 0 {
            out.push_str(", ");
        }
        one(out, item);
    }
    out.push_str(close);
}

/// A name of a field, struct or variant, marked as raw where it needs to be.
pub fn identifier(name: &str) -> String {
    if name.contains(['.', '+', '-']) || name.starts_with(char::is_numeric) { format!("r#{name}") } else { name.into() }
}
