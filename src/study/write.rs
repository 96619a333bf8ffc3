//! The one text of a study: fields in a fixed order, and what does not fit into a line broken into its parts.

use std::sync::Arc;

use crate::diagnostic::SourceText;
use crate::ron::{self, Field, Node, Tree, identifier, inline};

/// Columns that a line may have.
const WIDTH: usize = 120;
/// Fields in the order in which they are written; others follow as they are.
const ORDER: [&str; 13] = [
    "version",
    "title",
    "note",
    "plain",
    "timed",
    "rounds",
    "warm_up",
    "truth",
    "cases",
    "methods",
    "grids",
    "published",
    "claims",
];

/// Whether a text is meant to be a study.
pub fn is_study(text: &str) -> bool {
    let mut rest = text.trim_start();
    // What stands before the root is blank or comment.
    loop {
        rest = match (rest.strip_prefix("//"), rest.strip_prefix("/*")) {
            (Some(line), _) => line.split_once('\n').map_or("", |(_, rest)| rest).trim_start(),
            (_, Some(block)) => block.split_once("*/").map_or("", |(_, rest)| rest).trim_start(),
            _ => return rest.strip_prefix("Study").is_some_and(|r| r.trim_start().starts_with('(')),
        };
    }
}

/// The canonical text of a study that can be read. Comments become part of its note. None where the text is no RON.
pub fn canonical(source: &Arc<SourceText>) -> Option<String> {
    let mut document = ron::read(source).0?;
    let comments: Vec<&str> = document
        .comments
        .iter()
        .filter_map(|c| source.text.get(c.span.clone()))
        .map(|c| c.trim_start_matches("/*").trim_end_matches("*/").trim_start_matches('/').trim())
        .filter(|c| !c.is_empty())
        .collect();
    let Tree::Struct(_, fields) = &mut document.root.value else { return None };
    if !comments.is_empty() {
        let added = comments.join("\n");
        match fields.iter_mut().find(|f| f.name == "note") {
            Some(Field { value: Node { value: Tree::Text(note), .. }, .. }) => *note = format!("{note}\n{added}"),
            Some(_) => {}
            None => fields.push(Field { name: "note".into(), name_span: 0..0, value: Node::text(added) }),
        }
    }
    fields.sort_by_key(|f| ORDER.iter().position(|name| *name == f.name).unwrap_or(ORDER.len()));
    let mut out = String::from("Study(\n");
    for field in fields.iter() {
        let name = format!("    {}: ", identifier(&field.name));
        out.push_str(&name);
        write(&mut out, &field.value, 1, name.len());
        out.push_str(",\n");
    }
    out.push_str(")\n");
    Some(out)
}

/// A value after `column` columns of its line, whose parts are indented by one more than `level`.
fn write(out: &mut String, node: &Node, level: usize, column: usize) {
    let whole = inline(node);
    // The cases and methods of a study are lists to be read, however short.
    let has_items = match &node.value {
        Tree::Map(entries) => !entries.is_empty(),
        Tree::List(items) => !items.is_empty(),
        _ => false,
    };
    let is_list = level == 1 && has_items;
    if !is_list && (column + whole.chars().count() < WIDTH || whole.contains('\n')) {
        out.push_str(&whole);
        return;
    }
    let indent = "    ".repeat(level + 1);
    let each = |out: &mut String, name: String, value: &Node| {
        out.push_str(&indent);
        out.push_str(&name);
        write(out, value, level + 1, indent.len() + name.chars().count());
        out.push_str(",\n");
    };
    let close = match &node.value {
        Tree::Map(entries) => {
            out.push_str("{\n");
            entries.iter().for_each(|(key, value)| each(out, format!("{}: ", inline(key)), value));
            '}'
        }
        Tree::List(items) => {
            out.push_str("[\n");
            items.iter().for_each(|item| each(out, String::new(), item));
            ']'
        }
        Tree::Struct(name, fields) => {
            out.push_str(&name.as_deref().map(identifier).unwrap_or_default());
            out.push_str("(\n");
            fields.iter().for_each(|f| each(out, format!("{}: ", identifier(&f.name)), &f.value));
            ')'
        }
        _ => {
            out.push_str(&whole);
            return;
        }
    };
    out.push_str(&"    ".repeat(level));
    out.push(close);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_canonical_text_stays_as_it_is_and_keeps_what_is_not_known() {
        let text = "// first\nStudy(title: \"a\", odd: (1, 2), version: 1, cases: {\"x\": (scene: \"s\")} /* last */)";
        let once = canonical(&SourceText::new("s.ron", text)).expect("RON");
        let expected = "Study(\n    version: 1,\n    title: \"a\",\n    note: r#\"first\nlast\"#,\n    cases: {\n        \
                        \"x\": (scene: \"s\"),\n    },\n    odd: (1, 2),\n)\n";
        assert_eq!(once, expected);
        assert_eq!(canonical(&SourceText::new("s.ron", once.as_str())).as_deref(), Some(expected));
        assert_eq!(canonical(&SourceText::new("s.ron", "Study(")), None);
    }

    #[test]
    fn studies_are_told_from_other_files() {
        assert!(is_study("// Graph(\n/* x */ Study (version: 1)") && !is_study("Studying()") && !is_study("// Study("));
    }
}
