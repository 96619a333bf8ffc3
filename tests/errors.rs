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

use shadetree::compile::{NamedGraph, Options, Output, compile, locate};
use shadetree::diagnostic::{Diagnostic, Place, SourceText, has_errors};
use shadetree::graph::{self, Graph};
use shadetree::node::{Catalog, PassFile};
use shadetree::semantic::Value;
use shadetree::{explain, report, scene, study};

use crate::support::{catalog, expect_file, files, no_strays, root};

const FOLDER: &str = "tests/errors";

/// Codes that no case here can show, and why.
const ELSEWHERE: &[(&str, &str)] = &[
    ("ST0068", "only where whoever loads subgraphs fails without saying why; the command line always says"),
    ("ST0423", "needs four million lines"),
];

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
        let error = Diagnostic::error("ST0501", format!("cannot read `{path}`"), Place::file(path));
        return Err(vec![error.help("check the path")]);
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
        let errors = shadetree::verify::verify(&compiled.module).err().unwrap_or_default();
        found.extend(errors.into_iter().map(|e| locate(e, &graphs)));
    }
    found
}

/// What a case is told, in the form of the command line without colours.
fn told(case: &Path) -> String {
    let area = case.parent().and_then(Path::file_name).expect("an area").to_string_lossy().into_owned();
    let extension = case.extension().map(|e| e.to_string_lossy().into_owned()).unwrap_or_default();
    let is_scene = |case: &Path| source(case).text.lines().any(|line| line.starts_with("Scene("));
    match extension.as_str() {
        "" => show(&folder(case)),
        "ron" if area == "study" => show(&study::read::read(&source(case)).1),
        "ron" if area == "check" || is_scene(case) => checked(case),
        "ron" => show(&graphs(&[source(case)], catalog())),
        "obj" => show(&scene::from_obj(&source(case)).err().unwrap_or_default()),
        "wgsl" if area == "library" => show(&catalog().clone().add_library(&source(case).name, &source(case).text)),
        "wgsl" if area == "pass" => show(&PassFile::parse(&source(case)).err().unwrap_or_default()),
        "wgsl" => show(&catalog().clone().add_file(&source(case).name, &source(case).text)),
        other => panic!("{}: no reader for `.{other}`", case.display()),
    }
}

/// Graphs that are woven together, with nodes of their own.
fn folder(case: &Path) -> Vec<Diagnostic> {
    let mut own = catalog().clone();
    let mut found = Vec::new();
    for file in files(&case.strip_prefix(root()).expect("below").display().to_string(), "wgsl") {
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

fn show(found: &[Diagnostic]) -> String {
    let texts: Vec<String> = found.iter().map(|d| report::text(d, false)).collect();
    texts.join("\n")
}

/// Texts that are too large to keep, and graphs that no text gives.
fn made() -> Vec<(&'static str, Vec<Diagnostic>)> {
    let graph = |nodes: &str| SourceText::new("made.ron", format!("Graph(version: 1, nodes: {{\n{nodes}}})\n"));
    let many = |count: usize, node: &str| (0..count).map(|i| format!("\"n{i}\": {node},\n")).collect::<String>();
    let read = |text: &Arc<SourceText>| graph::read(text).1;
    let scene = |text: String| scene::read(&SourceText::new("made.ron", text)).1;

    let sums = many(4097, "(kind: \"add\", params: {\"a\": (0, 0, 0, 0), \"b\": (1, 2, 3, 4)})");
    let links: String = (1..4097).map(|i| format!("\"n{} -> n{i}.a\",\n", i - 1)).collect();
    let chain = format!("Graph(version: 1, nodes: {{\n{sums}}}, links: [\n{links}])\n");

    let mut cycle = Graph::default();
    for (name, other) in [("a", "b"), ("b", "a")] {
        cycle.nodes.insert(name.into(), graph::Node { kind: "sine".into(), ..Default::default() });
        cycle.links.push(graph::Link::new(graph::End::node(name), graph::End::node(other)));
    }
    let cycle = [NamedGraph { name: "made".into(), graph: cycle, set: BTreeMap::new() }];

    let flat = graph::read(&graph("\"flat\": (kind: \"unlit\"),")).0.expect("a graph");
    let values = [("flt.color", 1.0), ("flat.colour", 1.0), ("flat.color", -1.0), ("flat", 1.0)];
    let set = values.map(|(path, x)| (path.to_owned(), Value::Numbers(vec![x]))).into();
    let set = [NamedGraph { name: "made".into(), graph: flat, set }];

    let sphere = "(shape: Sphere(radius: 1), surface: \"matte.ron\")";
    let camera = "camera: (position: (0, 0, 5), target: (0, 0, 0), fov: 40)";
    let objects = many(20_001, sphere);
    let study = |text: &str| shadetree::study::sheet::read(&SourceText::new("made.ron", text)).1;
    let claims = "Study(claims: [\n\
        (id: \"H1\", kind: \"constnat\", time: \"mian\", over: \"size\"),\n\
        (kind: \"constant\", time: \"main\", within: -1, methods: [\"PCF\"]),\n\
        (id: \"H2\", kind: \"constant\", time: \"main\", over: \"size\"),\n\
        (id: \"H3\", kind: \"crossing\", time: \"main\", over: \"size\", least: 0.5, methods: [\"PCF\"]),\n\
        (id: \"H3\", kind: \"grows\", time: \"main\", over: \"size\", frame: (0, 480), colour: 1)])\n";
    let published = "Study(published: [\n\
        (title: \"T\", unit: \"hz\", plain: \"None\", columns: [\"64\"], rows: {\"PCF\": [1, 2], \"VSM\": [0]}),\n\
        (title: \"U\", plain: \"PCF\", vary: \"frame\", columns: [\"64\"], rows: {\"PCF\": [1]})])\n";
    let results = |text: &str| shadetree::study::folder::parse(&SourceText::new("results.jsonl", text)).1;
    vec![
        ("claims", study(claims)),
        ("cycle", compile(&cycle, catalog(), &Options::default()).1),
        ("no_study", study("Graph(version: 1)\n")),
        ("nodes", read(&graph(&many(20_001, "(kind: \"value\")")))),
        ("not_a_scene", scene("Stage(version: 1)\n".into())),
        ("published", study(published)),
        ("results", results("{\"version\": 1}\nnothing\n{\"version\": 1, \"ce")),
        ("results_version", results("{\"version\": 7}\n")),
        ("objects", scene(format!("Scene(version: 1, {camera}, objects: {{\n{objects}}})\n"))),
        ("set", compile(&set, catalog(), &Options::default()).1),
        ("parameters", graphs(&[SourceText::new("made.ron", chain)], catalog())),
        ("values", read(&SourceText::new("made.ron", format!("Graph(nodes: [\n{}])\n", "0,\n".repeat(1_000_001))))),
    ]
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
    let below = |path: &Path| path.strip_prefix(root()).expect("below").display().to_string();
    let mut all: Vec<(String, String)> =
        cases().iter().map(|case| (below(&case.with_extension("txt")), told(case))).collect();
    all.extend(made().iter().map(|(name, found)| (format!("{FOLDER}/made/{name}.txt"), show(found))));
    let mut wrong = Vec::new();
    for (name, text) in &all {
        if text.trim().is_empty() {
            wrong.push(format!("{name}: the case has no mistake"));
        } else if std::panic::catch_unwind(|| expect_file(name, text.as_bytes())).is_err() {
            wrong.push(format!("{name}: another text"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let known: Vec<String> = all.into_iter().map(|(name, _)| name).collect();
    no_strays(FOLDER, "txt", &known);
}

/// A remedy stands with each mistake, but for what naga says in its own words.
#[test]
fn every_mistake_comes_with_a_remedy() {
    let mut without = Vec::new();
    for file in files(FOLDER, "txt") {
        let text = std::fs::read_to_string(root().join(&file)).expect("readable");
        let starts = text.match_indices("[ST").map(|(at, _)| at).chain([text.len()]).collect::<Vec<_>>();
        for block in starts.windows(2).map(|w| &text[w[0]..w[1]]) {
            if !block.contains("= help: ") && !block.starts_with("[ST0126]") && !block.starts_with("[ST0127]") {
                without.push(format!("{}: {}", file.display(), block.lines().next().unwrap_or_default()));
            }
        }
    }
    assert!(without.is_empty(), "no remedy:\n{}", without.join("\n"));
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

/// A path in a parameter counts from the file that says it, also where the parameter is one of a subgraph.
#[test]
fn paths_count_from_the_file_that_says_them() {
    let inner = "Graph(version: 1, nodes: {\"picture\": (kind: \"image\", params: {\"image\": \"own.png\"})}, \
                 expose: (inputs: {\"image\": \"picture.image\"}, outputs: {\"color\": \"picture.color\"}))";
    let outer = "Graph(version: 1, nodes: {\"flat\": (kind: \"unlit\"), \
                 \"set\": (graph: \"lib/inner.ron\", params: {\"image\": \"given.png\"}), \
                 \"unset\": (graph: \"lib/inner.ron\"), \"mix\": (kind: \"mix_color\")}, \
                 links: [\"set -> mix.a\", \"unset -> mix.b\", \"mix -> flat.color\"])";
    let load = |_: &str, _: &str| {
        let (graph, found) = graph::read(&SourceText::new("lib/inner.ron", inner));
        graph.map(|graph| ("lib/inner.ron".to_owned(), Arc::new(graph))).ok_or(found)
    };
    let graph = graph::read(&SourceText::new("outer.ron", outer)).0.expect("a graph");
    let graph = graph::expand(&graph, &load).0.expect("expanded");
    let named = NamedGraph { name: "outer".into(), graph, set: BTreeMap::new() };
    let compiled = crate::support::compiled(&[named], &Options::default());
    let images: BTreeSet<(String, String)> = compiled
        .module
        .bindings
        .iter()
        .filter_map(|b| match &b.resource {
            shadetree::module::Resource::Image { path, base, .. } => Some((path.clone(), base.clone())),
            _ => None,
        })
        .collect();
    let expected = [("given.png", "outer.ron"), ("own.png", "lib/inner.ron")];
    assert_eq!(images, expected.map(|(path, base)| (path.to_owned(), base.to_owned())).into());
}
