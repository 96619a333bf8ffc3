//! The words of RON: blanks and comments, strings, characters, numbers, identifiers.

use std::ops::Range;

use super::read::{Comment, Mistake, Reader};
use super::{MAX_VALUES, Tree};

/// A mistake that leaves nothing to go on with: the rest of the text was swallowed, or a limit is passed.
pub(super) fn fatal(code: &'static str, message: impl Into<String>, at: Range<usize>) -> Mistake {
    Mistake { code, message: message.into(), at, fatal: true }
}

impl Reader<'_> {
    pub(super) fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    pub(super) fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    pub(super) fn eat(&mut self, word: &str) -> bool {
        let found = self.rest().starts_with(word);
        if found {
            self.at += word.len();
        }
        found
    }

    /// Steps over blanks and comments, and keeps the comments.
    pub(super) fn blank(&mut self) -> Result<(), Mistake> {
        loop {
            let rest = self.rest();
            // The most common end of a blank, before looking closer.
            if rest.starts_with(|c: char| c.is_ascii_graphic() && c != '/') {
                return Ok(());
            }
            self.at += rest.len() - rest.trim_start().len();
            let start = self.at;
            let Some(block) = self.comment()? else {
                return Ok(());
            };
            self.comments.push(Comment { span: start..self.at, block });
            if self.comments.len() > MAX_VALUES {
                return Err(fatal("ST0005", format!("more than {MAX_VALUES} comments"), start..self.at));
            }
        }
    }

    /// Steps over one comment, if one starts here; says whether it was a block.
    fn comment(&mut self) -> Result<Option<bool>, Mistake> {
        let start = self.at;
        if self.eat("//") {
            self.at += self.rest().find('\n').unwrap_or(self.rest().len());
            return Ok(Some(false));
        }
        if !self.eat("/*") {
            return Ok(None);
        }
        let mut open = 1_usize;
        while open > 0 {
            let Some(next) = self.rest().find(['*', '/']) else {
                self.at = self.text.len();
                return Err(fatal("ST0002", "this block comment is not closed by `*/`", start..start + 2));
            };
            self.at += next;
            if self.eat("*/") {
                open -= 1;
            } else if self.eat("/*") {
                open += 1;
            } else {
                self.at += 1;
            }
        }
        Ok(Some(true))
    }

    /// A plain or raw identifier, if one starts here.
    pub(super) fn identifier(&mut self) -> Option<String> {
        self.word().map(|word| self.text[word].to_string())
    }

    /// The bytes of an identifier, if one starts here.
    pub(super) fn word(&mut self) -> Option<Range<usize>> {
        let raw = self.rest().starts_with("r#") && !self.rest()[2..].starts_with(['"', '#']);
        let body = if raw { &self.rest()[2..] } else { self.rest() };
        let inside = |c: char| c.is_alphanumeric() || c == '_' || (raw && matches!(c, '.' | '+' | '-'));
        let end = body.find(|c| !inside(c)).unwrap_or(body.len());
        if end == 0 || (!raw && body.starts_with(char::is_numeric)) {
            return None;
        }
        let start = self.at + if raw { 2 } else { 0 };
        self.at = start + end;
        Some(start..self.at)
    }

    /// A number, if one starts here. Only its extent is found; its value is read by whoever needs it.
    pub(super) fn number(&mut self) -> Option<Tree> {
        let rest = self.rest();
        let signed = rest.strip_prefix(['+', '-']);
        let body = signed.unwrap_or(rest);
        let named = ["inf", "NaN"].into_iter().find(|word| {
            let after = body.strip_prefix(word);
            after.is_some_and(|a| !a.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
        });
        let starts = body.starts_with(|c: char| c.is_ascii_digit())
            || (body.starts_with('.') && body[1..].starts_with(|c: char| c.is_ascii_digit()));
        if named.is_none() && !starts {
            return None;
        }
        let hexadecimal = body.starts_with("0x");
        let mut previous = '0';
        let end = body.find(|c: char| {
            let exponent = matches!(c, '+' | '-') && matches!(previous, 'e' | 'E') && !hexadecimal;
            previous = c;
            !(c.is_ascii_alphanumeric() || matches!(c, '_' | '.') || exponent)
        });
        let length = named.map_or(end.unwrap_or(body.len()), str::len) + rest.len() - body.len();
        let written = rest[..length].to_string();
        self.at += length;
        Some(Tree::Number(written))
    }

    /// A raw string `r"..."`, `r#"..."#`, if one starts here.
    pub(super) fn raw_string(&mut self) -> Result<Option<Tree>, Mistake> {
        let start = self.at;
        let Some(after) = self.rest().strip_prefix('r') else {
            return Ok(None);
        };
        let hashes = after.len() - after.trim_start_matches('#').len();
        let Some(body) = after[hashes..].strip_prefix('"') else {
            return Ok(None);
        };
        let close = format!("\"{}", "#".repeat(hashes));
        let Some(end) = body.find(&close) else {
            self.at = self.text.len();
            return Err(fatal("ST0002", format!("this raw string is not closed by `{close}`"), start..start + 1));
        };
        let text = body[..end].to_string();
        self.at += 1 + hashes + 1 + end + close.len();
        Ok(Some(Tree::Text(text)))
    }

    /// A string; the cursor stands on its opening quote.
    pub(super) fn string(&mut self) -> Result<Tree, Mistake> {
        let start = self.at;
        self.at += 1;
        let mut text = String::new();
        loop {
            let Some(plain) = self.rest().bytes().position(|b| b == b'"' || b == b'\\') else {
                self.at = self.text.len();
                return Err(fatal("ST0002", "this string is not closed by `\"`", start..start + 1));
            };
            text.push_str(&self.text[self.at..self.at + plain]);
            self.at += plain;
            if self.eat("\"") {
                return Ok(Tree::Text(text));
            }
            if self.eat("\\\n") || self.eat("\\\r\n") {
                let rest = self.rest();
                self.at += rest.len() - rest.trim_start().len();
            } else if let Some(c) = self.escape() {
                text.push(c);
            }
        }
    }

    /// A character; the cursor stands on its opening quote.
    pub(super) fn character(&mut self) -> Result<Tree, Mistake> {
        let start = self.at;
        self.at += 1;
        let c = match self.peek() {
            Some('\\') => self.escape().unwrap_or(char::REPLACEMENT_CHARACTER),
            Some(c) if c != '\'' => {
                self.at += c.len_utf8();
                c
            }
            _ => return Err(self.mistake("ST0001", "a character must stand between the quotes")),
        };
        if self.eat("'") {
            return Ok(Tree::Char(c));
        }
        Err(Mistake { at: start..self.at, ..self.mistake("ST0002", "this character is not closed by `'`") })
    }

    /// One escape; the cursor stands on its backslash. Reports an escape that is none, and gives nothing for it.
    fn escape(&mut self) -> Option<char> {
        let start = self.at;
        self.at += 1;
        let c = self.peek();
        self.at += c.map_or(0, char::len_utf8);
        let read = match c {
            Some(c @ ('\\' | '"' | '\'')) => Some(c),
            Some('n') => Some('\n'),
            Some('r') => Some('\r'),
            Some('t') => Some('\t'),
            Some('0') => Some('\0'),
            Some('x') => self.hexadecimal(2),
            Some('u') if self.eat("{") => {
                let digits = self.rest().find('}').filter(|&n| (1..=6).contains(&n));
                let read = digits.and_then(|n| self.hexadecimal(n));
                if read.is_some() {
                    self.at += 1;
                }
                read
            }
            _ => None,
        };
        if read.is_none() {
            self.report(Mistake {
                code: "ST0003",
                message: format!("`{}` is not an escape", &self.text[start..self.at]),
                at: start..self.at,
                fatal: false,
            });
        }
        read
    }

    fn hexadecimal(&mut self, digits: usize) -> Option<char> {
        let written = self.rest().get(..digits)?;
        if !written.bytes().all(|b| b.is_ascii_hexdigit()) {
            return None;
        }
        let c = char::from_u32(u32::from_str_radix(written, 16).ok()?)?;
        self.at += digits;
        Some(c)
    }
}
