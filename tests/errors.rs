//! Every mistake that a person can make, as people are told of it: `tests/errors/AREA/NAME.*` beside `NAME.txt`.
//!
//! A file is a case: `.ron` is a graph or a scene, `.wgsl` a node file (a library below `library/`, a pass below
//! `pass/`), `.obj` a model. A folder is a case too, with its text beside it: the graphs in it are woven together, with the
//! node files in it as further nodes; folders in it hold subgraphs. A line `// output: visibility:NAME` chooses what is
//! seen, `// bake` makes parameters constants. Scenes go through `shadetree check` itself.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use shadetree::compile::{NamedGraph, Options, Output, compile};
use shadetree::diagnostic::{Diagnostic, Place, SourceText, has_errors};
use shadetree::graph::{self, Graph};
use shadetree::node::{Catalog, PassFile};
use shadetree::{explain, report, scene};

use crate::support::{catalog, expect_file, files, no_strays, root};

const FOLDER: &str = "tests/errors";

/// Codes that no case here can show, and why.
const ELSEWHERE: &[(&str, &str)] = &[];

/// All cases: files directly in an area, and folders there.
fn cases() -> Vec<PathBuf> {
    let entries = |folder: &Path| -> Vec<PathBuf> {
        let entries = std::fs::read_dir(folder).expect("a folder of cases");
        entries.map(|e| e.expect("an entry").path()).collect()
    };
    let areas = entries(&root().join(FOLDER)).into_iter().filter(|p| p.is_dir());
    let all = areas.flat_map(|area| entries(&area));
    let mut cases: Vec<PathBuf> = all.filter(|p| p.extension().is_none_or(|e| e != "txt")).collect();
    cases.sort();
    cases
}

/// The text under a name that is the same on every machine.
fn source(path: &Path) -> Arc<SourceText> {
    let name = path.strip_prefix(root().join(FOLDER)).expect("a case").display().to_string();
    SourceText::new(name, std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display())))
}

fn load(path: &str, from: &str) -> Result<(String, Arc<Graph>), Vec<Diagnostic>> {
    let full = root().join(FOLDER).join(from).parent().expect("a folder").join(path);
    let Ok(full) = full.canonicalize() else {
        return Err(vec![Diagnostic::error("ST0501", format!("cannot read `{path}`"), Place::file(path))]);
    };
    let (graph, found) = graph::read(&source(&full));
    let name = source(&full).name.clone();
    match graph {
        Some(graph) if !has_errors(&found) => Ok((name, Arc::new(graph))),
        _ => Err(found),
    }
}

/// What `// output: ...` and `// bake` in a text ask for.
fn options(texts: &[Arc<SourceText>]) -> Options {
    let mut options = Options::default();
    for line in texts.iter().flat_map(|t| t.text.lines()) {
        match line.strip_prefix("// output: ").map(|o| o.split_once(':').unwrap_or((o, ""))) {
            Some(("visibility", light)) => options.output = Output::Visibility(light.into()),
            Some(("normal", _)) => options.output = Output::Normal,
            Some((other, _)) => panic!("no output is called {other}"),
            None => options.bake |= line == "// bake",
        }
    }
    options
}

/// Reads, expands, weaves and proves, as far as it goes.
fn graphs(texts: &[Arc<SourceText>], catalog: &Catalog) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let mut graphs = Vec::new();
    for text in texts {
        let (graph, new) = graph::read(text);
        let usable = graph.filter(|_| !has_errors(&new));
        found.extend(new);
        let Some((graph, new)) = usable.map(|g| graph::expand(&g, &load)) else { continue };
        found.extend(new);
        let stem = Path::new(&text.name).file_stem().expect("a stem").to_string_lossy().into_owned();
        graphs.extend(graph.map(|graph| NamedGraph { name: stem, graph, set: BTreeMap::new() }));
    }
    if has_errors(&found) {
        return found;
    }
    let (compiled, new) = compile(&graphs, catalog, &options(texts));
    found.extend(new);
    if let Some(compiled) = compiled {
        found.extend(shadetree::verify::verify(&compiled.module).err().unwrap_or_default());
    }
    found
}

/// What a case is told, in the form of the command line without colours.
fn told(case: &Path) -> String {
    let area = case.parent().and_then(Path::file_name).expect("an area").to_string_lossy().into_owned();
    let extension = case.extension().map(|e| e.to_string_lossy().into_owned()).unwrap_or_default();
    let found = match extension.as_str() {
        "" => {
            let mut own = catalog().clone();
            let mut found = Vec::new();
            let inside = files(&case.strip_prefix(root()).expect("below").display().to_string(), "wgsl");
            for file in inside {
                let text = source(&root().join(file));
                found.extend(own.add_file(&text.name, &text.text));
            }
            let here = std::fs::read_dir(case).expect("a folder").map(|e| e.expect("an entry").path());
            let mut here: Vec<PathBuf> = here.filter(|p| p.extension().is_some_and(|e| e == "ron")).collect();
            here.sort();
            let texts: Vec<_> = here.iter().map(|p| source(p)).collect();
            found.extend(graphs(&texts, &own));
            found
        }
        "ron" if source(case).text.contains("\nScene") || source(case).text.starts_with("Scene") => {
            return checked(case);
        }
        "ron" => graphs(&[source(case)], catalog()),
        "obj" => scene::from_obj(&source(case)).err().unwrap_or_default(),
        "wgsl" if area == "library" => catalog().clone().add_library(&source(case).name, &source(case).text),
        "wgsl" if area == "pass" => PassFile::parse(&source(case)).err().unwrap_or_default(),
        "wgsl" => catalog().clone().add_file(&source(case).name, &source(case).text),
        other => panic!("{}: no reader for `.{other}`", case.display()),
    };
    let texts: Vec<String> = found.iter().map(|d| report::text(d, false)).collect();
    texts.join("\n")
}

/// What `shadetree check` says.
fn checked(case: &Path) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_shadetree"))
        .arg("check")
        .arg(case.strip_prefix(root().join(FOLDER)).expect("a case"))
        .current_dir(root().join(FOLDER))
        .env("NO_COLOR", "1")
        .output()
        .expect("the program runs");
    let text = String::from_utf8(output.stderr).expect("text");
    format!("{}\n", text.trim_end())
}

#[test]
fn every_mistake_is_told_as_expected() {
    let mut known = Vec::new();
    let mut wrong = Vec::new();
    for case in cases() {
        let name = case.with_extension("txt").strip_prefix(root()).expect("below").display().to_string();
        known.push(name.clone());
        let text = told(&case);
        assert!(!text.trim().is_empty(), "{} has no mistake", case.display());
        if std::panic::catch_unwind(|| expect_file(&name, text.as_bytes())).is_err() {
            wrong.push(name);
        }
    }
    assert!(wrong.is_empty(), "other than expected:\n{}", wrong.join("\n"));
    no_strays(FOLDER, "txt", &known);
}

#[test]
fn every_code_has_a_case() {
    let mut seen = BTreeSet::new();
    for file in files(FOLDER, "txt") {
        let text = std::fs::read_to_string(root().join(&file)).expect("readable");
        seen.extend(text.match_indices("[ST").filter_map(|(at, _)| Some(text.get(at + 1..at + 7)?.to_owned())));
    }
    let elsewhere: BTreeSet<&str> = ELSEWHERE.iter().map(|(code, _)| *code).collect();
    let missing: Vec<&str> = explain::entries()
        .iter()
        .map(|e| e.code)
        .filter(|code| *code < "ST0500" && !seen.contains(*code) && !elsewhere.contains(code))
        .collect();
    assert!(missing.is_empty(), "no case shows {missing:?}: add one to {FOLDER}");
    let needless: Vec<&&str> = elsewhere.iter().filter(|c| seen.contains(**c)).collect();
    assert!(needless.is_empty(), "{needless:?} have cases: take them off the list");
}
