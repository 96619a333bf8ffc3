//! Reading the fields of a struct: which are given, which are missing, which are not known.

use std::sync::Arc;

use super::tree::Reading;
use super::{Field, Node, Tree};
use crate::diagnostic::{Diagnostic, Place, SourceText, Span, did_you_mean};

/// The fields of a struct; `what` names the thing for the complaint when it is none. `()` has no fields.
pub fn expect_fields<'a>(node: &'a Node, source: &Arc<SourceText>, what: &str) -> Reading<&'a [Field]> {
    match &node.value {
        Tree::Struct(_, fields) => Ok(fields),
        Tree::Tuple(_, items) if items.is_empty() => Ok(&[]),
        _ => Err(node.expected(source, what)),
    }
}

/// The value of the field `name`.
pub fn field<'a>(fields: &'a [Field], name: &str) -> Option<&'a Node> {
    fields.iter().find(|f| f.name == name).map(|f| &f.value)
}

/// A warning for each field that is not among `known`.
pub fn unknown_fields(fields: &[Field], known: &[&str], source: &Arc<SourceText>) -> Vec<Diagnostic> {
    let unknown = fields.iter().filter(|f| !known.contains(&f.name.as_str())).take(super::MAX_ERRORS);
    unknown
        .map(|f| {
            let place = Place::span(Span::new(source, f.name_span.clone()));
            let warning = Diagnostic::warning("ST0010", format!("the field `{}` is not known here", f.name), place);
            match did_you_mean(&f.name, known.iter().copied()) {
                Some(near) => warning.help(format!("did you mean `{near}`?")),
                None => warning.help(format!("known fields: {}", known.join(", "))),
            }
        })
        .collect()
}
