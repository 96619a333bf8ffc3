//! Arrows between modules go one way. Reads the `crate::` paths of every source file against the table.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// What each module may use, directly.
const ALLOWED: &[(&str, &[&str])] = &[
    ("hash", &[]),
    ("markup", &[]),
    ("diagnostic", &[]),
    ("semantic", &["hash", "diagnostic"]),
    ("module", &["diagnostic", "semantic"]),
    ("ron", &["hash", "diagnostic", "semantic"]),
    ("graph", &["hash", "diagnostic", "semantic", "ron"]),
    ("node", &["hash", "diagnostic", "semantic", "module"]),
    ("weave", &["hash", "diagnostic", "semantic", "graph", "node", "compile"]),
    ("program", &["hash", "diagnostic", "semantic", "node", "weave", "module"]),
    ("plan", &["diagnostic", "semantic", "node", "weave", "program", "module"]),
    ("emit", &["hash", "diagnostic", "semantic", "node", "weave", "program", "plan", "module"]),
    ("compile", &["diagnostic", "semantic", "graph", "node", "weave", "program", "plan", "emit", "module"]),
    ("verify", &["diagnostic", "module"]),
    ("cost", &["verify", "module"]),
    ("export", &["diagnostic", "verify", "module"]),
    ("reflect", &["semantic", "module", "plan", "compile", "export", "verify"]),
    ("report", &["diagnostic"]),
    ("explain", &["ron", "graph", "node", "scene", "study", "choose"]),
    ("scene", &["diagnostic", "semantic", "ron"]),
    ("reference", &["scene"]),
    ("choose", &["hash", "scene", "reference"]),
    ("view", &["hash", "markup", "diagnostic", "semantic", "graph", "node", "weave", "compile"]),
    ("render", &["semantic", "module", "plan", "scene", "compile"]),
    (
        "studio",
        &[
            "diagnostic",
            "semantic",
            "ron",
            "graph",
            "node",
            "weave",
            "module",
            "compile",
            "verify",
            "scene",
            "reference",
            "choose",
            "render",
            "view",
        ],
    ),
    ("study", &["diagnostic", "ron", "graph", "node", "weave", "compile", "scene", "reference", "render", "studio"]),
    ("chart", &["markup", "reference", "study"]),
    (
        "simplify",
        &[
            "cost",
            "diagnostic",
            "semantic",
            "graph",
            "node",
            "weave",
            "compile",
            "scene",
            "render",
            "view",
            "studio",
            "study",
        ],
    ),
    ("preview", &["cost", "diagnostic", "node", "compile", "scene", "reference", "render", "studio"]),
    (
        "gui",
        &[
            "cost",
            "diagnostic",
            "semantic",
            "graph",
            "node",
            "compile",
            "verify",
            "export",
            "explain",
            "report",
            "scene",
            "render",
            "view",
            "studio",
            "preview",
        ],
    ),
];

fn sources(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a readable folder") {
        let path = entry.expect("a readable entry").path();
        if path.is_dir() {
            sources(&path, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
}

/// The top module of a file: its folder below `src/`, or its stem.
fn module_of(path: &Path, src: &Path) -> String {
    let below = path.strip_prefix(src).expect("below src");
    let first = below.components().next().expect("not src itself").as_os_str().to_string_lossy().into_owned();
    first.trim_end_matches(".rs").to_owned()
}

/// The code without comments and without a test module at its end: tests may look at anything.
fn code(text: &str) -> String {
    let shipped = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    shipped.lines().filter(|l| !l.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n")
}

/// Modules that `crate::` paths name, also in a list: `use crate::{a, b::C}`.
fn used(code: &str) -> BTreeSet<String> {
    let name = |text: &str| text.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut found = BTreeSet::new();
    for (at, path) in code.match_indices("crate::") {
        let rest = &code[at + path.len()..];
        let Some(list) = rest.strip_prefix('{') else {
            found.insert(name(rest));
            continue;
        };
        let (mut depth, mut start) = (0, 0);
        for (i, c) in list.char_indices() {
            match c {
                '{' => depth += 1,
                '}' if depth == 0 => {
                    found.insert(name(&list[start..i]));
                    break;
                }
                '}' => depth -= 1,
                ',' if depth == 0 => {
                    found.insert(name(&list[start..i]));
                    start = i + 1;
                }
                _ => {}
            }
        }
    }
    found.retain(|n| !n.is_empty());
    found
}

#[test]
fn arrows_go_one_way() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let allowed: BTreeMap<&str, &[&str]> = ALLOWED.iter().copied().collect();
    let mut files = Vec::new();
    sources(&src, &mut files);
    files.sort();
    let mut wrong = Vec::new();
    let mut seen = BTreeSet::new();
    for path in &files {
        let module = module_of(path, &src);
        seen.insert(module.clone());
        let is_test = path.components().any(|c| c.as_os_str().to_string_lossy().contains("tests"))
            || path.file_stem().is_some_and(|s| s.to_string_lossy().ends_with("checks"));
        // The command line stands on everything; the others are no part of the library's layers.
        if is_test || matches!(module.as_str(), "cli" | "lib" | "main" | "build") {
            continue;
        }
        let Some(may) = allowed.get(module.as_str()) else {
            wrong.push(format!("`{module}` is not in the table"));
            continue;
        };
        let text = std::fs::read_to_string(path).expect("a readable file");
        for used in used(&code(&text)) {
            if used != module && !may.contains(&used.as_str()) {
                wrong.push(format!("{} uses crate::{used}", path.strip_prefix(&src).unwrap_or(path).display()));
            }
        }
    }
    let gone: Vec<_> = allowed.keys().filter(|m| !seen.contains(**m)).collect();
    assert!(gone.is_empty(), "the table names modules that do not exist: {gone:?}");
    assert!(wrong.is_empty(), "arrows against the order:\n{}", wrong.join("\n"));
}

#[test]
fn paths_are_read_in_every_spelling() {
    let found = used("use crate::a::B;\nuse crate::{c, d::{E, F}, g};\nlet x = crate::h::i();");
    assert_eq!(found.into_iter().collect::<Vec<_>>(), ["a", "c", "d", "g", "h"]);
    assert_eq!(code("use crate::a;\n// crate::b\n#[cfg(test)]\nmod tests { use crate::c; }"), "use crate::a;");
}
