//! What a person got wrong: where, what, and what to do about it. Rendered once, as text or as JSON.
//!
//! Diagnostics accumulate; producing one never stops the work that found it. This module knows nothing of graphs,
//! nodes or WGSL: places are plain names and byte ranges.

use std::ops::Range;
use std::sync::Arc;

/// How bad it is. Only [`Severity::Error`] stops generation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The input cannot be used as it is.
    Error,
    /// The input works, but probably not as meant.
    Warning,
}

/// A text that diagnostics can point into.
#[derive(Debug, PartialEq, Eq)]
pub struct SourceText {
    /// Name shown to people: a path as given, or `-` for standard input.
    pub name: String,
    /// The whole text.
    pub text: String,
}

impl SourceText {
    /// A shared source text.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Arc<Self> {
        Arc::new(Self { name: name.into(), text: text.into() })
    }
}

/// A byte range of a source text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Span {
    /// The text.
    pub source: Arc<SourceText>,
    /// Bytes within it.
    pub range: Range<usize>,
}

impl Span {
    /// A span over `range` of `source`.
    pub fn new(source: &Arc<SourceText>, range: Range<usize>) -> Self {
        Self { source: source.clone(), range }
    }

    /// 1-based line and 1-based column (in characters) of the start.
    pub fn line_column(&self) -> (usize, usize) {
        let text = &self.source.text;
        let mut at = self.range.start.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        let before = &text[..at];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        (before.bytes().filter(|&b| b == b'\n').count() + 1, before[line_start..].chars().count() + 1)
    }
}

/// Where something is wrong, as far as is known.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Place in a file.
    pub span: Option<Span>,
    /// File name when there is no span (a missing file, for example).
    pub file: Option<String>,
    /// Node name.
    pub node: Option<String>,
    /// Port of that node.
    pub port: Option<String>,
}

impl Place {
    /// A place in a text.
    pub fn span(span: Span) -> Self {
        Self { span: Some(span), ..Self::default() }
    }

    /// A whole file.
    pub fn file(name: impl Into<String>) -> Self {
        Self { file: Some(name.into()), ..Self::default() }
    }

    /// The same place, at a node.
    #[must_use]
    pub fn node(mut self, node: impl Into<String>) -> Self {
        self.node = Some(node.into());
        self
    }

    /// The same place, at a port.
    #[must_use]
    pub fn port(mut self, port: impl Into<String>) -> Self {
        self.port = Some(port.into());
        self
    }
}

/// One mistake with its place and its remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Stable code, `ST0123`; explained in [`crate::explain`].
    pub code: &'static str,
    /// How bad it is.
    pub severity: Severity,
    /// What is wrong, one sentence without a full stop.
    pub message: String,
    /// Where.
    pub place: Place,
    /// What to do; may have several lines.
    pub help: Option<String>,
    /// Further lines of detail (candidates, the WGSL line, and so on).
    pub notes: Vec<String>,
}

impl Diagnostic {
    /// An error.
    pub fn error(code: &'static str, message: impl Into<String>, place: Place) -> Self {
        let message = bounded(message.into());
        Self { code, severity: Severity::Error, message, place, help: None, notes: Vec::new() }
    }

    /// A warning.
    pub fn warning(code: &'static str, message: impl Into<String>, place: Place) -> Self {
        Self { severity: Severity::Warning, ..Self::error(code, message, place) }
    }

    /// The same diagnostic with a remedy.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(bounded(help.into()));
        self
    }

    /// The same diagnostic with one more line of detail.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(bounded(note.into()));
        self
    }
}

/// Longest text of a diagnostic in bytes: a name of a megabyte must not bury what is said about it.
const LONGEST_TEXT: usize = 4000;

/// The text, cut where it is too long to be read.
fn bounded(mut text: String) -> String {
    if text.len() > LONGEST_TEXT {
        let mut end = LONGEST_TEXT;
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        text.truncate(end);
        text.push_str(" ...");
    }
    text
}

/// At most `most` errors and as many warnings. Where some are left out, `rest` is the last, as an error or a warning.
pub fn limited(found: Vec<Diagnostic>, most: usize, rest: &Diagnostic) -> Vec<Diagnostic> {
    let mut kept = Vec::new();
    let (mut errors, mut warnings) = (0, 0);
    for diagnostic in found {
        let count = if diagnostic.severity == Severity::Error { &mut errors } else { &mut warnings };
        *count += 1;
        if *count <= most {
            kept.push(diagnostic);
        }
    }
    for (count, severity) in [(warnings, Severity::Warning), (errors, Severity::Error)] {
        if count > most {
            kept.push(Diagnostic { severity, ..rest.clone() });
        }
    }
    kept
}

/// Whether any of them is an error.
pub fn has_errors(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|d| d.severity == Severity::Error)
}

/// The candidate nearest to `wanted` by edit distance, if near enough to be what was meant.
pub fn did_you_mean<'a>(wanted: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let limit = (wanted.chars().count() / 3).max(1);
    candidates
        .into_iter()
        .map(|c| (edit_distance(wanted, c), c))
        .filter(|(d, c)| *d <= limit || (wanted.len() >= 3 && c.contains(wanted)))
        .min()
        .map(|(_, c)| c)
}

/// Insertions, deletions, changes and swaps of neighbours that make one of the other (optimal string alignment).
fn edit_distance(a: &str, b: &str) -> usize {
    let letters = |text: &str| text.chars().take(64).map(|c| c.to_ascii_lowercase()).collect::<Vec<char>>();
    let (a, b) = (letters(a), letters(b));
    let mut before: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut row = vec![i + 1];
        for j in 0..b.len() {
            let changed = above[j] + usize::from(a[i] != b[j]);
            let mut least = changed.min(above[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                least = least.min(before[j - 1] + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances() {
        for (a, b, distance) in [
            ("", "", 0),
            ("", "abc", 3),
            ("noise", "noise", 0),
            ("niose", "noise", 1),
            ("Noise", "noise", 0),
            ("nois", "noise", 1),
            ("noises", "noise", 1),
            ("moise", "noise", 1),
            ("ca", "abc", 3),
            ("abdc", "acbd", 2),
        ] {
            assert_eq!((edit_distance(a, b), edit_distance(b, a)), (distance, distance), "{a} {b}");
        }
    }

    #[test]
    fn a_slip_of_the_fingers_is_understood() {
        let words = ["noise", "node", "normal", "ggx"];
        let near = |wanted| did_you_mean(wanted, words);
        assert_eq!((near("niose"), near("nromal"), near("xgg")), (Some("noise"), Some("normal"), None));
        assert_eq!((near("norm"), near("mahogany"), near("")), (Some("normal"), None, None));
    }
}
