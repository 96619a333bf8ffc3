//! The reader against the `ron` crate, against its own writer, and against hostile texts.

use proptest::prelude::*;

use super::*;
use crate::diagnostic::{SourceText, has_errors};

fn codes(text: &str) -> Vec<String> {
    let (_, found) = read(&SourceText::new("t.ron", text));
    let spot = |d: &crate::diagnostic::Diagnostic| match &d.place.span {
        Some(span) => format!("{} {}:{}", d.code, span.line_column().0, span.line_column().1),
        None => d.code.to_string(),
    };
    found.iter().map(spot).collect()
}

fn tree(text: &str) -> Node {
    let (document, found) = read(&SourceText::new("t.ron", text));
    assert!(found.is_empty(), "{text}: {found:?}");
    document.unwrap().root
}

/// The spelling of what is read: tells trees apart without their spans.
fn again(text: &str) -> String {
    inline(&tree(text))
}

#[test]
fn reads_every_form() {
    assert_eq!(
        again(
            "#![enable(implicit_some)] Name(a: 1_000, b: [1., .5, -2e-3,], c: {\"k\": 'x'}, d: Some(None), e: (),) // end"
        ),
        r#"Name(a: 1_000, b: [1., .5, -2e-3], c: {"k": 'x'}, d: Some(None), e: ())"#
    );
    assert_eq!(
        again("/* a /* nested */ b */ (true, -inf, NaN, Unit, Pair (1, 2))"),
        "(true, -inf, NaN, Unit, Pair(1, 2))"
    );
    assert_eq!(tree("r##\"a\"#b\"##").value, Tree::Text("a\"#b".into()));
    assert_eq!(
        tree(
            r#""\x41\u{e9}\n\
        on""#
        )
        .value,
        Tree::Text("Aé\non".into())
    );
    assert_eq!(again("(r#a-b: 1)"), "(r#a-b: 1)");
}

#[test]
fn spans_cover_what_was_written() {
    let text = "(a: 12, b: \"é\", c: [x])";
    let node = tree(text);
    let Tree::Struct(None, fields) = &node.value else { panic!("{node:?}") };
    let written: Vec<_> = fields.iter().map(|f| (&text[f.name_span.clone()], &text[f.value.span.clone()])).collect();
    assert_eq!(written, [("a", "12"), ("b", "\"é\""), ("c", "[x]")]);
    assert_eq!(node.span, 0..text.len());
    assert_eq!(fields[1].value.content_start(&SourceText { name: String::new(), text: text.into() }), 12);
}

#[test]
fn goes_on_after_a_mistake() {
    assert_eq!(
        codes("(a: ?, b: 1 2, c: [1, =, 3],\n d 4, e: \"\\q\")"),
        ["ST0001 1:5", "ST0001 1:13", "ST0001 1:23", "ST0001 2:4", "ST0003 2:11"]
    );
    assert_eq!(codes("(a: 1, a: 2)"), ["ST0006 1:8"]);
    assert_eq!(codes("{\"a\": 1, \"a\": 2}"), ["ST0006 1:10"]);
    assert_eq!(codes("1 2"), ["ST0007 1:3"]);
    assert_eq!(codes("(a: [1, 2)"), ["ST0001 1:10"]);
    assert_eq!(codes("(a: [1, 2"), ["ST0001 1:5"]);
    assert_eq!(codes("(\n\"abc)"), ["ST0002 2:1"]);
    assert_eq!(codes("/* a"), ["ST0002 1:1"]);
    assert_eq!(codes(""), ["ST0001 1:1"]);
}

#[test]
fn limits_hold() {
    let deep = |n: usize| "[".repeat(n) + &"]".repeat(n);
    assert!(codes(&deep(MAX_DEPTH)).is_empty());
    assert_eq!(codes(&deep(MAX_DEPTH + 1)), ["ST0004 1:65"]);
    assert_eq!(codes(&"(".repeat(1_000_000)), ["ST0004 1:65"]);
    assert_eq!(codes(&format!("[{}]", "0,".repeat(MAX_VALUES)))[0].split(' ').next(), Some("ST0005"));
    assert_eq!(codes(&" ".repeat(MAX_BYTES + 1)), ["ST0005"]);
    let many = codes(&format!("[{}]", "?,".repeat(1000)));
    assert_eq!((many.len(), many.last().map(String::as_str)), (MAX_ERRORS + 1, Some("ST0012 1:100")));
}

#[test]
fn readings_explain_themselves() {
    let source = SourceText::new("t.ron", "(1, inf, 1.5.2, \"t\", word, 0x1F, -1)");
    let (document, _) = read(&source);
    let Tree::Tuple(None, items) = document.unwrap().root.value else { panic!("a tuple") };
    let message = |result: tree::Reading<f64>| result.map_err(|d| format!("{} {}", d.code, d.message));
    assert_eq!(message(items[0].as_f64(&source)), Ok(1.0));
    assert_eq!(message(items[1].as_f64(&source)), Err("ST0009 `inf` is not a finite number".into()));
    assert_eq!(message(items[2].as_f64(&source)), Err("ST0009 `1.5.2` is not a number".into()));
    assert_eq!(message(items[3].as_f64(&source)), Err("ST0008 expected a number, found a text".into()));
    assert_eq!(message(items[5].as_f64(&source)), Ok(31.0));
    assert_eq!(items[4].as_str(&source).unwrap_err().help.as_deref(), Some("put it in quotes: \"word\""));
    assert!(items[6].as_u64(&source, 10).is_err());
    assert!(items[5].as_u64(&source, 30).is_err());
    assert_eq!(items[5].as_u64(&source, 31).ok(), Some(31));
}

/// Any tree, without spans.
fn any_tree() -> impl Strategy<Value = Node> {
    let name = "[a-z][a-z0-9_]{0,6}"
        .prop_filter("a word of its own", |w| !["true", "false", "inf", "r"].contains(&w.as_str()));
    let leaf = prop_oneof![
        any::<bool>().prop_map(Tree::Bool),
        any::<f64>().prop_filter("finite", |x| x.is_finite()).prop_map(|x| Tree::Number(number(x))),
        any::<i64>().prop_map(|x| Tree::Number(x.to_string())),
        any::<char>().prop_map(Tree::Char),
        any::<String>().prop_map(Tree::Text),
        "[a-z\"#\\\\\n\t]{0,12}".prop_map(Tree::Text),
        Just(Tree::Option(None)),
        Just(Tree::Tuple(None, Vec::new())),
    ];
    let node = leaf.prop_map(Node::new);
    node.prop_recursive(4, 40, 5, move |inner| {
        let many = prop::collection::vec(inner.clone(), 1..4);
        let fields = prop::collection::btree_map(name.clone(), inner.clone(), 1..4);
        let entries = prop::collection::btree_map("[a-z ]{0,4}", inner.clone(), 0..4);
        let struct_name = prop::option::of(name.clone());
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..4).prop_map(Tree::List),
            many.prop_map(|items| Tree::Tuple(None, items)),
            inner.prop_map(|node| Tree::Option(Some(Box::new(node)))),
            entries.prop_map(|entries| Tree::Map(entries.into_iter().map(|(k, v)| (Node::text(k), v)).collect())),
            (struct_name, fields).prop_map(|(name, fields)| {
                let field = |(name, value)| Field { name, name_span: 0..0, value };
                Tree::Struct(name, fields.into_iter().map(field).collect())
            }),
        ]
        .prop_map(Node::new)
    })
}

/// The tree as the `ron` crate sees it: without names of structs, which its value does not keep.
fn as_value(node: &Node) -> ::ron::Value {
    use ::ron::Value;
    let pairs = |pairs: Vec<(Value, Value)>| Value::Map(pairs.into_iter().collect());
    match &node.value {
        Tree::Bool(b) => Value::Bool(*b),
        Tree::Number(n) => n.parse::<::ron::Value>().unwrap(),
        Tree::Char(c) => Value::Char(*c),
        Tree::Text(t) => Value::String(t.clone()),
        Tree::Option(inner) => Value::Option(inner.as_ref().map(|n| Box::new(as_value(n)))),
        Tree::Tuple(_, items) if items.is_empty() => Value::Unit,
        Tree::List(items) | Tree::Tuple(_, items) => Value::Seq(items.iter().map(as_value).collect()),
        Tree::Map(entries) => pairs(entries.iter().map(|(k, v)| (as_value(k), as_value(v))).collect()),
        Tree::Struct(_, fields) => {
            pairs(fields.iter().map(|f| (Value::String(f.name.clone()), as_value(&f.value))).collect())
        }
        Tree::Ident(_) => Value::Unit,
    }
}

proptest! {
    #[test]
    fn what_is_written_is_read_alike(node in any_tree()) {
        let written = inline(&node);
        let source = SourceText::new("t.ron", written.clone());
        let (document, found) = read(&source);
        prop_assert!(found.is_empty(), "{written}: {found:?}");
        prop_assert_eq!(inline(&document.unwrap().root), written.clone());
        let theirs: ::ron::Value = written.parse().map_err(|e| TestCaseError::fail(format!("{written}: {e}")))?;
        prop_assert_eq!(theirs, as_value(&node), "{}", written);
    }

    #[test]
    fn numbers_are_exact(bits in any::<u64>()) {
        let x = f64::from_bits(bits);
        let read = tree::parse_number(&number(x)).unwrap();
        prop_assert!(read.to_bits() == x.to_bits() || (x.is_nan() && read.is_nan()));
    }

    #[test]
    fn hostile_texts_do_not_panic(text in any::<String>()) {
        read(&SourceText::new("t.ron", text));
    }

    #[test]
    fn broken_files_do_not_panic(node in any_tree(), cuts in prop::collection::vec((any::<prop::sample::Index>(), "[\\[\\](){}\",:'#r/*\\\\ 0-9a-z]{0,3}"), 1..6)) {
        let mut text: Vec<char> = inline(&node).chars().collect();
        for (at, put) in cuts {
            let at = at.index(text.len() + 1);
            text.splice(at..(at + 1).min(text.len()), put.chars());
        }
        let text: String = text.into_iter().collect();
        let (document, found) = read(&SourceText::new("t.ron", text.clone()));
        prop_assert!(document.is_some() || has_errors(&found), "{text}");
    }
}
