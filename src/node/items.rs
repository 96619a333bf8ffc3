//! Splitting WGSL into its module-scope declarations, and reading signatures.

use std::ops::Range;

use super::tokens::{Token, TokenKind, tokenize};

/// A module-scope declaration, by ranges of the text that it was found in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Declaration {
    /// `fn`, `struct`, `const`, `alias`, `override` or `var`.
    pub(crate) keyword: &'static str,
    /// Its name.
    pub(crate) name: String,
    /// Where the name stands.
    pub(crate) name_range: Range<usize>,
    /// All of it, attributes included.
    pub(crate) range: Range<usize>,
    /// Whether one of its attributes makes it an entry point.
    pub(crate) entry: bool,
}

/// A place and what is wrong there.
pub(crate) type Mistake = (Range<usize>, String);

const KEYWORDS: &[&str] = &["fn", "struct", "const", "alias", "override", "var"];

/// The declarations of `text`, in order, and what could not be read.
pub(crate) fn split(text: &str) -> (Vec<Declaration>, Vec<Mistake>) {
    let tokens = tokenize(text);
    let (mut found, mut mistakes) = (Vec::new(), Vec::new());
    let mut at = 0;
    while at < tokens.len() {
        if tokens[at].is(b';') {
            at += 1;
            continue;
        }
        match declaration(text, &tokens, at) {
            Ok((declaration, next)) => {
                found.push(declaration);
                at = next;
            }
            Err((mistake, next)) => {
                mistakes.push(mistake);
                at = next.max(at + 1);
            }
        }
    }
    (found, mistakes)
}

fn declaration(text: &str, tokens: &[Token], first: usize) -> Result<(Declaration, usize), (Mistake, usize)> {
    let start = tokens[first].range.start;
    let (mut at, mut entry) = (first, false);
    while tokens.get(at).is_some_and(|t| t.is(b'@')) {
        entry |=
            tokens.get(at + 1).is_some_and(|t| ["vertex", "fragment", "compute"].iter().any(|w| t.is_word(text, w)));
        at += 2;
        if tokens.get(at).is_some_and(|t| t.is(b'(')) {
            at = close(tokens, at).ok_or_else(|| unclosed(tokens, at))? + 1;
        }
    }
    let Some(head) = tokens.get(at) else {
        let last = tokens[tokens.len() - 1].range.clone();
        return Err(((last, "an attribute without a declaration".into()), tokens.len()));
    };
    let Some(keyword) = KEYWORDS.iter().copied().find(|k| head.is_word(text, k)) else {
        let message = format!("`{}` does not begin a declaration", head.text(text));
        return Err(((head.range.clone(), message), skip(tokens, at)));
    };
    at += 1;
    if keyword == "var" && tokens.get(at).is_some_and(|t| t.is(b'<')) {
        while at < tokens.len() && !tokens[at].is(b'>') {
            at += 1;
        }
        at += 1;
    }
    let Some(name) = tokens.get(at).filter(|t| t.kind == TokenKind::Word) else {
        return Err(((head.range.clone(), format!("`{keyword}` without a name")), skip(tokens, at)));
    };
    let braced = matches!(keyword, "fn" | "struct");
    let mut end = at + 1;
    loop {
        let Some(token) = tokens.get(end) else {
            return Err((
                (name.range.clone(), format!("the declaration of `{}` does not end", name.text(text))),
                tokens.len(),
            ));
        };
        match token.kind {
            TokenKind::Punctuation(b'{') if braced => {
                end = close(tokens, end).ok_or_else(|| unclosed(tokens, end))?;
                break;
            }
            TokenKind::Punctuation(b';') if !braced => break,
            TokenKind::Punctuation(b';' | b'}') => {
                let message = format!("`{keyword} {}` has no body", name.text(text));
                return Err(((name.range.clone(), message), end + 1));
            }
            TokenKind::Punctuation(b'(' | b'[' | b'{') => {
                end = close(tokens, end).ok_or_else(|| unclosed(tokens, end))? + 1;
            }
            _ => end += 1,
        }
    }
    let declaration = Declaration {
        keyword,
        name: name.text(text).to_owned(),
        name_range: name.range.clone(),
        range: start..tokens[end].range.end,
        entry,
    };
    Ok((declaration, end + 1))
}

fn unclosed(tokens: &[Token], at: usize) -> (Mistake, usize) {
    ((tokens[at].range.clone(), "a bracket is not closed".into()), tokens.len())
}

/// The token that closes the bracket at `open`; a closer of another sort does not count.
pub(crate) fn close(tokens: &[Token], open: usize) -> Option<usize> {
    let mut expected = Vec::new();
    for (i, token) in tokens.iter().enumerate().skip(open) {
        match token.kind {
            TokenKind::Punctuation(b'(') => expected.push(b')'),
            TokenKind::Punctuation(b'[') => expected.push(b']'),
            TokenKind::Punctuation(b'{') => expected.push(b'}'),
            TokenKind::Punctuation(b @ (b')' | b']' | b'}')) => {
                if expected.pop() != Some(b) {
                    return None;
                }
                if expected.is_empty() {
                    return Some(i);
                }
            }
            _ => {}
        }
    }
    None
}

/// Where reading goes on after something that is no declaration.
fn skip(tokens: &[Token], mut at: usize) -> usize {
    while at < tokens.len() {
        if tokens[at].is(b';') {
            return at + 1;
        }
        if tokens[at].is(b'{') {
            return close(tokens, at).map_or(tokens.len(), |c| c + 1);
        }
        at += 1;
    }
    at
}

/// A parameter or struct member: its name, where that stands, its type as written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Field {
    pub(crate) name: String,
    pub(crate) range: Range<usize>,
    pub(crate) ty: String,
}

/// What a function takes and gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Signature {
    pub(crate) parameters: Vec<Field>,
    pub(crate) result: Option<String>,
    /// The text between the braces of the body.
    pub(crate) body: Range<usize>,
}

/// Reads the signature of a function declaration of `text`.
pub(crate) fn signature(text: &str, function: &Declaration) -> Option<Signature> {
    let tokens = tokens_of(text, function);
    let name = tokens.iter().position(|t| t.range == function.name_range)?;
    let open = name + 1;
    let end = close(&tokens, open)?;
    let parameters = fields(text, &tokens[open + 1..end]);
    let brace = (end..tokens.len()).find(|&i| tokens[i].is(b'{'))?;
    let result = match tokens.get(end + 2) {
        Some(_) if tokens[end + 1].is(b'-') && tokens[end + 2].is(b'>') => {
            let ty = strip_attributes(&tokens[end + 3..brace])?;
            Some(text[ty.first()?.range.start..ty.last()?.range.end].to_owned())
        }
        _ => None,
    };
    let body = tokens[brace].range.end..tokens.last()?.range.start;
    Some(Signature { parameters, result, body })
}

/// The members of a struct declaration of `text`.
pub(crate) fn members(text: &str, declaration: &Declaration) -> Vec<Field> {
    let tokens = tokens_of(text, declaration);
    match tokens.iter().position(|t| t.is(b'{')) {
        Some(open) => fields(text, &tokens[open + 1..tokens.len() - 1]),
        None => Vec::new(),
    }
}

fn tokens_of(text: &str, declaration: &Declaration) -> Vec<Token> {
    let start = declaration.range.start;
    let mut tokens = tokenize(&text[declaration.range.clone()]);
    for token in &mut tokens {
        token.range = token.range.start + start..token.range.end + start;
    }
    tokens
}

/// `@attribute name: type` between commas outside brackets and templates.
fn fields(text: &str, tokens: &[Token]) -> Vec<Field> {
    let (mut found, mut depth, mut start) = (Vec::new(), 0i32, 0);
    for i in 0..=tokens.len() {
        match tokens.get(i).map(|t| t.kind) {
            Some(TokenKind::Punctuation(b'(' | b'[' | b'<')) => depth += 1,
            Some(TokenKind::Punctuation(b')' | b']' | b'>')) => depth -= 1,
            Some(TokenKind::Punctuation(b',')) if depth <= 0 => {
                found.extend(field(text, &tokens[start..i]));
                start = i + 1;
            }
            None => found.extend(field(text, &tokens[start..i])),
            _ => {}
        }
    }
    found
}

fn field(text: &str, tokens: &[Token]) -> Option<Field> {
    let tokens = strip_attributes(tokens)?;
    let (name, colon, ty) = (tokens.first()?, tokens.get(1)?, tokens.get(2..)?);
    (name.kind == TokenKind::Word && colon.is(b':')).then_some(())?;
    Some(Field {
        name: name.text(text).to_owned(),
        range: name.range.clone(),
        ty: text[ty.first()?.range.start..ty.last()?.range.end].to_owned(),
    })
}

fn strip_attributes(mut tokens: &[Token]) -> Option<&[Token]> {
    while tokens.first().is_some_and(|t| t.is(b'@')) {
        let arguments = tokens.get(2).is_some_and(|t| t.is(b'('));
        let end = if arguments { close(tokens, 2)? + 1 } else { 2 };
        tokens = tokens.get(end..)?;
    }
    Some(tokens)
}

/// The expression of a body that is one `return`.
pub(crate) fn returned(text: &str, body: Range<usize>) -> Option<String> {
    let text = &text[body];
    let tokens = tokenize(text);
    let (first, last) = (tokens.first()?, tokens.last()?);
    let one = first.is_word(text, "return") && tokens.iter().filter(|t| t.is(b';')).count() == 1 && last.is(b';');
    let expression = tokens.get(1..tokens.len() - 1).filter(|e| one && !e.is_empty())?;
    Some(text[expression.first()?.range.start..expression.last()?.range.end].to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "\
/// doc
const A: i32 = 5; // c
struct S { @location(0) a: f32, b: array<vec4f, 9>, };
@group(0) @binding(1) var<uniform> u: S;
alias T = f32;
@fragment fn f(@builtin(position) p: vec4f, q: mat4x4<f32>,) -> @location(0) vec4<f32> { if (A > 1) { return p; } }
fn g() { }
";

    #[test]
    fn declarations_in_order() {
        let (found, mistakes) = split(TEXT);
        assert!(mistakes.is_empty(), "{mistakes:?}");
        let names: Vec<_> = found.iter().map(|d| format!("{} {}", d.keyword, d.name)).collect();
        assert_eq!(names, ["const A", "struct S", "var u", "alias T", "fn f", "fn g"]);
        assert!(TEXT[found[2].range.clone()].starts_with("@group") && found[4].entry && !found[5].entry);
    }

    #[test]
    fn signatures_and_members() {
        let (found, _) = split(TEXT);
        let f = signature(TEXT, &found[4]).unwrap();
        assert_eq!(f.parameters[1].ty, "mat4x4<f32>");
        assert_eq!((f.parameters.len(), f.result.as_deref()), (2, Some("vec4<f32>")));
        assert_eq!(signature(TEXT, &found[5]).unwrap().result, None);
        let members = members(TEXT, &found[1]);
        assert_eq!((members[0].name.as_str(), members[1].ty.as_str()), ("a", "array<vec4f, 9>"));
    }

    #[test]
    fn single_return() {
        let body = |t: &str| returned(t, 0..t.len());
        assert_eq!(body(" return a + b; ").as_deref(), Some("a + b"));
        assert_eq!(body("let x = 1; return x;"), None);
        assert_eq!(body("return;"), None);
        assert_eq!(body(""), None);
    }

    #[test]
    fn mistakes_do_not_stop_the_reading() {
        let (found, mistakes) = split("oops 1; const_assert 1 < 2; fn ; fn f( ) { } } @a fn h() {");
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(mistakes.len() >= 4, "{mistakes:?}");
    }

    #[test]
    fn hostile_text_ends() {
        for text in ["@", "@a(", "fn", "fn f(", "var<", "struct S { a", ")", "@a @b @c"] {
            let (found, mistakes) = split(text);
            assert!(found.is_empty() && !mistakes.is_empty(), "{text}");
        }
    }
}
