//! From text to tree. Goes on after a mistake at the next comma or closing bracket, so that one reading tells of all.

use std::ops::Range;
use std::sync::Arc;

use crate::hash::HashSet;

use super::scan::fatal;
use super::{Field, MAX_BYTES, MAX_DEPTH, MAX_ERRORS, MAX_VALUES, Node, Tree};
use crate::diagnostic::{Diagnostic, Place, SourceText, Span};

/// A comment and where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comment {
    /// Bytes, with the comment's own marks.
    pub span: Range<usize>,
    /// Whether it is `/* ... */`.
    pub block: bool,
}

/// Fields of a struct up to which no set of their names is kept.
const FEW: usize = 16;

/// A text that was read.
#[derive(Clone, Debug)]
pub struct Document {
    /// Its one value.
    pub root: Node,
    /// Its comments, in order.
    pub comments: Vec<Comment>,
    /// Extensions named by `#![enable(...)]`; they change nothing here.
    pub extensions: Vec<String>,
}

pub(super) struct Mistake {
    pub(super) code: &'static str,
    pub(super) message: String,
    pub(super) at: Range<usize>,
    pub(super) fatal: bool,
}

pub(super) struct Reader<'a> {
    source: &'a Arc<SourceText>,
    pub(super) text: &'a str,
    pub(super) at: usize,
    depth: usize,
    values: usize,
    pub(super) comments: Vec<Comment>,
    diagnostics: Vec<Diagnostic>,
}

/// Reads a text. With mistakes, the tree is what could be made out around them; without a tree, nothing could.
pub fn read(source: &Arc<SourceText>) -> (Option<Document>, Vec<Diagnostic>) {
    if source.text.len() > MAX_BYTES {
        let message = format!("the file has {} bytes; at most {MAX_BYTES} are read", source.text.len());
        let error = Diagnostic::error("ST0005", message, Place::file(&source.name));
        return (None, vec![error.help(help("ST0005", ""))]);
    }
    let mut reader = Reader {
        source,
        text: &source.text,
        at: 0,
        depth: 0,
        values: 0,
        comments: Vec::new(),
        diagnostics: Vec::new(),
    };
    reader.eat("\u{feff}");
    let read = reader.document();
    let document = match read {
        Ok((root, extensions)) => Some(Document { root, comments: reader.comments, extensions }),
        Err(mistake) => {
            // Fatal mistakes must be told even when the list is full.
            reader.diagnostics.truncate(MAX_ERRORS);
            reader.diagnostics.push(diagnose(source, mistake));
            None
        }
    };
    (document, reader.diagnostics)
}

fn diagnose(source: &Arc<SourceText>, mistake: Mistake) -> Diagnostic {
    let help = help(mistake.code, &mistake.message);
    Diagnostic::error(mistake.code, mistake.message, Place::span(Span::new(source, mistake.at))).help(help)
}

/// What to do about a mistake.
fn help(code: &str, message: &str) -> &'static str {
    match code {
        "ST0001" if message.starts_with("expected `,`") => "is a comma missing before this?",
        "ST0001" if message.starts_with("expected `:`") => "write `:` between a name and its value",
        "ST0001" if message.ends_with("closes this") => "add it where it belongs; perhaps the end of the file was lost",
        "ST0001" if message.contains("found") => "brackets close in the opposite order of their opening",
        "ST0001" if message.ends_with("empty") => "a file holds one value, such as `Graph(...)`",
        "ST0001" => "a value is a number, a text in quotes, `true`, `false`, or stands in (...), [...] or {...}",
        "ST0002" => "close it where it ends; perhaps the end of the file was lost",
        "ST0003" => "write a backslash as `\\\\`, or a raw string: `r\"C:\\path\"`",
        "ST0004" => "remove brackets that hold nothing but other brackets",
        "ST0005" => "split the file into several",
        "ST0006" => "remove one of them",
        "ST0007" => "remove what follows, or a closing bracket too many before it",
        _ => "correct these first",
    }
}

impl Reader<'_> {
    pub(super) fn mistake(&self, code: &'static str, message: impl Into<String>) -> Mistake {
        let length = self.peek().map_or(0, char::len_utf8);
        Mistake { code, message: message.into(), at: self.at..self.at + length, fatal: false }
    }

    /// Whether as many mistakes are known as are told of.
    pub(super) fn is_full(&self) -> bool {
        self.diagnostics.len() >= MAX_ERRORS
    }

    pub(super) fn report(&mut self, mistake: Mistake) {
        match self.diagnostics.len() {
            n if n < MAX_ERRORS => self.diagnostics.push(diagnose(self.source, mistake)),
            MAX_ERRORS => {
                let message = format!("more than {MAX_ERRORS} mistakes; the rest are not listed");
                let error = Diagnostic::error("ST0012", message, Place::file(&self.source.name));
                self.diagnostics.push(error.help(help("ST0012", "")));
            }
            _ => {}
        }
    }

    fn document(&mut self) -> Result<(Node, Vec<String>), Mistake> {
        let mut extensions = Vec::new();
        self.blank()?;
        while self.eat("#!") {
            let words = self.header()?;
            extensions.extend(words);
            self.blank()?;
        }
        let root = self.value()?;
        self.blank()?;
        if self.at < self.text.len() {
            let mistake = self.mistake("ST0007", "the file holds one value, and that has ended before here");
            self.report(mistake);
        }
        Ok((root, extensions))
    }

    /// `[enable(a, b)]`, after `#!`.
    fn header(&mut self) -> Result<Vec<String>, Mistake> {
        let mut words = Vec::new();
        for mark in ["[", "enable", "("] {
            self.blank()?;
            if !self.eat(mark) {
                return Err(self.mistake("ST0001", "expected `#![enable(...)]`"));
            }
        }
        loop {
            self.blank()?;
            words.extend(self.identifier());
            self.blank()?;
            if !self.eat(",") {
                break;
            }
        }
        for mark in [")", "]"] {
            self.blank()?;
            if !self.eat(mark) {
                return Err(self.mistake("ST0001", format!("expected `{mark}` to close the header")));
            }
        }
        Ok(words)
    }

    /// One value; the cursor stands on its first character.
    fn value(&mut self) -> Result<Node, Mistake> {
        let start = self.at;
        self.values += 1;
        if self.values > MAX_VALUES {
            return Err(fatal("ST0005", format!("the file holds more than {MAX_VALUES} values"), start..start + 1));
        }
        if self.depth >= MAX_DEPTH {
            return Err(fatal("ST0004", format!("nested more than {MAX_DEPTH} levels deep"), start..start + 1));
        }
        self.depth += 1;
        let value = self.tree();
        self.depth -= 1;
        Ok(Node { value: value?, span: start..self.at })
    }

    fn tree(&mut self) -> Result<Tree, Mistake> {
        match self.peek() {
            None if self.text.trim().is_empty() => return Err(self.mistake("ST0001", "the file is empty")),
            None => return Err(self.mistake("ST0001", "the file ends where a value must stand")),
            Some('"') => return self.string(),
            Some('\'') => return self.character(),
            Some('[') => {
                self.at += 1;
                return Ok(Tree::List(self.items(']')?));
            }
            Some('{') => return self.map(),
            Some('(') => return self.group(None),
            _ => {}
        }
        if let Some(number) = self.number() {
            return Ok(number);
        }
        if let Some(text) = self.raw_string()? {
            return Ok(text);
        }
        let Some(word) = self.identifier() else {
            return Err(self.mistake("ST0001", "expected a value"));
        };
        let after_word = self.at;
        let comments = self.comments.len();
        self.blank()?;
        if self.rest().starts_with('(') {
            return self.group(Some(word));
        }
        self.at = after_word;
        self.comments.truncate(comments);
        Ok(match word.as_str() {
            "true" => Tree::Bool(true),
            "false" => Tree::Bool(false),
            "None" => Tree::Option(None),
            _ => Tree::Ident(word),
        })
    }

    /// `(...)`: a tuple, a struct, or the inside of `Some`.
    fn group(&mut self, name: Option<String>) -> Result<Tree, Mistake> {
        self.at += 1;
        self.blank()?;
        let first = self.at;
        let comments = self.comments.len();
        let is_struct = self.word().is_some() && {
            self.blank()?;
            self.rest().starts_with(':')
        };
        self.at = first;
        self.comments.truncate(comments);
        if is_struct {
            return Ok(Tree::Struct(name, self.fields()?));
        }
        let mut items = self.items(')')?;
        if name.as_deref() == Some("Some") && items.len() == 1 {
            return Ok(Tree::Option(items.pop().map(Box::new)));
        }
        Ok(Tree::Tuple(name, items))
    }

    fn items(&mut self, close: char) -> Result<Vec<Node>, Mistake> {
        let mut items = Vec::new();
        self.series(close, |reader| {
            items.push(reader.value()?);
            Ok(())
        })?;
        Ok(items)
    }

    fn fields(&mut self) -> Result<Vec<Field>, Mistake> {
        let mut fields = Vec::new();
        // Few fields are found sooner by looking at each.
        let mut names = HashSet::default();
        self.series(')', |reader| {
            let start = reader.at;
            let Some(name) = reader.identifier() else {
                return Err(reader.mistake("ST0001", "expected a field name"));
            };
            let name_span = start..reader.at;
            reader.colon()?;
            let value = reader.value()?;
            if fields.len() == FEW {
                names.extend(fields.iter().map(|f: &Field| f.name.clone()));
            }
            let known =
                if fields.len() < FEW { fields.iter().any(|f| f.name == name) } else { !names.insert(name.clone()) };
            if !known {
                fields.push(Field { name, name_span, value });
            } else {
                reader.twice(&name, name_span);
            }
            Ok(())
        })?;
        Ok(fields)
    }

    fn map(&mut self) -> Result<Tree, Mistake> {
        self.at += 1;
        let mut entries: Vec<(Node, Node)> = Vec::new();
        let mut keys = HashSet::default();
        self.series('}', |reader| {
            let key = reader.value()?;
            reader.colon()?;
            let value = reader.value()?;
            match &key.value {
                Tree::Text(text) if !keys.insert(text.clone()) => reader.twice(text, key.span),
                _ => entries.push((key, value)),
            }
            Ok(())
        })?;
        Ok(Tree::Map(entries))
    }
}
