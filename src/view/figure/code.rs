//! The text of a figure: the lines that nodes made, each with the colour of its node.

use std::fmt::Write as _;

use super::{Colors, MONO, escaped, shade};
use crate::compile::Compiled;

/// Height of a line, in points.
const LINE: f64 = 12.0;
/// Size of letters, in points.
const SIZE: f64 = 8.8;
/// Letters that a column has room for.
const LETTERS: usize = 96;
/// Most rows of both columns.
const MOST: usize = 240;
/// Space above and below the rows, in points.
const PADDING: f64 = 6.0;

/// What a row of a column is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Row {
    /// A line, or what of it has room, with number and name of its node.
    Line { text: String, node: Option<(usize, String)>, comment: bool },
    /// Lines that no node made.
    Gap,
    /// Between declarations.
    Space,
    /// Lines that there is no room for.
    More(usize),
}

/// Draws rows. Answers them and their height.
pub(super) fn draw(rows: &[Row], width: f64) -> (String, f64) {
    let mut out = String::new();
    let height = height(rows.len());
    let _ = writeln!(out, r##"<rect width="{width}" height="{height:.1}" rx="4" fill="#fbfbfc" stroke="#d8dbe0"/>"##);
    let _ = writeln!(out, r##"<g font-family="{MONO}" font-size="{SIZE}" fill="#1f232b" xml:space="preserve">"##);
    let mut before = None;
    for (i, row) in rows.iter().enumerate() {
        let y = i as f64 * LINE + PADDING;
        let base = y + 9.0;
        let gray = |out: &mut String, text: &str| {
            let _ = writeln!(out, r##"<text x="12" y="{base:.1}" fill="#8a909b">{text}</text>"##);
        };
        match row {
            Row::Line { text, node, comment } => {
                if let Some((index, name)) = node {
                    let color = shade(*index);
                    let inner = width - 2.0;
                    let _ = writeln!(
                        out,
                        r#"<rect x="1" y="{y:.1}" width="{inner:.1}" height="{LINE}" fill="{color}" fill-opacity="0.16"/>"#
                    );
                    let _ = writeln!(out, r#"<rect x="1" y="{y:.1}" width="5" height="{LINE}" fill="{color}"/>"#);
                    let room = text.chars().count() + name.chars().count() + 2 < LETTERS;
                    if before != Some(*index) && room {
                        let _ = writeln!(
                            out,
                            r##"<text x="{:.1}" y="{base:.1}" text-anchor="end" fill="#5a616c" font-style="italic">{}</text>"##,
                            width - 6.0,
                            escaped(name)
                        );
                    }
                }
                if *comment {
                    let _ = writeln!(out, r##"<text x="12" y="{base:.1}" fill="#6a717c">{}</text>"##, escaped(text));
                } else {
                    let _ = writeln!(out, r#"<text x="12" y="{base:.1}">{}</text>"#, escaped(text));
                }
                before = node.as_ref().map(|(index, _)| *index);
            }
            Row::Gap => {
                gray(&mut out, "⋯");
                before = None;
            }
            Row::Space => before = None,
            Row::More(count) => gray(&mut out, &format!("⋯ {count} more lines")),
        }
    }
    out.push_str("</g>\n");
    (out, height)
}

fn height(rows: usize) -> f64 {
    rows as f64 * LINE + 2.0 * PADDING
}

/// How many rows belong into the left column so that both end at about the same height, given where they begin. Functions
/// are not torn where that can be helped.
pub(super) fn split(rows: &[Row], left: f64, right: f64) -> usize {
    let end = |count: usize| {
        let column = |top: f64, n: usize| if n == 0 { top } else { top + height(n) };
        (column(left, count) - column(right, rows.len() - count)).abs()
    };
    let begins = |count: usize| count == 0 || matches!(rows.get(count), None | Some(Row::Space));
    let tear = |count: usize| if begins(count) { 0.0 } else { 20.0 * LINE };
    let cost = |count: &usize| end(*count) + tear(*count);
    (0..=rows.len()).min_by(|a, b| cost(a).total_cmp(&cost(b))).unwrap_or(0)
}

/// The lines that nodes of the graphs made, and the heads and ends of what they stand in.
pub(super) fn rows(compiled: &Compiled, colors: &Colors) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut block = Vec::new();
    let mut start = 0;
    for line in compiled.module.wgsl.split_inclusive('\n') {
        let text = line.trim_end();
        let inside = start + (line.len() - line.trim_start().len());
        start += line.len();
        if text.is_empty() {
            continue;
        }
        let node = compiled.module.origin_of(inside).and_then(|o| colors.of_text(&o.node));
        block.push((text, node.map(|(index, name)| (index, name.to_owned()))));
        // Declarations end at the margin.
        if text == "}" || (text.ends_with(';') && !text.starts_with(' ')) {
            declaration(&std::mem::take(&mut block), &mut rows);
        }
    }
    declaration(&block, &mut rows);
    if rows.len() > MOST {
        let more = rows.len() - MOST;
        rows.truncate(MOST);
        rows.push(Row::More(more));
    }
    rows
}

/// Adds a declaration, if nodes made some of it.
fn declaration(lines: &[(&str, Option<(usize, String)>)], rows: &mut Vec<Row>) {
    if lines.iter().all(|(_, node)| node.is_none()) {
        return;
    }
    if !rows.is_empty() {
        rows.push(Row::Space);
    }
    for (i, (text, node)) in lines.iter().enumerate() {
        // What is said of a node before it belongs to it.
        let next = || lines.get(i + 1).and_then(|(_, node)| node.clone());
        let node = node.clone().or_else(|| if is_comment(text) { next() } else { None });
        if node.is_some() || !text.starts_with(' ') {
            wrap(text, node, rows);
        } else if rows.last() != Some(&Row::Gap) {
            rows.push(Row::Gap);
        }
    }
}

fn is_comment(text: &str) -> bool {
    text.trim_start().starts_with("//")
}

/// Adds a line in as many rows as it needs.
fn wrap(text: &str, node: Option<(usize, String)>, rows: &mut Vec<Row>) {
    let comment = is_comment(text);
    let indent = text.len() - text.trim_start().len();
    let mut rest: Vec<char> = text.chars().collect();
    let mut lead = String::new();
    loop {
        let room = LETTERS - lead.len();
        if rest.len() <= room {
            let text = lead + &rest.into_iter().collect::<String>();
            rows.push(Row::Line { text, node, comment });
            return;
        }
        // Between words where there are any.
        let least = indent + 20;
        let at = (least.min(room)..room).rev().find(|i| rest[*i] == ' ').map_or(room, |i| i + 1);
        let head: String = rest.drain(..at).collect();
        rows.push(Row::Line { text: lead + head.trim_end(), node: node.clone(), comment });
        lead = " ".repeat((indent + 8).min(LETTERS / 2));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(text: &str) -> Row {
        Row::Line { text: text.into(), node: None, comment: false }
    }

    #[test]
    fn letters_fit_the_column() {
        /// Width over size: that of Hack and of most fonts of its kind.
        const LETTER: f64 = 0.602;
        assert!(12.0 + LETTERS as f64 * SIZE * LETTER <= super::super::COLUMN - 4.0);
    }

    #[test]
    fn long_lines_are_wrapped_between_words() {
        let mut rows = Vec::new();
        wrap(&format!("    let a = {};", vec!["word"; 40].join(" + ")), None, &mut rows);
        assert!(rows.len() > 2, "{rows:?}");
        for row in &rows {
            let Row::Line { text, .. } = row else { panic!("{row:?}") };
            assert!(text.chars().count() <= LETTERS && text.starts_with("    ") && !text.ends_with(' '), "{text}");
        }
        let mut rows = Vec::new();
        wrap(&"x".repeat(300), None, &mut rows);
        assert_eq!(rows.len(), 4);
    }

    #[test]
    fn columns_end_together_at_the_end_of_a_function() {
        let function = |n: usize| [vec![line("fn a() {")], vec![line("    x"); n], vec![line("}")]].concat();
        let rows = [function(10), vec![Row::Space], function(9), vec![Row::Space], function(14)].concat();
        assert_eq!(split(&rows, 0.0, 0.0), 24);
        assert_eq!(split(&rows, 0.0, 1000.0), rows.len());
        assert_eq!(split(&[], 0.0, 0.0), 0);
    }
}
