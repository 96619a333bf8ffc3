//! Collecting mistakes found in one text.

use std::ops::Range;
use std::sync::Arc;

use crate::diagnostic::{Diagnostic, Place, SourceText, Span, did_you_mean};

/// What was found so far in one text; ranges are bytes of that text.
pub(crate) struct Report {
    /// The text.
    pub(crate) source: Arc<SourceText>,
    /// The findings.
    pub(crate) found: Vec<Diagnostic>,
}

impl Report {
    pub(crate) fn new(source: &Arc<SourceText>) -> Self {
        Self { source: source.clone(), found: Vec::new() }
    }

    /// Adds an error; the result takes help and notes.
    pub(crate) fn error(&mut self, code: &'static str, range: Range<usize>, message: impl Into<String>) -> Entry<'_> {
        let place = Place::span(Span::new(&self.source, range));
        self.found.push(Diagnostic::error(code, message, place));
        let last = self.found.len() - 1;
        Entry(&mut self.found[last])
    }
}

/// An error just added.
pub(crate) struct Entry<'a>(&'a mut Diagnostic);

impl Entry<'_> {
    /// Says what to do.
    pub(crate) fn help(self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into());
        self
    }

    /// Suggests the nearest of some words, or tells all of them.
    pub(crate) fn among<'w>(self, wanted: &str, words: impl IntoIterator<Item = &'w str>) -> Self {
        let words: Vec<&str> = words.into_iter().collect();
        match did_you_mean(wanted, words.iter().copied()) {
            Some(near) => self.help(format!("did you mean `{near}`?")),
            None if words.is_empty() => self.help("there are none here"),
            None => self.help(format!("possible here: {}", words.join(", "))),
        }
    }

    /// Says at which port.
    pub(crate) fn port(self, port: &str) -> Self {
        self.0.place.port = Some(port.to_owned());
        self
    }

    /// Suggests a word, if one is near.
    pub(crate) fn suggest(self, word: Option<&str>) -> Self {
        match word {
            Some(word) => self.help(format!("did you mean `{word}`?")),
            None => self,
        }
    }
}

/// A part of a text and where it starts there; parts of it know where they are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece<'a> {
    /// The part.
    pub(crate) text: &'a str,
    /// Byte offset of its start.
    pub(crate) at: usize,
}

impl<'a> Piece<'a> {
    pub(crate) fn new(text: &'a str, at: usize) -> Self {
        Self { text, at }
    }

    pub(crate) fn range(self) -> Range<usize> {
        self.at..self.at + self.text.len()
    }

    /// Bytes `range` of it.
    pub(crate) fn slice(self, range: Range<usize>) -> Self {
        Self { at: self.at + range.start, text: &self.text[range] }
    }

    /// Without white space around it.
    pub(crate) fn trim(self) -> Self {
        let lead = self.text.len() - self.text.trim_start().len();
        Self { text: self.text.trim(), at: self.at + lead }
    }

    /// The trimmed parts between `separator`s that stand outside parentheses.
    pub(crate) fn split(self, separator: char) -> Vec<Self> {
        let (mut parts, mut depth, mut start) = (Vec::new(), 0i32, 0);
        for (i, c) in self.text.char_indices() {
            match c {
                '(' => depth += 1,
                ')' => depth -= 1,
                c if c == separator && depth <= 0 => {
                    parts.push(self.slice(start..i).trim());
                    start = i + c.len_utf8();
                }
                _ => {}
            }
        }
        parts.push(self.slice(start..self.text.len()).trim());
        parts
    }

    /// What stands before and after the first `separator`, trimmed.
    pub(crate) fn split_once(self, separator: &str) -> Option<(Self, Self)> {
        let i = self.text.find(separator)?;
        Some((self.slice(0..i).trim(), self.slice(i + separator.len()..self.text.len()).trim()))
    }

    /// The words of it.
    pub(crate) fn words(self) -> Vec<Self> {
        let (mut words, mut start) = (Vec::new(), None);
        for (i, c) in self.text.char_indices().chain([(self.text.len(), ' ')]) {
            match (c.is_whitespace(), start) {
                (true, Some(s)) => {
                    words.push(self.slice(s..i));
                    start = None;
                }
                (false, None) => start = Some(i),
                _ => {}
            }
        }
        words
    }
}

/// The pieces of a text that are its lines, without the line ends.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = Piece<'_>> {
    let mut at = 0;
    text.split_inclusive('\n').map(move |line| {
        let piece = Piece::new(line.trim_end_matches(['\n', '\r']), at);
        at += line.len();
        piece
    })
}
