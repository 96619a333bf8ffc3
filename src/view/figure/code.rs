//! The text of a figure: the lines that nodes made, each with the colour of its node.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::{cut, escaped};
use crate::compile::Compiled;

/// Height of a line, in points.
const LINE: f64 = 12.5;
/// Most lines that are shown.
const MOST: usize = 84;
/// Most letters of a line that are shown.
const LETTERS: usize = 96;

/// What a row of the column is.
enum Row<'a> {
    Line {
        text: &'a str,
        node: Option<&'a str>,
    },
    /// Lines that no node made.
    Gap,
}

/// Draws the text. Answers it and its height.
pub(super) fn draw(compiled: &Compiled, colors: &BTreeMap<&str, String>, width: f64) -> (String, f64) {
    let rows = rows(compiled, colors);
    let shown = rows.len().min(MOST);
    let mut out = String::new();
    #[allow(clippy::cast_precision_loss, reason = "a line number")]
    let y_of = |i: usize| i as f64 * LINE;
    let height = y_of(shown + usize::from(rows.len() > shown)) + 10.0;
    let _ = writeln!(out, r##"<rect width="{width}" height="{height:.1}" rx="4" fill="#fbfbfc" stroke="#d8dbe0"/>"##);
    let _ = writeln!(
        out,
        r##"<g font-family="Hack, DejaVu Sans Mono, monospace" font-size="9.6" fill="#22262e" xml:space="preserve">"##
    );
    for (i, row) in rows.iter().take(shown).enumerate() {
        let y = y_of(i) + 5.0;
        match row {
            Row::Line { text, node } => {
                if let Some(color) = node.and_then(|n| colors.get(n)) {
                    let _ = writeln!(
                        out,
                        r#"<rect x="1" y="{y:.1}" width="{:.1}" height="{LINE}" fill="{color}" fill-opacity="0.18"/>"#,
                        width - 2.0
                    );
                    let _ = writeln!(out, r#"<rect x="1" y="{y:.1}" width="5" height="{LINE}" fill="{color}"/>"#);
                }
                let _ = writeln!(out, r#"<text x="12" y="{:.1}">{}</text>"#, y + 9.5, escaped(&cut(text, LETTERS)));
            }
            Row::Gap => {
                let _ = writeln!(out, r##"<text x="12" y="{:.1}" fill="#9aa0aa">⋯</text>"##, y + 9.5);
            }
        }
    }
    if rows.len() > shown {
        let _ = writeln!(
            out,
            r##"<text x="12" y="{:.1}" fill="#9aa0aa">⋯ {} more lines</text>"##,
            y_of(shown) + 14.5,
            rows.len() - shown
        );
    }
    out.push_str("</g>\n");
    (out, height)
}

/// The lines that nodes of the graph made, and the heads of functions that they stand in.
fn rows<'a>(compiled: &'a Compiled, colors: &BTreeMap<&'a str, String>) -> Vec<Row<'a>> {
    let module = &compiled.module;
    let mut rows: Vec<Row<'a>> = Vec::new();
    let mut start = 0;
    for line in module.wgsl.split_inclusive('\n') {
        let text = line.trim_end();
        let inside = start + (line.len() - line.trim_start().len());
        let node = module.origin_of(inside).and_then(|o| known(&o.node, colors));
        let head = text.starts_with("fn ") || text == "}";
        start += line.len();
        if text.is_empty() {
            continue;
        }
        if node.is_some() || (head && !text.is_empty()) {
            // A function that nothing of the graph is in is left out with its end.
            if text == "}"
                && matches!(rows.last(), Some(Row::Gap))
                && matches!(rows.iter().rev().nth(1), Some(Row::Line { text, node: None }) if text.starts_with("fn "))
            {
                rows.pop();
                rows.pop();
                if !matches!(rows.last(), Some(Row::Gap)) {
                    rows.push(Row::Gap);
                }
                continue;
            }
            rows.push(Row::Line { text, node });
        } else if !matches!(rows.last(), Some(Row::Gap)) {
            rows.push(Row::Gap);
        }
    }
    rows
}

/// The node of the graph that a name of the source map stands for: itself, or what it is a part of.
fn known<'a>(full: &str, colors: &BTreeMap<&'a str, String>) -> Option<&'a str> {
    let own = |name: &str| colors.keys().find(|k| **k == name).copied();
    own(full).or_else(|| full.split('/').find_map(own))
}
