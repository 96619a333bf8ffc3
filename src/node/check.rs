//! Having WGSL judged by naga, with whatever it says pointing into the text that a person wrote.

use std::error::Error;
use std::ops::Range;
use std::sync::Arc;

use super::conditional::Kept;
use super::definition::Library;
use super::tokens::{Token, TokenKind, tokenize};
use crate::diagnostic::{Diagnostic, Place, SourceText, Span};

/// How deep brackets may nest.
const MAX_BRACKETS: usize = 100;
/// How many tokens one statement may have, counted through the brackets that are open.
const MAX_STATEMENT: usize = 4000;
/// How many `else` one declaration may have.
const MAX_ELSE: usize = 500;
/// Stack for the parser and validator, which recurse over expressions. Only what is touched is ever committed.
const STACK: usize = 256 << 20;

/// Whether a text is small and flat enough to be parsed: the place of the first offence, and what it is.
pub(crate) fn guard(text: &str, max_bytes: usize) -> Option<(Range<usize>, String)> {
    if text.len() > max_bytes {
        return Some((0..0, format!("the text has {} bytes, more than {max_bytes}", text.len())));
    }
    // Tokens since the last separator, for each bracket that is open: an upper bound of how deep syntax trees get.
    let (mut open, mut braces, mut elses) = (vec![0usize], 0usize, 0usize);
    let mut total = 0;
    for Token { kind, range } in tokenize(text) {
        match kind {
            TokenKind::Punctuation(b'(' | b'[' | b'{') => {
                braces += usize::from(kind == TokenKind::Punctuation(b'{'));
                open.push(0);
            }
            TokenKind::Punctuation(b @ (b')' | b']' | b'}')) => {
                if open.len() > 1 {
                    total -= open.pop().unwrap_or(0);
                }
                if b == b'}' {
                    braces = braces.saturating_sub(1);
                    total -= open.last_mut().map_or(0, std::mem::take);
                }
            }
            TokenKind::Punctuation(b';' | b',') => total -= open.last_mut().map_or(0, std::mem::take),
            TokenKind::Word if &text[range.clone()] == "else" => elses += 1,
            TokenKind::Word if braces == 0 && &text[range.clone()] == "fn" => elses = 0,
            _ => {}
        }
        if let Some(last) = open.last_mut() {
            *last += 1;
            total += 1;
        }
        if open.len() > MAX_BRACKETS {
            return Some((range, format!("brackets nest deeper than {MAX_BRACKETS}")));
        }
        if total > MAX_STATEMENT {
            return Some((range, format!("a statement has more than {MAX_STATEMENT} words")));
        }
        if elses > MAX_ELSE {
            return Some((range, format!("a function has more than {MAX_ELSE} `else`")));
        }
    }
    None
}

/// Whether `name` is a type or function that WGSL itself declares.
pub(crate) fn is_builtin(name: &str) -> bool {
    naga::keywords::wgsl::BUILTIN_IDENTIFIERS.contains(&name) || FUNCTIONS.contains(&name) || is_short_type(name)
}

/// `vec3f`, `mat4x4h` and their like.
fn is_short_type(name: &str) -> bool {
    let size = |s: &str| matches!(s.strip_suffix(['f', 'h', 'i', 'u']), Some("2" | "3" | "4"));
    let columns = |s: &str| s.split_once('x').is_some_and(|(c, r)| matches!(c, "2" | "3" | "4") && size(r));
    name.strip_prefix("vec").is_some_and(size) || name.strip_prefix("mat").is_some_and(columns)
}

/// The functions of the WGSL standard (chapter "Builtin functions"), sorted.
#[rustfmt::skip]
const FUNCTIONS: &[&str] = &[
    "abs", "acos", "acosh", "all", "any", "arrayLength", "asin", "asinh", "atan", "atan2", "atanh", "bitcast", "ceil",
    "clamp", "cos", "cosh", "countLeadingZeros", "countOneBits", "countTrailingZeros", "cross", "degrees",
    "determinant", "distance", "dot", "dpdx", "dpdxCoarse", "dpdxFine", "dpdy", "dpdyCoarse", "dpdyFine", "exp",
    "exp2", "extractBits", "faceForward", "firstLeadingBit", "firstTrailingBit", "floor", "fma", "fract", "frexp",
    "fwidth", "fwidthCoarse", "fwidthFine", "insertBits", "inverseSqrt", "ldexp", "length", "log", "log2", "max",
    "min", "mix", "modf", "normalize", "pack2x16float", "pack2x16snorm", "pack2x16unorm", "pack4x8snorm",
    "pack4x8unorm", "pow", "quantizeToF16", "radians", "reflect", "refract", "reverseBits", "round", "saturate",
    "select", "sign", "sin", "sinh", "smoothstep", "sqrt", "step", "tan", "tanh", "textureDimensions",
    "textureGather", "textureGatherCompare", "textureLoad", "textureNumLayers", "textureNumLevels",
    "textureNumSamples", "textureSample", "textureSampleBaseClampToEdge", "textureSampleBias",
    "textureSampleCompare", "textureSampleCompareLevel", "textureSampleGrad", "textureSampleLevel", "textureStore",
    "transpose", "trunc", "unpack2x16float", "unpack2x16snorm", "unpack2x16unorm", "unpack4x8snorm",
    "unpack4x8unorm",
];

/// What naga finds wrong.
struct Finding {
    code: &'static str,
    message: String,
    range: Option<Range<usize>>,
    notes: Vec<String>,
}

/// Parses and validates `libraries` followed by `kept`; places point into `source`, whose text `kept` was made from.
pub(crate) fn check(libraries: &[&Library], kept: &Kept, source: &Arc<SourceText>) -> Vec<Diagnostic> {
    let mut text = String::new();
    for item in libraries.iter().flat_map(|l| &l.items) {
        text.push_str(&item.text);
        text.push('\n');
    }
    let before = text.len();
    text.push_str(&kept.text);
    let judged = std::thread::Builder::new().stack_size(STACK).spawn(move || judge(&text)).map(|t| t.join());
    let finding = match judged {
        Ok(Ok(None)) => return Vec::new(),
        Ok(Ok(Some(finding))) => finding,
        Ok(Err(_)) => finding_of("ST0127", "the WGSL parser gave up on the text"),
        Err(error) => finding_of("ST0127", &format!("no thread for the WGSL parser: {error}")),
    };
    let range = finding.range.filter(|r| r.start >= before);
    let place = match &range {
        Some(r) => Place::span(Span::new(source, kept.original_range(r.start - before..r.end - before))),
        None => Place::file(&source.name),
    };
    let mut error = Diagnostic::error(finding.code, plain(&finding.message), place);
    // Labels of naga's own structures tell nothing to who wrote the text.
    error.notes.extend(finding.notes.into_iter().filter(|note| !note.starts_with("naga::") && *note != error.message));
    error.help = help(&error.message).map(str::to_owned);
    vec![error]
}

/// What naga says, without the numbers that it gives to parts of its own structures: `[3]`, `Some([3])`.
fn plain(message: &str) -> String {
    let mut rest = message;
    let mut plain = String::with_capacity(message.len());
    while let Some(open) = rest.find('[') {
        let digits = rest[open + 1..].bytes().take_while(u8::is_ascii_digit).count();
        if digits > 0 && rest[open + 1 + digits..].starts_with(']') {
            let (before, after) = (&rest[..open], &rest[open + digits + 2..]);
            let wrapped = before.strip_suffix("Some(").and_then(|b| Some((b, after.strip_prefix(')')?)));
            let (before, after) = wrapped.unwrap_or((before, after));
            plain.push_str(before.strip_suffix(' ').unwrap_or(before));
            rest = after;
        } else {
            plain.push_str(&rest[..=open]);
            rest = &rest[open + 1..];
        }
    }
    plain + rest
}

/// What to do about the mistakes that are made most often.
fn help(message: &str) -> Option<&'static str> {
    let advice = [
        (
            "no definition in scope",
            "declare it, make it a parameter of the function, or put its library on a `use:` line",
        ),
        ("is a reserved keyword", "give it another name"),
        ("is recursive", "WGSL has no recursion: write a loop"),
        ("does not match the declared return type", "return a value of the type after `->`, or change that type"),
        ("automatic conversions cannot convert", "convert it: `f32(x)`, `vec3f(x)` and so on"),
    ];
    advice.iter().find(|(part, _)| message.contains(part)).map(|(_, help)| *help)
}

fn finding_of(code: &'static str, message: &str) -> Finding {
    Finding { code, message: message.to_owned(), range: None, notes: Vec::new() }
}

fn judge(text: &str) -> Option<Finding> {
    let module = match naga::front::wgsl::parse_str(text) {
        Ok(module) => module,
        Err(error) => {
            let mut labels = error.labels().filter_map(|(span, label)| Some((span.to_range()?, label.to_owned())));
            let first = labels.next();
            let mut notes: Vec<String> = first.iter().map(|(_, l)| l.clone()).filter(|l| !l.is_empty()).collect();
            notes.extend(error.notes().map(str::to_owned));
            let message = error.message().to_owned();
            return Some(Finding { code: "ST0126", message, range: first.map(|(r, _)| r), notes });
        }
    };
    let mut validator =
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::default());
    let error = validator.validate(&module).err()?;
    let range = error.spans().filter_map(|(span, _)| span.to_range()).min_by_key(Range::len);
    let notes = error.spans().map(|(_, label)| label.clone()).filter(|l| !l.is_empty()).collect();
    let mut message = error.as_inner().to_string();
    let mut cause = error.as_inner().source();
    while let Some(inner) = cause {
        message = format!("{message}: {inner}");
        cause = inner.source();
    }
    Some(Finding { code: "ST0127", message, range, notes })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn builtin_functions_are_sorted_and_known() {
        assert!(FUNCTIONS.is_sorted());
        assert!(is_builtin("normalize") && is_builtin("vec3f") && is_builtin("mat2x3f") && !is_builtin("lambert"));
    }

    #[test]
    fn deep_long_and_chained_texts_are_refused() {
        assert!(guard(&"(".repeat(101), 1 << 16).is_some());
        assert!(guard(&format!("fn f() -> f32 {{ return {} 1; }}", "1 + ".repeat(4000)), 1 << 16).is_some());
        assert!(guard(&format!("fn f() {{ if a {{}} {} }}", "else if a {} ".repeat(501)), 1 << 16).is_some());
        assert!(guard(&"f(1,1)+".repeat(2000), 1 << 16).is_some());
        assert!(guard("aa", 1).is_some());
    }

    #[test]
    fn long_flat_texts_pass() {
        let table = format!("const A = array<f32, 9000>({});", "1.0, ".repeat(9000));
        assert!(guard(&table, 1 << 20).is_none());
        assert!(guard(&"fn f() { if a { b(); } else { c(); } }\n".repeat(600), 1 << 20).is_none());
    }

    #[test]
    fn the_deepest_text_that_is_let_through_is_survived() {
        let source = |body: String| format!("fn f(x: f32) -> f32 {{ var y = x; {body} return y; }}");
        let texts = [
            source(format!("y = {}x;", "x + ".repeat(1900))),
            source(format!("y = {}x;", "-".repeat(3900).replace('-', "- "))),
            source(format!("if x > 1 {{ y = 1; }} {}", "else if x > 2 { y = 2; } ".repeat(499))),
            source(format!("y = {}x{};", "(".repeat(90), ")".repeat(90))),
        ];
        for text in texts {
            assert!(guard(&text, 1 << 16).is_none(), "{}", &text[..60]);
            let kept = super::super::conditional::apply(&text, &|_| None).0;
            for error in check(&[], &kept, &SourceText::new("t", text.clone())) {
                assert!(!error.message.contains("gave up"), "{error:?}");
            }
        }
    }
}
