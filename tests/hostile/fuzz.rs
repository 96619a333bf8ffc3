//! Examples with bytes flipped, pieces cut out, repeated or exchanged. Nothing may panic, and what still compiles must
//! be accepted by naga. `SHADETREE_CASES=20000` makes more cases than the few that every run makes.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use shadetree::diagnostic::SourceText;

use super::make_named;
use crate::support::{files, root};

/// How many cases a property gets.
pub(super) fn cases(usual: u32) -> Config {
    let cases = std::env::var("SHADETREE_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(usual);
    Config { cases, failure_persistence: None, max_shrink_iters: 2_000, ..Config::default() }
}

/// A change of a text at places given as shares of its length.
#[derive(Clone, Debug)]
enum Change {
    Flip(f64, u8),
    Cut(f64, f64),
    Repeat(f64, f64, f64),
    Truncate(f64),
    Insert(f64, &'static str),
    /// Exchanges one word for another of the same text: what is likeliest to be read as something else.
    Exchange(f64, f64),
}

const PIECES: &[&str] = &[
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ":",
    "\"",
    "->",
    ".",
    "r#\"",
    "//",
    "/*",
    "1e400",
    "-",
    "NaN",
    "\u{0}",
    "\u{feff}",
    "\u{202e}",
    "Some(",
    "true",
    "graph: \"x.ron\",",
    "muted: true,",
    "kind: \"custom\",",
    "\\u{110000}",
    "'",
    "//#if",
    "//!",
    "fn ",
    "0.0",
    "é",
];

fn change() -> impl Strategy<Value = Change> {
    let at = || 0.0..1.0_f64;
    prop_oneof![
        (at(), any::<u8>()).prop_map(|(a, b)| Change::Flip(a, b)),
        (at(), 0.0..0.1_f64).prop_map(|(a, n)| Change::Cut(a, n)),
        (at(), 0.0..0.1_f64, at()).prop_map(|(a, n, to)| Change::Repeat(a, n, to)),
        at().prop_map(Change::Truncate),
        (at(), 0..PIECES.len()).prop_map(|(a, i)| Change::Insert(a, PIECES[i])),
        (at(), at()).prop_map(|(a, b)| Change::Exchange(a, b)),
    ]
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "shares of lengths that fit")]
fn place(text: &str, share: f64) -> usize {
    let mut at = ((text.len() as f64) * share) as usize;
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

fn word(text: &str, share: f64) -> std::ops::Range<usize> {
    let inside = |c: char| c.is_alphanumeric() || c == '_';
    let at = place(text, share);
    let start = text[..at].rfind(|c| !inside(c)).map_or(0, |i| i + text[i..].chars().next().map_or(1, char::len_utf8));
    let end = text[at..].find(|c| !inside(c)).map_or(text.len(), |i| at + i);
    start..end.max(start)
}

fn apply(text: &str, change: &Change) -> String {
    match *change {
        Change::Flip(at, bits) => {
            let mut bytes = text.as_bytes().to_vec();
            let at = place(text, at);
            if let Some(byte) = bytes.get_mut(at) {
                *byte ^= bits;
            }
            String::from_utf8_lossy(&bytes).into_owned()
        }
        Change::Cut(at, length) => {
            let (from, to) = (place(text, at), place(text, (at + length).min(1.0)));
            format!("{}{}", &text[..from], &text[to..])
        }
        Change::Repeat(at, length, to) => {
            let (from, end, to) = (place(text, at), place(text, (at + length).min(1.0)), place(text, to));
            format!("{}{}{}", &text[..to], &text[from..end], &text[to..])
        }
        Change::Truncate(at) => text[..place(text, at)].to_owned(),
        Change::Insert(at, piece) => {
            let at = place(text, at);
            format!("{}{piece}{}", &text[..at], &text[at..])
        }
        Change::Exchange(a, b) => {
            let (to, with) = (word(text, a), text[word(text, b)].to_owned());
            format!("{}{with}{}", &text[..to.start], &text[to.end..])
        }
    }
}

/// Texts of a kind of example with their paths.
fn examples(wanted: fn(&str) -> bool) -> Vec<(PathBuf, String)> {
    let all = files("graphs", "ron").into_iter().map(|path| {
        let text = std::fs::read_to_string(root().join(&path)).expect("an example");
        (path, text)
    });
    all.filter(|(_, text)| wanted(text)).collect()
}

fn graphs() -> &'static [(PathBuf, String)] {
    static GRAPHS: OnceLock<Vec<(PathBuf, String)>> = OnceLock::new();
    GRAPHS.get_or_init(|| examples(|text| text.starts_with("Graph(")))
}

fn scenes() -> &'static [(PathBuf, String)] {
    static SCENES: OnceLock<Vec<(PathBuf, String)>> = OnceLock::new();
    SCENES.get_or_init(|| examples(|text| text.starts_with("Scene(")))
}

fn mutated(count: usize) -> impl Strategy<Value = (usize, Vec<Change>)> {
    (0..count, proptest::collection::vec(change(), 1..5))
}

fn text_of(of: &(PathBuf, String), changes: &[Change]) -> (String, String) {
    let text = changes.iter().fold(of.1.clone(), |text, change| apply(&text, change));
    (of.0.display().to_string(), text)
}

#[test]
fn broken_graphs_never_panic_and_what_compiles_is_valid() {
    let mut runner = TestRunner::new(cases(150));
    let result = runner.run(&mutated(graphs().len()), |(which, changes)| {
        let (file, text) = text_of(&graphs()[which], &changes);
        make_named(&file, &text);
        Ok(())
    });
    result.unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn broken_scenes_never_panic_and_what_is_read_can_be_written() {
    let mut runner = TestRunner::new(cases(150));
    let result = runner.run(&mutated(scenes().len()), |(which, changes)| {
        let (file, text) = text_of(&scenes()[which], &changes);
        let (scene, found) = shadetree::scene::read(&SourceText::new(file, text));
        if let Some(scene) = scene.filter(|_| !shadetree::diagnostic::has_errors(&found)) {
            let written = shadetree::scene::write(&scene);
            let (again, found) = shadetree::scene::read(&SourceText::new("again.ron", &*written));
            prop_assert!(!shadetree::diagnostic::has_errors(&found), "{written}\n{found:?}");
            prop_assert_eq!(shadetree::scene::write(&again.expect("read")), written);
        }
        Ok(())
    });
    result.unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn graphs_that_are_read_can_be_written_and_read_again() {
    let mut runner = TestRunner::new(cases(150));
    let result = runner.run(&mutated(graphs().len()), |(which, changes)| {
        let (file, text) = text_of(&graphs()[which], &changes);
        let (graph, found) = shadetree::graph::read(&SourceText::new(file, text));
        if let Some(graph) = graph.filter(|_| !shadetree::diagnostic::has_errors(&found)) {
            let written = shadetree::graph::write(&graph);
            let (again, found) = shadetree::graph::read(&SourceText::new("again.ron", &*written));
            prop_assert!(!shadetree::diagnostic::has_errors(&found), "{written}\n{found:?}");
            prop_assert_eq!(shadetree::graph::write(&again.expect("read")), written);
        }
        Ok(())
    });
    result.unwrap_or_else(|e| panic!("{e}"));
}

/// Node files and libraries that people write are as hostile as graphs.
#[test]
fn broken_node_files_never_panic() {
    static NODES: OnceLock<Vec<(PathBuf, String)>> = OnceLock::new();
    let nodes = NODES.get_or_init(|| {
        let read = |path: PathBuf| {
            let text = std::fs::read_to_string(root().join(&path)).expect("a node");
            (path, text)
        };
        files("nodes", "wgsl").into_iter().map(read).collect()
    });
    let mut runner = TestRunner::new(cases(60));
    let mut catalog = shadetree::node::Catalog::embedded();
    let catalog = std::cell::RefCell::new(&mut catalog);
    let result = runner.run(&mutated(nodes.len()), |(which, changes)| {
        let (file, text) = text_of(&nodes[which], &changes);
        let stem = Path::new(&file).file_stem().expect("a stem").to_string_lossy().into_owned();
        let found = catalog.borrow_mut().add_file(&format!("user/{stem}.wgsl"), &text);
        if !shadetree::diagnostic::has_errors(&found) && catalog.borrow().get(&stem).is_some() {
            let graph = format!("Graph(version: 1, nodes: {{\"a\": (kind: \"{stem}\")}})");
            let (graph, _) = shadetree::graph::read(&SourceText::new("g.ron", graph));
            let named = shadetree::compile::NamedGraph {
                name: "g".into(),
                graph: graph.expect("valid"),
                set: std::collections::BTreeMap::new(),
            };
            let (compiled, _) = shadetree::compile::compile(&[named], &catalog.borrow(), &Default::default());
            if let Some(compiled) = compiled {
                crate::support::prove(&compiled, &text);
            }
        }
        Ok(())
    });
    result.unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn broken_models_never_panic() {
    let path = root().join("graphs/models/fence_posts.obj");
    let text = std::fs::read_to_string(path).expect("a model");
    let mut runner = TestRunner::new(cases(100));
    let result = runner.run(&proptest::collection::vec(change(), 1..5), |changes| {
        let text = changes.iter().fold(text.clone(), |text, change| apply(&text, change));
        if let Ok(mesh) = shadetree::scene::from_obj(&SourceText::new("a.obj", text)) {
            let count = u32::try_from(mesh.positions.len()).expect("small");
            prop_assert!(mesh.indices.iter().all(|i| *i < count));
            prop_assert!(mesh.positions.iter().all(|p| p.is_finite()));
        }
        Ok(())
    });
    result.unwrap_or_else(|e| panic!("{e}"));
}
