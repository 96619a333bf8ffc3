//! The small languages of header values: lists, calls, options, chains of passes.

use super::definition::OptionSpec;
use super::projection::{MOST_VIEWS, Projection};
use super::report::{Piece, Report};
use super::tokens::is_identifier;
use crate::diagnostic::did_you_mean;

/// `a, b, c`: any texts.
pub(crate) fn list(report: &mut Report, value: Piece<'_>) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for part in value.split(',') {
        if part.text.is_empty() {
            report.error("ST0102", part.range(), "an empty entry in a list").help("remove a comma");
        } else if found.iter().any(|f| f == part.text) {
            report.error("ST0104", part.range(), format!("`{}` is said twice", part.text)).help("remove one of them");
        } else {
            found.push(part.text.to_owned());
        }
    }
    found
}

/// `a, b, c`: names.
pub(crate) fn names(report: &mut Report, value: Piece<'_>) -> Vec<String> {
    for part in value.split(',') {
        if !part.text.is_empty() && !is_identifier(part.text) {
            report
                .error("ST0102", part.range(), format!("`{}` is not a name", part.text))
                .help("names are separated by commas");
        }
    }
    let mut found = list(report, value);
    found.retain(|f| is_identifier(f));
    found
}

/// `name` or `name(arguments)`.
pub(crate) fn call<'a>(report: &mut Report, value: Piece<'a>) -> Option<(Piece<'a>, Option<Piece<'a>>)> {
    let (name, arguments) = match value.text.find('(') {
        Some(open) if value.text.ends_with(')') => {
            (value.slice(0..open).trim(), Some(value.slice(open + 1..value.text.len() - 1).trim()))
        }
        Some(_) => {
            report.error("ST0102", value.range(), "a parenthesis is not closed").help("write `name(a, b)`");
            return None;
        }
        None => (value, None),
    };
    if !is_identifier(name.text) {
        report
            .error("ST0102", name.range(), format!("`{}` is not a name", name.text))
            .help("write `name` or `name(a, b)`");
        return None;
    }
    Some((name, arguments))
}

/// `a | b | c = b - TEXT`.
pub(crate) fn option(report: &mut Report, name: Piece<'_>, value: Piece<'_>) -> Option<OptionSpec> {
    let (rule, doc) = match value.split_once(" - ") {
        Some((rule, doc)) => (rule, doc.text.to_owned()),
        None => {
            report
                .error("ST0102", value.range(), format!("option `{}` does not say what it is for", name.text))
                .help("write `option NAME: a | b = a - What it chooses.`");
            (value, String::new())
        }
    };
    let Some((choices, default)) = rule.split_once("=") else {
        report
            .error("ST0102", rule.range(), format!("option `{}` has no default", name.text))
            .help("write `option NAME: a | b = a - What it chooses.`");
        return None;
    };
    let mut found: Vec<String> = Vec::new();
    for choice in choices.split('|') {
        let word = choice.text.bytes().all(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'.' | b'-' | b'+'));
        if choice.text.is_empty() || !word {
            report
                .error("ST0102", choice.range(), format!("`{}` is not a choice", choice.text))
                .help("a choice has letters, digits, `_`, `.`, `-` and `+`");
        } else if found.iter().any(|f| f == choice.text) {
            report
                .error("ST0104", choice.range(), format!("`{}` is said twice", choice.text))
                .help("remove one of them");
        } else {
            found.push(choice.text.to_owned());
        }
    }
    if !found.iter().any(|f| f == default.text) {
        report
            .error("ST0105", default.range(), format!("the default `{}` is not among the choices", default.text))
            .suggest(did_you_mean(default.text, found.iter().map(String::as_str)));
        return None;
    }
    Some(OptionSpec { name: name.text.to_owned(), choices: found, default: default.text.to_owned(), doc })
}

/// `pass(a=1, b=$option) > pass`.
pub(crate) fn passes<'a>(
    report: &mut Report,
    value: Piece<'a>,
    mentioned: &mut Vec<Piece<'a>>,
) -> Vec<(String, Vec<(String, String)>)> {
    let mut found = Vec::new();
    for part in value.split('>') {
        if let Some((name, arguments)) = call(report, part) {
            let pieces = arguments.map_or(Vec::new(), |a| a.split(','));
            found.push((name.text.to_owned(), pairs(report, &pieces, mentioned)));
        }
    }
    found
}

/// `key=value` each.
fn pairs<'a>(report: &mut Report, pieces: &[Piece<'a>], mentioned: &mut Vec<Piece<'a>>) -> Vec<(String, String)> {
    let mut found: Vec<(String, String)> = Vec::new();
    for piece in pieces {
        match piece.split_once("=") {
            Some((key, value)) if is_identifier(key.text) && !value.text.is_empty() => {
                if found.iter().any(|(k, _)| k == key.text) {
                    report
                        .error("ST0104", key.range(), format!("`{}` is said twice", key.text))
                        .help("remove one of them");
                    continue;
                }
                if value.text.starts_with('$') {
                    mentioned.push(value);
                }
                found.push((key.text.to_owned(), value.text.to_owned()));
            }
            _ => {
                report
                    .error("ST0102", piece.range(), format!("`{}` does not read `key=value`", piece.text))
                    .help("write no spaces around `=`");
            }
        }
    }
    found
}

/// Settings of a sampler, checked against what a sampler knows.
pub(crate) fn sampler<'a>(
    report: &mut Report,
    value: Piece<'a>,
    mentioned: &mut Vec<Piece<'a>>,
) -> Vec<(String, String)> {
    let known = |key: &str, value: &str| match key {
        "filter" => Some(matches!(value, "nearest" | "linear" | "trilinear")),
        "address" => Some(matches!(value, "repeat" | "clamp" | "mirror")),
        "anisotropy" => Some(value.parse::<u16>().is_ok_and(|n| (1..=16).contains(&n))),
        "compare" => Some(value == "on"),
        _ => None,
    };
    checked(report, value, mentioned, &known, "filter, address, anisotropy, compare")
}

/// Settings of a texture.
pub(crate) fn texture<'a>(
    report: &mut Report,
    value: Piece<'a>,
    mentioned: &mut Vec<Piece<'a>>,
) -> Vec<(String, String)> {
    let known = |key: &str, value: &str| (key == "encoding").then_some(matches!(value, "srgb" | "linear"));
    checked(report, value, mentioned, &known, "encoding")
}

/// Settings of a projection.
pub(crate) fn space<'a>(
    report: &mut Report,
    value: Piece<'a>,
    projection: &Projection,
    mentioned: &mut Vec<Piece<'a>>,
) -> Vec<(String, String)> {
    let views = |value: &str| value.parse::<u32>().is_ok_and(|n| (1..=MOST_VIEWS).contains(&n));
    let known = |key: &str, value: &str| {
        let (_, values) = projection.settings.iter().find(|(name, _)| *name == key)?;
        Some(values.iter().any(|v| *v == value || (*v == "*" && views(value))))
    };
    let names: Vec<&str> = projection.settings.iter().map(|(name, _)| *name).collect();
    checked(report, value, mentioned, &known, &names.join(", "))
}

fn checked<'a>(
    report: &mut Report,
    value: Piece<'a>,
    mentioned: &mut Vec<Piece<'a>>,
    known: &dyn Fn(&str, &str) -> Option<bool>,
    keys: &str,
) -> Vec<(String, String)> {
    let words = value.words();
    let found = pairs(report, &words, mentioned);
    for (key, setting) in &found {
        match known(key, setting) {
            Some(good) if good || setting.starts_with('$') => {}
            Some(_) => {
                report
                    .error("ST0102", value.range(), format!("`{setting}` is not a value of `{key}`"))
                    .help("nodes/README.md lists the values of each setting");
            }
            None => {
                report
                    .error("ST0101", value.range(), format!("`{key}` is not a setting here"))
                    .help(format!("settings are {keys}"));
            }
        }
    }
    found
}
