//! Diagnostics for people (text with the lines they are about) and for programs (one JSON object a line).

use std::borrow::Cow;
use std::ops::Range;

use codespan_reporting::diagnostic::{Diagnostic as Report, Label, Severity as Level};
use codespan_reporting::files::SimpleFile;
use codespan_reporting::term::{self, Chars, Config, Styles, StylesWriter, termcolor::Buffer};
use serde_json::{Value as Json, json};

use crate::diagnostic::{Diagnostic, Severity, Span};

/// Version of the JSON form; a change that breaks readers raises it.
pub const SCHEMA: u32 = 1;

/// A line longer than this many bytes is not shown: it would bury the message.
const LONGEST_LINE: usize = 400;

/// The diagnostic as text: severity, code and message, the place as `file:line:column` with the lines it is about,
/// notes and help. `color` adds ANSI colours. Ends with a newline.
pub fn text(diagnostic: &Diagnostic, color: bool) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::Error,
        Severity::Warning => Level::Warning,
    };
    let mut report = Report::new(level).with_code(diagnostic.code).with_message(headline(diagnostic));
    let mut name = Cow::Borrowed("");
    let mut source = Cow::Borrowed("");
    match &diagnostic.place.span {
        Some(span) if is_short(span) => {
            name = printable(&span.source.name);
            source = printable(&span.source.text);
            report = report.with_label(Label::primary((), clamped(span)));
        }
        Some(span) => {
            let (line, column) = span.line_column();
            report = report.with_note(format!("at {}:{line}:{column}", printable(&span.source.name)));
        }
        None => {
            if let Some(file) = &diagnostic.place.file {
                report = report.with_note(format!("in {}", printable(file)));
            }
        }
    }
    let notes = diagnostic.notes.iter().map(|n| format!("note: {}", printable(n)));
    let help = diagnostic.help.iter().map(|h| format!("help: {}", printable(h)));
    report = report.with_notes(notes.chain(help).map(indented).collect());

    let config = Config { chars: Chars::ascii(), ..Config::default() };
    let file = SimpleFile::new(name, source);
    let mut buffer = if color { Buffer::ansi() } else { Buffer::no_color() };
    let styles = if color { Styles::default() } else { Styles::no_color() };
    let written = term::emit_to_write_style(&mut StylesWriter::new(&mut buffer, &styles), &config, &file, &report);
    if written.is_err() {
        return format!("{}[{}]: {}\n", severity(diagnostic), diagnostic.code, headline(diagnostic));
    }
    let text = String::from_utf8_lossy(buffer.as_slice()).into_owned();
    // A blank line between reports is for the caller to decide.
    format!("{}\n", text.trim_end())
}

/// The diagnostic as one JSON object without line breaks, `"schema": 1`. `line`, `column` and `end` (line and column
/// of the first character that is not part of it) count from 1, in characters; what is not known is null.
pub fn json(diagnostic: &Diagnostic) -> Json {
    let span = diagnostic.place.span.as_ref();
    let start = span.map(Span::line_column);
    let end = span.map(|s| Span::new(&s.source, s.range.end..s.range.end).line_column());
    json!({
        "schema": SCHEMA,
        "severity": severity(diagnostic),
        "code": diagnostic.code,
        "message": diagnostic.message,
        "file": span.map(|s| s.source.name.as_str()).or(diagnostic.place.file.as_deref()),
        "line": start.map(|s| s.0),
        "column": start.map(|s| s.1),
        "end": end.map(|(line, column)| json!({ "line": line, "column": column })),
        "node": diagnostic.place.node,
        "port": diagnostic.place.port,
        "help": diagnostic.help,
        "notes": diagnostic.notes,
    })
}

fn severity(diagnostic: &Diagnostic) -> &'static str {
    match diagnostic.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    }
}

/// The message, with the node and port named unless it names them itself.
fn headline(diagnostic: &Diagnostic) -> String {
    let message = printable(&diagnostic.message);
    let place = match (&diagnostic.place.node, &diagnostic.place.port) {
        (Some(node), Some(port)) => format!("`{node}.{port}`"),
        (Some(node), None) => format!("`{node}`"),
        _ => return message.into_owned(),
    };
    let place = printable(&place);
    if message.contains(place.as_ref()) { message.into_owned() } else { format!("{message} (at {place})") }
}

/// The range, inside the text and on character boundaries, as a broken span must not hide the message.
fn clamped(span: &Span) -> Range<usize> {
    let text = &span.source.text;
    let boundary = |mut at: usize| {
        at = at.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let start = boundary(span.range.start);
    start..boundary(span.range.end).max(start)
}

fn is_short(span: &Span) -> bool {
    let range = clamped(span);
    let text = &span.source.text;
    let before = text[..range.start].rfind('\n').map_or(0, |i| i + 1);
    let after = text[range.end..].find('\n').map_or(text.len(), |i| range.end + i);
    text[before..after].lines().all(|l| l.len() <= LONGEST_LINE)
}

/// The text with control characters (which could move a terminal's cursor) as `?`, byte positions kept.
fn printable(text: &str) -> Cow<'_, str> {
    let hostile = |c: char| c.is_control() && !matches!(c, '\n' | '\r' | '\t');
    if !text.contains(hostile) {
        return Cow::Borrowed(text);
    }
    let mut result = String::with_capacity(text.len());
    for c in text.chars() {
        if hostile(c) {
            result.extend(std::iter::repeat_n('?', c.len_utf8()));
        } else {
            result.push(c);
        }
    }
    Cow::Owned(result)
}

/// Later lines of a note, under the first.
fn indented(note: String) -> String {
    note.trim_end().replace('\n', "\n  ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::{Place, SourceText};

    fn sample() -> Diagnostic {
        let source = SourceText::new("a.ron", "Graph(\n  nodes: 3,\n)\n");
        let place = Place::span(Span::new(&source, 16..17)).node("glass").port("ior");
        Diagnostic::error("ST0061", "a value is wrong", place).help("write a map").note("one\ntwo")
    }

    #[test]
    fn text_names_place_node_and_help() {
        let text = text(&sample(), false);
        let expected = "error[ST0061]: a value is wrong (at `glass.ior`)\n  --> a.ron:2:10\n  |\n2 |   nodes: 3,\n  |          ^\n  |\n  = note: one\n      two\n  = help: write a map\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn json_counts_from_one() {
        let json = json(&sample());
        assert_eq!((json["line"].as_u64(), json["column"].as_u64()), (Some(2), Some(10)));
        assert_eq!(json["end"], json!({ "line": 2, "column": 11 }));
        assert_eq!((json["node"].as_str(), json["port"].as_str()), (Some("glass"), Some("ior")));
    }

    #[test]
    fn long_lines_and_escapes_stay_out_of_the_terminal() {
        let source = SourceText::new("b\u{1b}.ron", format!("{}\u{1b}[2J", "x".repeat(100_000)));
        let text = text(&Diagnostic::error("ST0001", "bad\u{1b}[0m", Place::span(Span::new(&source, 5..9))), false);
        assert!(text.len() < 200 && !text.contains('\u{1b}'), "{text}");
        assert!(text.contains("at b?.ron:1:6"), "{text}");
    }

    #[test]
    fn a_broken_span_still_gives_the_message() {
        let source = SourceText::new("c.ron", "é");
        let text = text(&Diagnostic::warning("ST0001", "odd", Place::span(Span::new(&source, 1..99))), true);
        assert!(text.contains("odd") && text.contains("c.ron:1:1"), "{text}");
    }
}
