//! Claims as a study's file has them.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::{Claim, KINDS, Kind};
use crate::diagnostic::{Diagnostic, SourceText, did_you_mean};
use crate::ron::{Field, Node, field};
use crate::study::reading::Reader;
use crate::study::select::Quantity;

/// Fields that every claim takes.
const COMMON: [&str; 11] =
    ["id", "text", "law", "kind", "time", "pass", "methods", "over", "from", "class", "settings"];
/// Fields that belong to some tests, and the numbers that they may be.
const NUMBERS: [(&str, (f64, f64)); 4] =
    [("within", (0.0, 10.0)), ("exponent", (0.1, 10.0)), ("least", (0.0, 1.0)), ("by", (0.0, 1e9))];
/// How far a step of what grows may go back, where nothing is said.
const GOES_BACK: f64 = 0.05;

/// Reads a list of claims. `methods` are those that the study has; without them none is questioned.
pub fn read_claims(
    node: &Node,
    source: &Arc<SourceText>,
    methods: Option<&[String]>,
    found: &mut Vec<Diagnostic>,
) -> Vec<Claim> {
    let mut reader = Reader { source, found };
    let items = reader.take(node.as_list(source)).unwrap_or_default();
    let mut names = BTreeSet::new();
    let mut claims = Vec::new();
    for item in items {
        let Some(claim) = claim(item, methods, &mut reader) else { continue };
        if !names.insert(claim.id.clone()) {
            let help = "give each claim a name of its own; what belongs together is told by what stands before a blank";
            reader.error("ST0654", format!("two claims are called `{}`", claim.id), item, help);
        }
        claims.push(claim);
    }
    claims
}

fn claim(node: &Node, methods: Option<&[String]>, reader: &mut Reader<'_>) -> Option<Claim> {
    let known: Vec<&str> = COMMON.iter().copied().chain(NUMBERS.map(|(n, _)| n)).chain(["to", "frame"]).collect();
    let fields = reader.fields(node, "a claim `(id: \"H1\", kind: \"constant\", time: \"main\", ...)`", &known)?;
    let id = reader.text(fields, "id").filter(|id| !id.trim().is_empty());
    if id.is_none() {
        reader.error("ST0654", "a claim has no name", node, "add `id: \"H1\"`");
    }
    let times: Vec<(&str, Quantity)> = Quantity::ALL.to_vec();
    let time = reader.word(fields, "time", ("ST0651", "time"), &times);
    let kinds: Vec<(&str, &Kind)> = KINDS.iter().map(|k| (k.name, k)).collect();
    let kind = reader.word(fields, "kind", ("ST0650", "test"), &kinds);
    for needed in ["kind", "time", "over"] {
        if field(fields, needed).is_none() {
            reader.error(
                "ST0655",
                format!("the claim does not say its `{needed}`"),
                node,
                format!("add `{needed}: \"...\"`"),
            );
        }
    }
    let over = reader.text(fields, "over");
    let named = reader.texts(fields, "methods");
    let to = reader.text(fields, "to");
    for (name, at) in named.iter().map(|(name, at)| (name, *at)).chain(to.iter().zip(field(fields, "to"))) {
        known_method(name, at, methods, reader);
    }
    let mut numbers = [None; 4];
    for (slot, (name, limits)) in numbers.iter_mut().zip(NUMBERS) {
        *slot = reader.number(fields, name, limits);
    }
    let (kind, time, over, id) = (kind?, time?, over?, id?);
    fits(kind, fields, named.len(), node, reader);
    let [within, exponent, least, by] = numbers;
    Some(Claim {
        id,
        text: reader.text(fields, "text").unwrap_or_default(),
        law: reader.get(fields, "law", Node::as_bool).unwrap_or(false),
        kind: kind.name,
        time,
        pass: reader.text(fields, "pass"),
        methods: named.into_iter().map(|(name, _)| name).collect(),
        to,
        over,
        from: reader.number(fields, "from", (0.0, 1e12)).unwrap_or(0.0),
        only: reader.filter(fields),
        within: within.unwrap_or(GOES_BACK),
        exponent: exponent.unwrap_or(1.0),
        least: least.unwrap_or(0.0),
        by: by.unwrap_or(1.0),
    })
}

/// Tells of a method that the study does not have.
pub(in crate::study) fn known_method(name: &str, at: &Node, methods: Option<&[String]>, reader: &mut Reader<'_>) {
    let Some(methods) = methods.filter(|m| !m.iter().any(|m| m == name)) else { return };
    let help = match did_you_mean(name, methods.iter().map(String::as_str)) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("its methods are {}", methods.join(", ")),
    };
    reader.error("ST0652", format!("the study has no method `{name}`"), at, help);
}

/// Tells of what a test needs and does not have, or has and does not take.
fn fits(kind: &Kind, fields: &[Field], methods: usize, node: &Node, reader: &mut Reader<'_>) {
    for needed in kind.needs.iter().filter(|n| field(fields, n).is_none()) {
        let message = format!("the test `{}` needs `{needed}`", kind.name);
        reader.error("ST0655", message, node, format!("add `{needed}: ...`"));
    }
    let own = NUMBERS.iter().map(|(name, _)| *name).chain(["to"]);
    for name in own.filter(|n| !kind.needs.contains(n) && !kind.takes.contains(n)) {
        if let Some(at) = field(fields, name) {
            let message = format!("the test `{}` does not take `{name}`", kind.name);
            reader.error("ST0655", message, at, "leave it out, or choose another test");
        }
    }
    if methods < kind.methods.0 || methods > kind.methods.1 {
        let message = format!("the test `{}` cannot be of {methods} methods", kind.name);
        let help = match kind.methods {
            (least, usize::MAX) => format!("name at least {least} in `methods`, in their order"),
            (least, _) => format!("name {least} in `methods`"),
        };
        reader.error("ST0655", message, field(fields, "methods").unwrap_or(node), help);
    }
}
