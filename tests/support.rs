//! What the tests share: loading examples, comparing with expected files, and proving modules.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use shadetree::compile::{Compiled, NamedGraph, Options, compile};
use shadetree::diagnostic::{Diagnostic, SourceText, has_errors};
use shadetree::graph::{self, Graph};
use shadetree::node::Catalog;

/// The package's folder.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The embedded catalogue, read once.
pub fn catalog() -> &'static Catalog {
    static CATALOG: OnceLock<Catalog> = OnceLock::new();
    CATALOG.get_or_init(Catalog::embedded)
}

/// Files with this extension below a folder of the package, sorted, as paths from the package's folder.
pub fn files(folder: &str, extension: &str) -> Vec<PathBuf> {
    let mut open = vec![root().join(folder)];
    let mut found = Vec::new();
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder of the package") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == extension) {
                found.push(path.strip_prefix(root()).expect("below").to_path_buf());
            }
        }
    }
    found.sort();
    found
}

/// A text of the package under its relative name.
pub fn text(path: &Path) -> Arc<SourceText> {
    let text = std::fs::read_to_string(root().join(path)).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    SourceText::new(path.display().to_string(), text)
}

fn load(path: &str, from: &str) -> Result<(String, Arc<Graph>), Vec<Diagnostic>> {
    let full = Path::new(from).parent().unwrap_or(Path::new("")).join(path);
    match graph::read(&text(&full)) {
        (Some(graph), found) if !has_errors(&found) => Ok((full.display().to_string(), Arc::new(graph))),
        (_, found) => Err(found),
    }
}

/// A graph file, flattened, under its stem.
pub fn graph_file(path: &Path) -> NamedGraph {
    let name = path.file_stem().expect("a stem").to_string_lossy().into_owned();
    graph_text(&name, &text(path))
}

/// A graph in a text, flattened. Panics with the diagnostics if it has errors.
pub fn graph_text(name: &str, source: &Arc<SourceText>) -> NamedGraph {
    let (graph, found) = graph::read(source);
    assert!(!has_errors(&found), "{}", show(&found));
    let (graph, found) = graph::expand(&graph.expect("no errors"), &load);
    assert!(!has_errors(&found), "{}", show(&found));
    NamedGraph { name: name.to_owned(), graph: graph.expect("no errors"), set: BTreeMap::new() }
}

/// Compiles and proves; panics with everything that is wrong.
pub fn compiled(graphs: &[NamedGraph], options: &Options) -> Compiled {
    let (compiled, found) = compile(graphs, catalog(), options);
    let names: Vec<&str> = graphs.iter().map(|g| g.name.as_str()).collect();
    let compiled = compiled.unwrap_or_else(|| panic!("{names:?}: {}", show(&found)));
    prove(&compiled, &format!("{names:?}"));
    compiled
}

/// naga accepts the module in full.
pub fn prove(compiled: &Compiled, what: &str) {
    if let Err(found) = shadetree::verify::verify(&compiled.module) {
        panic!("{what}: {}\n{}", show(&found), compiled.module.wgsl);
    }
}

/// Kinds of nodes of a category, sorted.
pub fn kinds(category: &str) -> Vec<String> {
    let of = |k: &&str| catalog().get(k).expect("listed").header().is_ok_and(|h| h.category == category);
    catalog().kinds().filter(of).map(str::to_owned).collect()
}

/// Diagnostics as people see them.
pub fn show(found: &[Diagnostic]) -> String {
    found.iter().map(|d| format!("{} {:?}: {} {:?} {:?}\n", d.code, d.place.node, d.message, d.help, d.notes)).collect()
}

/// Compares with an expected file, or writes it if `BLESS` is set (which CI refuses).
pub fn expect_file(path: &str, actual: &[u8]) {
    let full = root().join(path);
    if std::env::var_os("BLESS").is_some() {
        assert!(std::env::var_os("CI").is_none(), "BLESS is refused where CI is set");
        std::fs::create_dir_all(full.parent().expect("a folder")).expect("create the folder");
        if std::fs::read(&full).ok().as_deref() != Some(actual) {
            std::fs::write(&full, actual).expect("write the expected file");
        }
        return;
    }
    let expected =
        std::fs::read(&full).unwrap_or_else(|_| panic!("{path} is missing: run the tests with BLESS=1 and look at it"));
    if expected != actual {
        let (a, b) = (String::from_utf8_lossy(&expected), String::from_utf8_lossy(actual));
        let line =
            a.lines().zip(b.lines()).position(|(x, y)| x != y).unwrap_or(a.lines().count().min(b.lines().count()));
        let at = |t: &str| t.lines().nth(line).unwrap_or("<end>").to_owned();
        panic!(
            "{path} differs at line {}:\n  expected {}\n  actual   {}\n(BLESS=1 accepts it)",
            line + 1,
            at(&a),
            at(&b)
        );
    }
}

/// Expected files of a folder that no test made.
pub fn no_strays(folder: &str, extension: &str, known: &[String]) {
    for file in files(folder, extension) {
        let name = file.display().to_string();
        assert!(known.contains(&name), "{name} is expected by no test: remove it");
    }
}
