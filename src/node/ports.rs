//! The `///` lines that say what a function takes and gives.

use std::ops::Range;

use super::definition::Default;
use super::report::{Piece, Report};
use super::sources::{source, sources};
use crate::diagnostic::did_you_mean;
use crate::semantic::{Encoding, Frame, Kind, Length, Meaning, Quantity, Value};

/// A port line, read.
#[derive(Clone, Debug)]
pub(crate) struct PortLine {
    pub(crate) name: String,
    pub(crate) name_range: Range<usize>,
    pub(crate) output: bool,
    pub(crate) meaning: Meaning,
    pub(crate) meaning_range: Range<usize>,
    pub(crate) default: Option<(Default, Range<usize>)>,
    pub(crate) range: (Option<f64>, Option<f64>),
    pub(crate) unit: String,
    pub(crate) hidden: bool,
    pub(crate) doc: String,
}

const FORM: &str = "write `/// name (meaning; = default; range; flags): What it does.` \
                    or `/// -> name (meaning): What it is.`";

/// Whether a doc line means to be a port line; where port lines are voluntary, others are prose.
pub(crate) fn looks_like_port(line: &str) -> bool {
    let line = line.trim();
    line.starts_with("->") || line.split_once('(').is_some_and(|(n, _)| super::tokens::is_identifier(n.trim()))
}

/// Reads one port line, `///` left out. Nothing: it is so broken that it names no port.
pub(crate) fn parse(report: &mut Report, line: Piece<'_>) -> Option<PortLine> {
    let line = line.trim();
    let (output, rest) = match line.text.strip_prefix("->") {
        Some(rest) => (true, line.slice(line.text.len() - rest.len()..line.text.len()).trim()),
        None => (false, line),
    };
    let Some((open, end)) = parentheses(rest.text) else {
        report.error("ST0112", line.range(), "a port line without `(meaning)`").help(FORM);
        return None;
    };
    let name = rest.slice(0..open).trim();
    if !super::tokens::is_identifier(name.text) {
        report.error("ST0112", name.range(), format!("`{}` is not a name", name.text)).help(FORM);
        return None;
    }
    let tail = rest.slice(end + 1..rest.text.len()).trim();
    let doc = match tail.text.strip_prefix(':') {
        Some(doc) if !doc.trim().is_empty() => doc.trim().to_owned(),
        _ => {
            report
                .error("ST0112", tail.range(), format!("the line of `{}` does not say what it is for", name.text))
                .help(FORM)
                .port(name.text);
            String::new()
        }
    };
    let mut parts = rest.slice(open + 1..end).split(';').into_iter();
    let meaning = parts.next().unwrap_or(Piece::new("", rest.at));
    let mut port = PortLine {
        name: name.text.to_owned(),
        name_range: name.range(),
        output,
        meaning: read_meaning(report, meaning),
        meaning_range: meaning.range(),
        default: None,
        range: (None, None),
        unit: String::new(),
        hidden: false,
        doc,
    };
    let mut seen = Vec::new();
    for part in parts {
        let twice = |what: &'static str, seen: &mut Vec<&'static str>| {
            let twice = seen.contains(&what);
            seen.push(what);
            twice
        };
        let again = if part.text.starts_with('=') {
            let value = part.slice(1..part.text.len()).trim();
            port.default = default(report, value).map(|d| (d, value.range()));
            twice("default", &mut seen)
        } else if part.text.contains("..") {
            range(report, part, &mut port);
            twice("range", &mut seen)
        } else {
            flags(report, part, &mut port);
            false
        };
        if again {
            report.error("ST0104", part.range(), "said twice").help("remove one of them").port(&port.name);
        }
    }
    if output && (port.default.is_some() || port.hidden || port.range != (None, None)) {
        report
            .error("ST0112", rest.range(), format!("the output `{}` has a default, a range or is hidden", port.name))
            .help("only inputs have those")
            .port(&port.name);
    }
    Some(port)
}

/// The first parenthesis and the one that closes it.
fn parentheses(text: &str) -> Option<(usize, usize)> {
    let open = text.find('(')?;
    let mut depth = 0usize;
    for (i, c) in text[open..].char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some((open, open + i));
        }
    }
    None
}

fn read_meaning(report: &mut Report, piece: Piece<'_>) -> Meaning {
    Meaning::parse(piece.text).unwrap_or_else(|message| {
        let unknown = message.split('`').nth(1).unwrap_or_default();
        let words = Kind::ALL.iter().map(|k| k.word());
        let words = words.chain(Frame::ALL.iter().map(|k| k.word())).chain(Length::ALL.iter().map(|k| k.word()));
        let words = words.chain(Quantity::ALL.iter().map(|k| k.word()));
        let words = words.chain(Encoding::ALL.iter().map(|k| k.word())).filter(|w| !w.is_empty());
        let near = did_you_mean(unknown, words);
        let at = piece.words().into_iter().find(|word| word.text == unknown).map_or(piece.range(), Piece::range);
        report.error("ST0113", at, message).suggest(near);
        Meaning::of(Kind::Number)
    })
}

fn default(report: &mut Report, piece: Piece<'_>) -> Option<Default> {
    if let Some(name) = piece.text.strip_prefix('@') {
        if source(name).is_none() {
            report
                .error("ST0115", piece.range(), format!("the compiler provides no `@{name}`"))
                .suggest(did_you_mean(name, sources().iter().map(|s| s.name)));
            return None;
        }
        return Some(Default::Source(name.to_owned()));
    }
    let value = match piece.text {
        "true" => Some(Value::Bool(true)),
        "false" => Some(Value::Bool(false)),
        text => {
            let inner = text.strip_prefix('(').and_then(|t| t.strip_suffix(')')).unwrap_or(text);
            let numbers: Option<Vec<f64>> = inner.split(',').take(17).map(|n| number(n.trim())).collect();
            numbers.filter(|n| n.len() <= 16 && (n.len() == 1 || inner.len() < text.len())).map(Value::Numbers)
        }
    };
    if value.is_none() {
        report
            .error("ST0114", piece.range(), format!("`{}` is not a value", piece.text))
            .help("a default is a number, (a, b, c), true, false or @source");
    }
    value.map(Default::Value)
}

fn number(text: &str) -> Option<f64> {
    text.parse().ok().filter(|n: &f64| n.is_finite())
}

fn range(report: &mut Report, piece: Piece<'_>, port: &mut PortLine) {
    let Some((low, high)) = piece.split_once("..") else {
        return;
    };
    let mut limit = |end: Piece<'_>| {
        if end.text.is_empty() {
            return None;
        }
        let found = number(end.text);
        if found.is_none() {
            report
                .error("ST0116", piece.range(), format!("`{}` is not a range", piece.text))
                .help("a range reads `0..1`, `0..` or `..1`")
                .port(&port.name);
        }
        found
    };
    port.range = (limit(low), limit(high));
    if low.text.is_empty() && high.text.is_empty() {
        report
            .error("ST0116", piece.range(), "a range without an end")
            .help("a range reads `0..1`, `0..` or `..1`")
            .port(&port.name);
    }
    if let (Some(low), Some(high)) = port.range
        && low > high
    {
        report
            .error("ST0116", piece.range(), format!("the range {low}..{high} is empty"))
            .help("write the lower limit first")
            .port(&port.name);
    }
}

fn flags(report: &mut Report, piece: Piece<'_>, port: &mut PortLine) {
    let words: Vec<Piece<'_>> = piece.split(',').into_iter().flat_map(Piece::words).collect();
    if words.is_empty() {
        report.error("ST0112", piece.range(), "an empty entry between `;`").help("remove a `;`").port(&port.name);
    }
    let mut words = words.into_iter();
    while let Some(word) = words.next() {
        match word.text {
            "hidden" => port.hidden = true,
            // Values in files are sRGB; what the function gets is linear.
            "srgb" => port.unit = "srgb".into(),
            "in" => match words.next() {
                Some(unit) if matches!(unit.text, "deg" | "m" | "s" | "px") => port.unit = unit.text.to_owned(),
                unit => {
                    let at = unit.unwrap_or(word);
                    report
                        .error("ST0112", at.range(), format!("`{}` is not a unit", at.text))
                        .help("units are deg, m, s, px")
                        .port(&port.name);
                }
            },
            other => {
                report
                    .error("ST0112", word.range(), format!("`{other}` is not a flag"))
                    .help("flags are `in deg`, `in m`, `in s`, `in px`, `hidden`, `srgb`")
                    .port(&port.name);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::SourceText;

    fn read(line: &str) -> (Option<PortLine>, Vec<String>) {
        let mut report = Report::new(&SourceText::new("t", line));
        let port = parse(&mut report, Piece::new(line, 0));
        let found = report.found.into_iter().map(|d| {
            let range = d.place.span.map_or(0..0, |s| s.range);
            format!("{} {}: {}", d.code, &line[range], d.message)
        });
        (port, found.collect())
    }

    #[test]
    fn a_full_line() {
        let (port, errors) = read(" angle (angle; = 30; 0..90; in deg, hidden): How wide.");
        let port = port.unwrap();
        assert!(errors.is_empty() && port.hidden && !port.output);
        assert_eq!((port.unit.as_str(), port.range), ("deg", (Some(0.0), Some(90.0))));
        assert_eq!(port.default.unwrap().0, Default::Value(Value::Numbers(vec![30.0])));
        assert_eq!(port.doc, "How wide.");
    }

    #[test]
    fn tuples_sources_and_open_ranges() {
        let (port, _) = read("up (direction world; = (0, 1, 0); ..1): Up.");
        let port = port.unwrap();
        assert_eq!(port.default.unwrap().0, Default::Value(Value::Numbers(vec![0.0, 1.0, 0.0])));
        assert_eq!(port.range, (None, Some(1.0)));
        let (port, _) = read("-> n (normal world): N.");
        assert!(port.unwrap().output);
    }

    #[test]
    fn each_mistake_at_its_place() {
        for (line, expected) in [
            ("what it does", "ST0112 what it does: "),
            ("a b (scalar): X.", "ST0112 a b: "),
            ("a (scalr): X.", "ST0113 scalr: "),
            ("a (scalar wrold): X.", "ST0113 wrold: "),
            ("a (scalar)", "ST0112 : "),
            ("a (scalar; = @tme): X.", "ST0115 @tme: "),
            ("a (scalar; = 1, 2): X.", "ST0114 1, 2: "),
            ("a (scalar; = inf): X.", "ST0114 inf: "),
            ("a (scalar; 1..0): X.", "ST0116 1..0: "),
            ("a (scalar; a..0): X.", "ST0116 a..0: "),
            ("a (scalar; ..): X.", "ST0116 ..: "),
            ("a (scalar; in ft): X.", "ST0112 ft: "),
            ("a (scalar; loud): X.", "ST0112 loud: "),
            ("a (scalar; = 1; = 2): X.", "ST0104 = 2: "),
            ("-> a (scalar; = 1): X.", "ST0112 a (scalar; = 1): X.: "),
        ] {
            let (_, errors) = read(line);
            assert_eq!(errors.len(), 1, "{line}: {errors:?}");
            assert!(errors[0].starts_with(expected), "{line}: {errors:?}");
        }
    }
}
