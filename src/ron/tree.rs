//! The tree: values with their byte spans, and readings of them that explain themselves when they fail.

use std::ops::Range;
use std::sync::Arc;

use crate::diagnostic::{Diagnostic, Place, SourceText, Span};

/// A value and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Bytes of the text that the value covers; `0..0` for a value that was not read from a text.
    pub span: Range<usize>,
    /// The value.
    pub value: Tree,
}

/// A RON value.
#[derive(Clone, Debug, PartialEq)]
pub enum Tree {
    /// `true` or `false`.
    Bool(bool),
    /// A number as it was written, so that nothing is lost before somebody asks for its value.
    Number(String),
    /// A character.
    Char(char),
    /// A string, unescaped.
    Text(String),
    /// `None` or `Some(value)`.
    Option(Option<Box<Node>>),
    /// `[a, b]`
    List(Vec<Node>),
    /// `{key: value}` in the order of the text.
    Map(Vec<(Node, Node)>),
    /// `(a, b)` or `Name(a, b)`; the unit `()` is the empty tuple.
    Tuple(Option<String>, Vec<Node>),
    /// `(field: value)` or `Name(field: value)`, in the order of the text.
    Struct(Option<String>, Vec<Field>),
    /// A bare word: a unit struct or variant.
    Ident(String),
}

/// A field of a struct.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub name_span: Range<usize>,
    /// Its value.
    pub value: Node,
}

impl Tree {
    /// What it is, for messages: `a number`, `the struct Graph(...)`.
    pub fn describe(&self) -> String {
        match self {
            Self::Bool(b) => format!("`{b}`"),
            Self::Number(n) => format!("the number `{n}`"),
            Self::Char(_) => "a character".into(),
            Self::Text(_) => "a text".into(),
            Self::Option(None) => "`None`".into(),
            Self::Option(Some(_)) => "`Some(...)`".into(),
            Self::List(_) => "a list `[...]`".into(),
            Self::Map(_) => "a map `{...}`".into(),
            Self::Tuple(None, items) if items.is_empty() => "`()`".into(),
            Self::Tuple(None, items) => format!("a tuple of {}", items.len()),
            Self::Tuple(Some(name), _) | Self::Struct(Some(name), _) => format!("`{name}(...)`"),
            Self::Struct(None, _) => "a struct `(field: ...)`".into(),
            Self::Ident(word) => format!("the bare word `{word}`"),
        }
    }
}

/// A reading of a value, or why it is not that. Boxed because mistakes are rare and diagnostics are large.
pub type Reading<T> = Result<T, Box<Diagnostic>>;

impl Node {
    /// A value that stands in no text.
    pub fn new(value: Tree) -> Self {
        Self { span: 0..0, value }
    }

    /// A text that stands in no text.
    pub fn text(text: impl Into<String>) -> Self {
        Self::new(Tree::Text(text.into()))
    }

    /// Where it stands in `source`.
    pub fn place(&self, source: &Arc<SourceText>) -> Place {
        Place::span(Span::new(source, self.span.clone()))
    }

    /// The complaint that `what` was needed here.
    pub fn expected(&self, source: &Arc<SourceText>, what: &str) -> Box<Diagnostic> {
        let message = format!("expected {what}, found {}", self.value.describe());
        let help = match &self.value {
            Tree::Ident(word) | Tree::Number(word) if what.contains("text") => format!("put it in quotes: \"{word}\""),
            _ => format!("write {what}"),
        };
        Box::new(Diagnostic::error("ST0008", message, self.place(source)).help(help))
    }

    /// As `true` or `false`.
    pub fn as_bool(&self, source: &Arc<SourceText>) -> Reading<bool> {
        match self.value {
            Tree::Bool(b) => Ok(b),
            _ => Err(self.expected(source, "`true` or `false`")),
        }
    }

    /// As a text.
    pub fn as_str(&self, source: &Arc<SourceText>) -> Reading<&str> {
        match &self.value {
            Tree::Text(text) => Ok(text),
            _ => Err(self.expected(source, "a text in quotes")),
        }
    }

    /// As a finite number.
    pub fn as_f64(&self, source: &Arc<SourceText>) -> Reading<f64> {
        let Tree::Number(written) = &self.value else {
            return Err(self.expected(source, "a number"));
        };
        let wrong = |message: String| Box::new(Diagnostic::error("ST0009", message, self.place(source)));
        match parse_number(written) {
            Some(x) if x.is_finite() => Ok(x),
            Some(_) => Err(wrong(format!("`{written}` is not a finite number")).help_finite()),
            None => Err(wrong(format!("`{written}` is not a number")).help_finite()),
        }
    }

    /// As a whole number from 0 to `max`.
    pub fn as_u64(&self, source: &Arc<SourceText>, max: u64) -> Reading<u64> {
        let x = self.as_f64(source)?;
        // 2^53: beyond it neighbouring whole numbers read as the same f64.
        if x.fract() != 0.0 || x < 0.0 || x > max.min(1 << 53) as f64 {
            let message = format!("expected a whole number from 0 to {max}, found {}", self.value.describe());
            let error = Diagnostic::error("ST0009", message, self.place(source));
            return Err(Box::new(error.help("write it without a point, sign or exponent")));
        }
        Ok(x as u64)
    }

    /// As finite numbers: one number, a tuple or a list of them.
    pub fn as_numbers(&self, source: &Arc<SourceText>) -> Reading<Vec<f64>> {
        match &self.value {
            Tree::Number(_) => Ok(vec![self.as_f64(source)?]),
            Tree::Tuple(None, items) | Tree::List(items) if !items.is_empty() => {
                items.iter().map(|item| item.as_f64(source)).collect()
            }
            _ => Err(self.expected(source, "a number or a tuple of numbers")),
        }
    }

    /// As exactly `N` finite numbers.
    pub fn as_array<const N: usize>(&self, source: &Arc<SourceText>) -> Reading<[f64; N]> {
        let numbers = self.as_numbers(source)?;
        numbers.try_into().map_err(|_| self.expected(source, &format!("{N} numbers `(...)`")))
    }

    /// As a list.
    pub fn as_list(&self, source: &Arc<SourceText>) -> Reading<&[Node]> {
        match &self.value {
            Tree::List(items) => Ok(items),
            _ => Err(self.expected(source, "a list `[...]`")),
        }
    }

    /// As a map.
    pub fn as_map(&self, source: &Arc<SourceText>) -> Reading<&[(Node, Node)]> {
        match &self.value {
            Tree::Map(entries) => Ok(entries),
            _ => Err(self.expected(source, "a map `{...}`")),
        }
    }

    /// Byte at which the content of a text begins, after its opening quote. Every byte of a raw string's content
    /// stands at this start plus its own index; in an escaped string only those before the first escape do.
    pub fn content_start(&self, source: &SourceText) -> usize {
        let written = source.text.get(self.span.clone()).unwrap_or_default();
        let opening = written.find('"').map_or(0, |quote| quote + 1);
        self.span.start + opening
    }
}

trait HelpFinite {
    fn help_finite(self) -> Self;
}

impl HelpFinite for Box<Diagnostic> {
    fn help_finite(mut self) -> Self {
        self.help = Some("write a finite decimal number".into());
        self
    }
}

/// The value of a number as RON writes it: decimal, `0x`, `0o`, `0b`, underscores, `inf`, `NaN`.
pub(crate) fn parse_number(written: &str) -> Option<f64> {
    let digits: String = written.chars().filter(|&c| c != '_').collect();
    let (sign, bare) = match digits.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, digits.strip_prefix('+').unwrap_or(&digits)),
    };
    match bare {
        "inf" => return Some(sign * f64::INFINITY),
        "NaN" => return Some(f64::NAN),
        _ => {}
    }
    for (prefix, radix) in [("0x", 16), ("0o", 8), ("0b", 2)] {
        if let Some(rest) = bare.strip_prefix(prefix) {
            return u64::from_str_radix(rest, radix).ok().map(|n| sign * n as f64);
        }
    }
    let plain = |b: u8| b.is_ascii_digit() || matches!(b, b'.' | b'e' | b'E' | b'+' | b'-');
    if !bare.bytes().all(plain) {
        return None;
    }
    bare.parse::<f64>().ok().map(|x| sign * x)
}
