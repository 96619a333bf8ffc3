//! What readings of the parts of a study share: fields that are told of what is wrong with them, and go on.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::select::Filter;
use crate::diagnostic::{Diagnostic, SourceText, did_you_mean};
use crate::ron::{self, Field, Node, Tree, expect_fields, field, unknown_fields};

/// A reader of fields.
pub(super) struct Reader<'a> {
    pub(super) source: &'a Arc<SourceText>,
    pub(super) found: &'a mut Vec<Diagnostic>,
}

impl Reader<'_> {
    /// An error at a value.
    pub(super) fn error(
        &mut self,
        code: &'static str,
        message: impl Into<String>,
        node: &Node,
        help: impl Into<String>,
    ) {
        self.found.push(Diagnostic::error(code, message, node.place(self.source)).help(help));
    }

    /// The value of a reading, or nothing and its complaint.
    pub(super) fn take<T>(&mut self, reading: ron::Reading<T>) -> Option<T> {
        reading.map_err(|diagnostic| self.found.push(*diagnostic)).ok()
    }

    /// The fields of a struct.
    pub(super) fn fields<'n>(&mut self, node: &'n Node, what: &str, known: &[&str]) -> Option<&'n [Field]> {
        let fields = self.take(expect_fields(node, self.source, what))?;
        self.found.extend(unknown_fields(fields, known, self.source));
        Some(fields)
    }

    /// A field that is there.
    pub(super) fn get<'n, T>(
        &mut self,
        fields: &'n [Field],
        name: &str,
        read: impl FnOnce(&'n Node, &Arc<SourceText>) -> ron::Reading<T>,
    ) -> Option<T> {
        let node = field(fields, name)?;
        let reading = read(node, self.source);
        self.take(reading)
    }

    /// A text; none where it is not given.
    pub(super) fn text(&mut self, fields: &[Field], name: &str) -> Option<String> {
        self.get(fields, name, |node, source| node.as_str(source).map(str::to_owned))
    }

    /// A list of texts, with where they stand.
    pub(super) fn texts<'n>(&mut self, fields: &'n [Field], name: &str) -> Vec<(String, &'n Node)> {
        let items = self.get(fields, name, Node::as_list).unwrap_or_default();
        let texts = items.iter().filter_map(|item| Some((self.take(item.as_str(self.source))?.to_owned(), item)));
        texts.collect()
    }

    /// A number within limits; none where it is not given.
    pub(super) fn number(&mut self, fields: &[Field], name: &str, limits: (f64, f64)) -> Option<f64> {
        let number = self.get(fields, name, Node::as_f64)?;
        if number < limits.0 || number > limits.1 {
            let message = format!("`{name}` is {number}");
            let help = format!("it lies from {} to {}", limits.0, limits.1);
            if let Some(node) = field(fields, name) {
                self.error("ST0653", message, node, help);
            }
            return None;
        }
        Some(number)
    }

    /// One of a few words; a complaint with this code where it is none of them.
    pub(super) fn word<T: Copy>(
        &mut self,
        fields: &[Field],
        name: &str,
        (code, what): (&'static str, &str),
        words: &[(&str, T)],
    ) -> Option<T> {
        let word = self.text(fields, name)?;
        let found = words.iter().find(|(w, _)| *w == word).map(|(_, value)| *value);
        if let (None, Some(node)) = (found, field(fields, name)) {
            let all: Vec<&str> = words.iter().map(|(w, _)| *w).collect();
            let help = match did_you_mean(&word, all.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("one of {}", all.join(", ")),
            };
            self.error(code, format!("there is no {what} `{word}`"), node, help);
        }
        found
    }

    /// The fields `class`, `frame` and `settings`.
    pub(super) fn filter(&mut self, fields: &[Field]) -> Filter {
        let frame = self.get(fields, "frame", Node::as_array::<2>);
        let mut settings = BTreeMap::new();
        for (key, value) in self.get(fields, "settings", Node::as_map).unwrap_or_default() {
            let text = match &value.value {
                Tree::Number(written) => Some(written.clone()),
                Tree::Bool(b) => Some(b.to_string()),
                _ => self.take(value.as_str(self.source)).map(str::to_owned),
            };
            if let (Some(key), Some(text)) = (self.take(key.as_str(self.source)), text) {
                settings.insert(key.to_owned(), text);
            }
        }
        let frame = frame.and_then(|frame| {
            let whole = |x: f64| (1.0..=16_384.0).contains(&x) && x.fract() == 0.0;
            if !frame.into_iter().all(whole) {
                if let Some(node) = field(fields, "frame") {
                    let help = "write columns and rows, from 1 to 16384, as `(1024, 768)`";
                    self.error("ST0653", "the frame has no such size", node, help);
                }
                return None;
            }
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole and bounded")]
            Some((frame[0] as u32, frame[1] as u32))
        });
        Filter { class: self.text(fields, "class"), frame, settings }
    }
}
