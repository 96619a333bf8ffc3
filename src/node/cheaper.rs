//! `cheaper:` lines: in which cheaper forms a node can stand for itself, dearer forms first.

use std::ops::Range;

use super::formula::Formula;
use super::report::{Piece, Report};
use super::settings;
use super::tokens::is_identifier;

/// A cheaper form of a node.
#[derive(Clone, Debug, PartialEq)]
pub struct CheaperSpec {
    /// What is done to the node.
    pub form: Form,
    /// What that means, in words.
    pub doc: String,
    /// The rule, as bytes of the file.
    pub range: Range<usize>,
}

/// What is done to a node to make it cheaper.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// An option takes a choice further down this list.
    Option {
        /// The option.
        name: String,
        /// Choices, dear ones first.
        choices: Vec<String>,
    },
    /// Another kind of node takes its place. Ports of the same name are fed alike.
    Kind {
        /// The kind.
        kind: String,
        /// Other ports of that kind, and what they take.
        inputs: Vec<(String, Formula)>,
    },
    /// What feeds this input stands in its place.
    Input(String),
    /// Its outputs are what they come to on average.
    Constant,
    /// Its outputs are computed for each vertex.
    Vertex,
}

const FORMS: &str = "write `option NAME = a > b - TEXT`, `kind NAME(port = formula) - TEXT`, `input NAME - TEXT`, `constant - TEXT` or `vertex - TEXT`";

/// `RULE - TEXT`. Inputs and options that it names are added to `inputs` and `options`.
pub(crate) fn cheaper<'a>(
    report: &mut Report,
    value: Piece<'a>,
    inputs: &mut Vec<Piece<'a>>,
    options: &mut Vec<Piece<'a>>,
) -> Option<CheaperSpec> {
    let Some((rule, doc)) = outside(value, " - ").filter(|(_, doc)| !doc.text.is_empty()) else {
        let open = value.text.matches('(').count() > value.text.matches(')').count();
        let message = if open { "a parenthesis is not closed" } else { "the cheaper form does not say what it is" };
        report.error("ST0102", value.range(), message).help(FORMS);
        return None;
    };
    let (word, rest) = rule.split_once(" ").unwrap_or((rule, rule.slice(rule.text.len()..rule.text.len())));
    let form = match word.text {
        "constant" if rest.text.is_empty() => Form::Constant,
        "vertex" if rest.text.is_empty() => Form::Vertex,
        "input" if is_identifier(rest.text) => {
            inputs.push(rest);
            Form::Input(rest.text.to_owned())
        }
        "option" => {
            let (name, choices) = rest.split_once("=").filter(|(name, _)| is_identifier(name.text)).or_else(|| {
                report.error("ST0102", rule.range(), "the cheaper form names no choices").help(FORMS);
                None
            })?;
            options.push(name);
            let choices: Vec<String> = choices.split('>').iter().map(|c| c.text.to_owned()).collect();
            if choices.len() < 2 {
                report.error("ST0102", rule.range(), "one choice is no choice").help(FORMS);
                return None;
            }
            Form::Option { name: name.text.to_owned(), choices }
        }
        "kind" => {
            let (kind, arguments) = settings::call(report, rest)?;
            let arguments = arguments.map_or(Vec::new(), |a| a.split(','));
            let ports: Option<Vec<_>> = arguments.into_iter().map(|a| port(report, a, inputs)).collect();
            Form::Kind { kind: kind.text.to_owned(), inputs: ports? }
        }
        _ => {
            let message = format!("`{}` is not a cheaper form", rule.text);
            report.error("ST0102", rule.range(), message).help(FORMS);
            return None;
        }
    };
    Some(CheaperSpec { form, doc: doc.text.to_owned(), range: rule.range() })
}

/// What stands before and after the first `separator` that is in no parentheses: formulas have minus signs.
fn outside<'a>(value: Piece<'a>, separator: &str) -> Option<(Piece<'a>, Piece<'a>)> {
    let at = value.text.match_indices(separator).map(|(at, _)| at).find(|at| {
        let before = &value.text[..*at];
        before.matches('(').count() <= before.matches(')').count()
    })?;
    Some((value.slice(0..at).trim(), value.slice(at + separator.len()..value.text.len()).trim()))
}

/// `port = formula`.
fn port<'a>(report: &mut Report, text: Piece<'a>, inputs: &mut Vec<Piece<'a>>) -> Option<(String, Formula)> {
    let Some((name, formula)) = text.split_once("=").filter(|(name, _)| is_identifier(name.text)) else {
        report.error("ST0102", text.range(), format!("`{}` does not read `port = formula`", text.text)).help(FORMS);
        return None;
    };
    match Formula::parse(formula.text) {
        Ok(read) => {
            // Names are pieces of the text, so that a wrong one is shown where it stands.
            for name in read.inputs() {
                let at = formula.text.find(name).unwrap_or(0);
                inputs.push(formula.slice(at..at + name.len()));
            }
            Some((name.text.to_owned(), read))
        }
        Err((at, message)) => {
            let rest = formula.slice(at.min(formula.text.len())..formula.text.len());
            let help = "formulas have numbers, inputs of this node, + - * / ^ and parentheses";
            report.error("ST0102", rest.range(), message).help(help);
            None
        }
    }
}
