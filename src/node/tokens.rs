//! WGSL words: just enough lexing to split a file into its declarations and to rename what they mention.

use std::ops::Range;
use std::sync::OnceLock;

use crate::hash::HashSet;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// A name or keyword.
    Word,
    /// A number with its suffix.
    Number,
    /// One byte of punctuation.
    Punctuation(u8),
}

/// A token and where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    /// What it is.
    pub kind: TokenKind,
    /// Bytes of the text.
    pub range: Range<usize>,
}

impl Token {
    /// Whether it is this byte of punctuation.
    pub fn is(&self, byte: u8) -> bool {
        self.kind == TokenKind::Punctuation(byte)
    }

    /// Its text.
    pub fn text<'a>(&self, text: &'a str) -> &'a str {
        &text[self.range.clone()]
    }

    /// Whether it is this word.
    pub fn is_word(&self, text: &str, word: &str) -> bool {
        self.kind == TokenKind::Word && self.text(text) == word
    }
}

/// The tokens of a text, without comments and white space. An unclosed block comment runs to the end.
pub fn tokenize(text: &str) -> Vec<Token> {
    let bytes = text.as_bytes();
    let mut tokens = Vec::with_capacity(text.len() / 4);
    let mut at = 0;
    while at < bytes.len() {
        let start = at;
        match bytes[at] {
            b'/' if bytes.get(at + 1) == Some(&b'/') => at = line_end(bytes, at),
            b'/' if bytes.get(at + 1) == Some(&b'*') => at = comment_end(bytes, at),
            b if b.is_ascii_whitespace() => at += 1,
            b if b.is_ascii_digit() || (b == b'.' && bytes.get(at + 1).is_some_and(u8::is_ascii_digit)) => {
                at = number_end(bytes, at);
                tokens.push(Token { kind: TokenKind::Number, range: start..at });
            }
            b if is_word(b) => {
                while at < bytes.len() && is_word(bytes[at]) {
                    at += 1;
                }
                tokens.push(Token { kind: TokenKind::Word, range: start..at });
            }
            b => {
                at += 1;
                tokens.push(Token { kind: TokenKind::Punctuation(b), range: start..at });
            }
        }
    }
    tokens
}

/// Bytes beyond ASCII count as letters: WGSL names may hold them, and no multi-byte character is ever cut.
fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte >= 0x80
}

fn line_end(bytes: &[u8], at: usize) -> usize {
    bytes[at..].iter().position(|&b| b == b'\n').map_or(bytes.len(), |n| at + n)
}

/// Block comments nest in WGSL.
fn comment_end(bytes: &[u8], mut at: usize) -> usize {
    let mut depth = 0usize;
    while at < bytes.len() {
        match (bytes[at], bytes.get(at + 1)) {
            (b'/', Some(b'*')) => {
                depth += 1;
                at += 2;
            }
            (b'*', Some(b'/')) => {
                depth -= 1;
                at += 2;
                if depth == 0 {
                    return at;
                }
            }
            _ => at += 1,
        }
    }
    bytes.len()
}

fn number_end(bytes: &[u8], mut at: usize) -> usize {
    let hex = bytes[at] == b'0' && matches!(bytes.get(at + 1), Some(b'x' | b'X'));
    while at < bytes.len() {
        let sign = matches!(bytes[at], b'+' | b'-')
            && (matches!(bytes[at - 1], b'p' | b'P') || (!hex && matches!(bytes[at - 1], b'e' | b'E')));
        if !(bytes[at].is_ascii_alphanumeric() || bytes[at] == b'.' || (sign && at > 0)) {
            break;
        }
        at += 1;
    }
    at
}

/// Whether `name` is a WGSL identifier of ASCII letters that user code may declare, reserved words aside.
pub fn is_identifier(name: &str) -> bool {
    let mut bytes = name.bytes();
    bytes.next().is_some_and(|b| b.is_ascii_alphabetic() || b == b'_')
        && bytes.all(|b| b.is_ascii_alphanumeric() || b == b'_')
        && name != "_"
        && !name.starts_with("__")
}

/// Whether WGSL keeps the word for itself.
pub fn is_reserved(name: &str) -> bool {
    static RESERVED: OnceLock<HashSet<&str>> = OnceLock::new();
    RESERVED.get_or_init(|| naga::keywords::wgsl::RESERVED.iter().copied().collect()).contains(name)
}

/// Positions of the words that name module-scope things or locals: not attributes and their arguments that are
/// no expressions, not members after a dot, not the member names of a struct declaration.
fn names(text: &str, tokens: &[Token]) -> Vec<usize> {
    let mut found = Vec::new();
    let (mut braces, mut in_struct) = (0usize, false);
    for (i, token) in tokens.iter().enumerate() {
        match token.kind {
            TokenKind::Punctuation(b'{') => braces += 1,
            TokenKind::Punctuation(b'}') => {
                braces = braces.saturating_sub(1);
                in_struct &= braces > 0;
            }
            TokenKind::Word => {
                let before = i.checked_sub(1).map(|j| &tokens[j]);
                if token.is_word(text, "struct") {
                    in_struct = true;
                }
                let member = before.is_some_and(|t| t.is(b'.'));
                let attribute = before.is_some_and(|t| t.is(b'@'));
                let fixed = i >= 3
                    && before.is_some_and(|t| t.is(b'('))
                    && tokens[i - 3].is(b'@')
                    && matches!(tokens[i - 2].text(text), "builtin" | "interpolate" | "diagnostic");
                let declared = in_struct && braces == 1 && tokens.get(i + 1).is_some_and(|t| t.is(b':'));
                if !(member || attribute || fixed || declared) {
                    found.push(i);
                }
            }
            _ => {}
        }
    }
    found
}

/// The names that a text mentions, sorted, each once; keywords included.
pub fn mentions(text: &str) -> Vec<String> {
    let tokens = tokenize(text);
    let words: std::collections::BTreeSet<&str> =
        names(text, &tokens).into_iter().map(|i| tokens[i].text(text)).collect();
    words.into_iter().map(str::to_owned).collect()
}

/// The text with every name replaced for which `map` gives another. Comments, members after a dot, attributes and
/// member declarations stay as they are.
pub fn rename(text: &str, map: &dyn Fn(&str) -> Option<String>) -> String {
    let tokens = tokenize(text);
    let mut out = String::with_capacity(text.len() + 16);
    let mut copied = 0;
    for i in names(text, &tokens) {
        if let Some(new) = map(tokens[i].text(text)) {
            out.push_str(&text[copied..tokens[i].range.start]);
            out.push_str(&new);
            copied = tokens[i].range.end;
        }
    }
    out.push_str(&text[copied..]);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_nest_and_numbers_keep_their_suffix() {
        let text = "a /* b /* c */ d */ 1.5e-3f 0x1Fu .5 // e\nf";
        let words: Vec<&str> = tokenize(text).iter().map(|t| t.text(text)).collect();
        assert_eq!(words, ["a", "1.5e-3f", "0x1Fu", ".5", "f"]);
    }

    #[test]
    fn subtraction_is_no_exponent() {
        let text = "0x1e-2 3-4 p-1";
        let words: Vec<&str> = tokenize(text).iter().map(|t| t.text(text)).collect();
        assert_eq!(words, ["0x1e", "-", "2", "3", "-", "4", "p", "-", "1"]);
    }

    #[test]
    fn unclosed_comment_ends_the_text() {
        assert_eq!(tokenize("a /* b /* c */").len(), 1);
        assert_eq!(tokenize("/").len(), 1);
    }

    #[test]
    fn rename_leaves_members_comments_and_attributes() {
        let text = "struct S { T: T, @builtin(T) u: f32 } // T\nfn T(s: S) -> T { return s.T + T(1); }";
        let renamed = rename(text, &|w| (w == "T").then(|| "vec3f".into()));
        assert_eq!(
            renamed,
            "struct S { T: vec3f, @builtin(T) u: f32 } // T\nfn vec3f(s: S) -> vec3f { return s.T + vec3f(1); }"
        );
    }

    #[test]
    fn mentions_are_sorted_and_unique() {
        assert_eq!(mentions("b(a.c, b) é"), ["a", "b", "é"]);
    }

    #[test]
    fn identifiers() {
        assert!(is_identifier("a_1") && !is_identifier("1a") && !is_identifier("__a") && !is_identifier("_"));
        assert!(is_reserved("static") && !is_reserved("albedo"));
    }
}
