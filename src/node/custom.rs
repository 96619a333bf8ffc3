//! Nodes whose WGSL stands in the graph file itself.

use std::sync::Arc;

use super::catalog::Catalog;
use super::check::{check, guard, is_builtin};
use super::definition::{Choices, Definition};
use super::file::{self, resolve};
use super::header;
use super::report::Report;
use crate::diagnostic::{Diagnostic, Place, SourceText};

/// The largest WGSL text inside a graph, in bytes.
const MAX_TEXT: usize = 64 << 10;

/// The definition of the node `name` from its own WGSL.
///
/// The function called `name` is the one called, or else the last function of the text; the definition's kind is that
/// function's name. Port lines are welcome but not needed: a port without one has no default and means no more than
/// its shape. Header lines (`//! use: ...`, `//! option ...`) work as in files. Places in errors are lines and columns
/// of the WGSL text, under the name `<graph file>:<node>`.
///
/// # Errors
/// Everything that is wrong with the text.
pub fn custom(
    name: &str,
    text: &str,
    source: &Arc<SourceText>,
    choices: &Choices,
    catalog: &Catalog,
) -> Result<Arc<Definition>, Vec<Diagnostic>> {
    let own = SourceText::new(format!("{}:{name}", source.name), text);
    read(name, &own, choices, catalog).map(Arc::new).map_err(|mut found| {
        for diagnostic in &mut found {
            diagnostic.place.node = Some(name.to_owned());
        }
        found
    })
}

fn read(
    name: &str,
    source: &Arc<SourceText>,
    choices: &Choices,
    catalog: &Catalog,
) -> Result<Definition, Vec<Diagnostic>> {
    let mut report = Report::new(source);
    if let Some((range, message)) = guard(&source.text, MAX_TEXT) {
        report.error("ST0130", range, message);
        return Err(report.found);
    }
    let (mut header, mut found) = header::parse(source, false);
    if header.label.is_empty() {
        header.label = name.to_owned();
    }
    if header.category.is_empty() {
        header.category = "custom".to_owned();
    }
    found.extend(catalog.unknown_libraries(&header));
    if !found.is_empty() {
        return Err(found);
    }
    let choices = resolve(&header.options, choices, Place::file(&source.name))?;
    let applied = file::apply(&mut report, &header.options, &choices);
    let functions = || applied.declarations.iter().filter(|d| d.keyword == "fn" && !d.name.ends_with("_ambient"));
    let Some(main) = functions().find(|d| d.name == name).or_else(|| functions().next_back()) else {
        if report.found.is_empty() {
            report.error("ST0121", 0..0, "the text has no function").help("write `fn name(a: f32) -> f32 { ... }`");
        }
        return Err(report.found);
    };
    let mut taken = Report::new(source);
    for declaration in &applied.declarations {
        let owner = || {
            let holds =
                |l: &&str| catalog.library(l).is_some_and(|l| l.items.iter().any(|i| i.name == declaration.name));
            catalog.library_names().find(holds).map(|l| format!("the library `{l}`"))
        };
        let by = if is_builtin(&declaration.name) { Some("WGSL".to_owned()) } else { owner() };
        if let Some(by) = by {
            let place = applied.kept.original_range(declaration.name_range.clone());
            taken
                .error("ST0131", place, format!("`{}` is a name that {by} uses", declaration.name))
                .help("give it another name");
        }
    }
    let defined = file::define(&main.name, &Arc::new(header), choices, false);
    match defined {
        Ok(definition) if taken.found.is_empty() => {
            let found = check(&catalog.libraries_of(&definition), &applied.kept, source);
            if found.is_empty() { Ok(definition) } else { Err(found) }
        }
        Ok(_) => Err(taken.found),
        Err(mut found) => {
            found.extend(taken.found);
            Err(found)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::semantic::{Kind, Shape};

    fn run(text: &str) -> Result<Arc<Definition>, Vec<String>> {
        let mut catalog = Catalog::default();
        assert!(catalog.add_library("lib/tools.wgsl", "fn twice(x: f32) -> f32 { return 2.0 * x; }").is_empty());
        custom("bend", text, &SourceText::new("g.json", ""), &Choices::new(), &catalog).map_err(|found| {
            let line = |d: Diagnostic| {
                assert_eq!(d.place.node.as_deref(), Some("bend"));
                let at = d.place.span.as_ref().map_or((0, 0), crate::diagnostic::Span::line_column);
                format!("{} {}:{} {} {:?}", d.code, at.0, at.1, d.message, d.notes)
            };
            found.into_iter().map(line).collect()
        })
    }

    #[test]
    fn ports_without_lines_mean_their_shape() {
        let d =
            run("fn helper(x: f32) -> f32 { return x; }\nfn some(a: vec3f, b: bool) -> f32 { return a.x; }").unwrap();
        assert_eq!((d.kind.as_str(), d.items.len(), d.header.label.as_str()), ("some", 2, "bend"));
        assert_eq!(d.main.inputs[0].ty.meaning.kind, Kind::Number);
        assert_eq!(d.main.inputs[1].ty.meaning.kind, Kind::Bool);
        assert_eq!((d.main.outputs[0].name.as_str(), &d.main.outputs[0].ty.shape), ("value", &Shape::F32(1)));
    }

    #[test]
    fn lines_and_libraries_are_heard() {
        let d = run("//! use: tools\n/// Prose.\n/// x (angle; = 90; in deg): Turn.\n/// -> y (scalar): Out.\n\
                     fn bend(x: f32) -> f32 { return twice(x); }\nfn other() -> f32 { return 1.0; }")
        .unwrap();
        assert_eq!((d.kind.as_str(), d.main.inputs[0].unit.as_str()), ("bend", "deg"));
        assert_eq!(d.main.outputs[0].name, "y");
    }

    #[test]
    fn mistakes_are_placed_in_the_text() {
        for (text, expected) in [
            ("fn bend(x: f32) -> f32 {\n  return y;\n}", "ST0126 2:10"),
            ("fn bend(x: f32) -> f32 {\n  return vec3f(x);\n}", "ST0127 2:"),
            ("fn normalize(x: f32) -> f32 { return x; }", "ST0131 1:4"),
            ("fn twice(x: f32) -> f32 { return x; }", "ST0131 1:4"),
            ("var<private> p: f32;\nfn bend() -> f32 { return p; }", "ST0125 1:14"),
            ("@group(0) @binding(0) var t: texture_2d<f32>;\nfn bend() -> f32 { return 1.0; }", "ST0125 1:27"),
            ("@fragment fn bend() -> @location(0) vec4f { return vec4f(); }", "ST0125 1:14"),
            ("fn bend(static: f32) -> f32 { return 1.0; }", "ST0120 1:9"),
            ("fn bend() { }", "ST0135 1:4"),
            ("const A = 1;", "ST0121"),
            ("fn bend(", "ST0124"),
            ("//! use: nothing\nfn bend() -> f32 { return 1.0; }", "ST0128 1:10"),
            ("", "ST0121"),
        ] {
            let found = run(text).unwrap_err();
            assert!(found[0].starts_with(expected), "{text}: {found:?}");
        }
    }

    #[test]
    fn hostile_texts_end_in_errors() {
        let nest = format!("fn bend() -> f32 {{ return {}1.0{}; }}", "(".repeat(5000), ")".repeat(5000));
        assert!(run(&nest).unwrap_err()[0].starts_with("ST0130"));
        assert!(run(&" ".repeat(70_000)).unwrap_err()[0].starts_with("ST0130"));
        assert!(run(&format!("fn bend() -> f32 {{ return {}1.0; }}", "-".repeat(60_000))).is_err());
        assert!(run("/* fn bend() -> f32 { return 1.0; }").is_err());
        assert!(run("fn bend() -> f32 { return bend(); }").is_err());
    }
}
