//! Every example graph: canonical on disk, compiles to the expected WGSL, the same for any order of its lines.

use shadetree::compile::{Options, Output};
use shadetree::diagnostic::SourceText;
use shadetree::graph;

use crate::support::{compiled, expect_file, files, graph_file, graph_text, no_strays, text};
use crate::tint;

fn examples() -> Vec<std::path::PathBuf> {
    let mut all = files("graphs/lights", "ron");
    all.extend(files("graphs/surfaces", "ron"));
    all.extend(files("graphs/lib", "ron"));
    all
}

#[test]
fn examples_are_canonical() {
    for path in examples() {
        let source = text(&path);
        let (graph, found) = graph::read(&source);
        assert!(found.is_empty(), "{}: {found:?}", path.display());
        assert_eq!(graph::write(&graph.expect("no errors")), source.text, "{}", path.display());
    }
}

#[test]
fn examples_give_the_expected_wgsl() {
    let mut known = Vec::new();
    for path in examples() {
        let module = compiled(&[graph_file(&path)], &Options::default()).module;
        let name =
            format!("tests/golden/{}", path.strip_prefix("graphs").expect("below").with_extension("wgsl").display());
        expect_file(&name, module.wgsl.as_bytes());
        known.push(name);
    }
    let pair =
        [graph_file("graphs/lights/spot_vsm.ron".as_ref()), graph_file("graphs/surfaces/bumpy_glass.ron".as_ref())];
    let name = "tests/golden/woven/spot_vsm+bumpy_glass.wgsl";
    expect_file(name, compiled(&pair, &Options::default()).module.wgsl.as_bytes());
    known.push(name.to_owned());
    // Lights, shadows and surfaces where others take them as values.
    for path in files("tests/golden/woven", "ron") {
        let module = compiled(&[graph_file(&path)], &Options::default()).module;
        let name = path.with_extension("wgsl").display().to_string();
        expect_file(&name, module.wgsl.as_bytes());
        known.push(name);
    }
    no_strays("tests/golden", "wgsl", &known);
    let texts: Vec<(String, String)> = known.iter().map(|n| (n.clone(), text(n.as_ref()).text.clone())).collect();
    if let Some(complaints) = tint::complaints(texts.iter().map(|(n, t)| (n.as_str(), t.as_str()))) {
        assert!(complaints.is_empty(), "{}", complaints.join("\n"));
    }
}

/// Compiling again, and from a file whose lines are in another order, gives the same bytes.
#[test]
fn output_does_not_depend_on_order() {
    for path in examples() {
        let source = text(&path);
        let first = compiled(&[graph_file(&path)], &Options::default());
        assert_eq!(first, compiled(&[graph_file(&path)], &Options::default()), "{}", path.display());
        let reversed = reverse_entries(&source.text);
        let again = compiled(
            &[graph_text(&graph_file(&path).name, &SourceText::new(source.name.clone(), reversed))],
            &Options::default(),
        );
        assert_eq!(first, again, "{}", path.display());
    }
}

/// The text with the lines of each list and map of the root in reverse order (canonical files have an entry a line).
fn reverse_entries(text: &str) -> String {
    let mut out = String::new();
    let mut block: Vec<&str> = Vec::new();
    let mut entries: Vec<String> = Vec::new();
    let flush = |entries: &mut Vec<String>, out: &mut String| {
        entries.drain(..).rev().for_each(|e| out.push_str(&e));
    };
    for line in text.split_inclusive('\n') {
        let depth = line.len() - line.trim_start().len();
        if depth >= 8 {
            block.push(line);
            // An entry ends where a line at its own depth ends with a comma.
            if depth == 8 && line.trim_end().ends_with(',') {
                entries.push(block.concat());
                block.clear();
            }
        } else {
            flush(&mut entries, &mut out);
            out.push_str(&block.concat());
            block.clear();
            out.push_str(line);
        }
    }
    out
}

/// Every byte of the fragment stage that a node is responsible for says so, and other outputs weave as well.
#[test]
fn every_output_weaves() {
    let graphs = || {
        [graph_file("graphs/lights/two_shadows.ron".as_ref()), graph_file("graphs/surfaces/bumpy_glass.ron".as_ref())]
    };
    for output in
        [Output::Normal, Output::Depth, Output::Visibility("spot".into()), Output::Irradiance("two_shadows".into())]
    {
        let module = compiled(&graphs(), &Options { output: output.clone(), ..Options::default() }).module;
        assert!(module.wgsl.contains("fn fs_main"), "{output:?}");
    }
    let module = compiled(&graphs(), &Options::default()).module;
    for node in ["bumpy_glass/bump", "bumpy_glass/glass", "two_shadows/spot"] {
        assert!(module.source_map.iter().any(|o| *o.node == *node), "{node} is not in the source map");
    }
    for origin in &module.source_map {
        assert!(module.wgsl.get(origin.start..origin.end).is_some(), "{origin:?}");
    }
}

/// Baked parameters leave no uniform behind, except what the spaces of maps are made from.
#[test]
fn baking_leaves_constants() {
    let module =
        compiled(&[graph_file("graphs/surfaces/marble.ron".as_ref())], &Options { bake: true, ..Options::default() })
            .module;
    assert!(module.parameters.is_empty() && !module.wgsl.contains("parameters."), "{}", module.wgsl);
}

/// A layer without lights of its own is lit as what lies under it; every light counts once, with its own shadows.
#[test]
fn layers_are_lit_as_what_lies_under_them() {
    let text = r#"Graph(version: 1, nodes: {
        "spot": (kind: "spot_light"), "lamp": (kind: "point_light"), "a": (kind: "hard_shadow"), "b": (kind: "variance_shadow"),
        "matte": (kind: "lambert"), "shiny": (kind: "ggx"), "both": (kind: "mix_surface"), "coat": (kind: "clear_coat"),
    }, links: [
        "spot -> a", "spot -> b", "a -> matte", "b -> matte", "lamp -> shiny", "matte -> both.first", "shiny -> both.second",
        "both -> coat",
    ])"#;
    let wgsl = compiled(&[graph_text("layers", &SourceText::new("layers.ron", text))], &Options::default()).module.wgsl;
    let body = &wgsl[wgsl.find("fn fs_main").expect("a fragment stage")..];
    assert!(body.contains("spot.irradiance * a_visibility * b_visibility"), "{body}");
    assert_eq!(body.matches(" = clear_coat(").count(), 2, "{body}");
    assert_eq!(body.matches(" = lambert(").count(), 1, "{body}");
    assert_eq!(body.matches(" = ggx(").count(), 1, "{body}");
    assert!(
        body.contains("coat_lamp_radiance + coat_ambient_radiance")
            || body.contains("coat_spot_radiance + coat_ambient_radiance"),
        "{body}"
    );
}

/// What fed a muted node feeds what it fed, through any number of them.
#[test]
fn muted_nodes_are_passed_over() {
    let text = |muted: &str, link: &str| {
        format!(
            r#"Graph(version: 1, nodes: {{
                "spot": (kind: "spot_light"), "vsm": (kind: "variance_shadow"{muted}), "pcf": (kind: "pcf_shadow"{muted}),
                "matte": (kind: "lambert"),
            }}, links: [{link}])"#
        )
    };
    let all = r#""spot -> vsm", "vsm -> pcf", "pcf -> matte""#;
    let muted = graph_text("muted", &SourceText::new("muted.ron", text(", muted: true", all)));
    let plain = graph_text("muted", &SourceText::new("muted.ron", text(", muted: true", r#""spot -> matte""#)));
    let wgsl = compiled(&[muted], &Options::default()).module.wgsl;
    assert_eq!(wgsl, compiled(&[plain], &Options::default()).module.wgsl);
    assert!(!wgsl.contains("shadow") && wgsl.contains("spot.irradiance"), "{wgsl}");
}

/// A stage of thousands of lines is shared out over functions, so that compilers need no quadratic time. What crosses
/// from one to another is written once, before it is read.
#[test]
fn long_stages_are_shared_out() {
    use std::fmt::Write as _;
    let mut nodes = String::from(
        r#""spot": (kind: "spot_light"), "vsm": (kind: "variance_shadow"), "body": (kind: "lambert"), "side": (kind: "front_facing"),
        "split_place": (kind: "separate3"), "n0": (kind: "perlin3d"), "last": (kind: "combine3"), "place": (kind: "position"),"#,
    );
    let mut links = String::from(
        r#""spot -> vsm", "vsm -> body", "place -> split_place", "last -> body.albedo", "split_place.x -> last.x", "n0 -> last.y","#,
    );
    for i in 1..1500 {
        let _ = write!(nodes, "\"n{i}\": (kind: \"{}\"),", ["multiply", "sine", "smooth_step"][i % 3]);
        let _ = write!(links, "\"n{} -> n{i}\",", i - 1);
    }
    let text = format!("Graph(version: 1, nodes: {{{nodes}}}, links: [{links} \"n1499 -> last.z\"], output: \"body\")");
    let module = compiled(&[graph_text("long", &SourceText::new("long.ron", text))], &Options::default()).module;
    let wgsl = &module.wgsl;
    assert!(wgsl.contains("    part_1(in);\n    part_2(in);\n"), "{}", &wgsl[wgsl.len() - 400..]);
    let longest = wgsl.split("\nfn ").map(|f| f.matches("    let ").count()).max();
    assert!(longest <= Some(128), "{longest:?} lines in one function");
    let variables: Vec<&str> =
        wgsl.lines().filter_map(|l| l.strip_prefix("var<private> ")?.split(':').next()).collect();
    assert!(variables.len() >= 3, "{variables:?}");
    for name in variables {
        let written = format!("    {name} = ");
        assert_eq!(wgsl.matches(&written).count(), 1, "{name}");
        // Members and the declaration itself are no reads.
        let is_use = |at: usize| !wgsl[..at].ends_with('.') && !wgsl[..at].ends_with("var<private> ");
        let words = shadetree::node::tokenize(wgsl).into_iter().filter(|t| t.text(wgsl) == name);
        let first = words.map(|t| t.range.start).find(|at| is_use(*at));
        assert_eq!(first, wgsl.find(&written).map(|at| at + 4), "{name} is read before it is written");
    }
    if let Some(complaints) = tint::complaints([("long", wgsl.as_str())]) {
        assert!(complaints.is_empty(), "{}", complaints.join("\n"));
    }
}

/// The host writes values where the device reads them, also where hundreds of members stand in groups.
#[test]
fn parameters_lie_where_the_module_says() {
    let mut nodes = String::from("\"last\": (kind: \"unlit\"),");
    let mut links = String::new();
    for i in 0..300 {
        let (kind, port, value) = [
            ("mix_color", "a", "(1, 0, 0)"),
            ("choose", "condition", "true"),
            ("vector3", "vector", "(1, 2, 3)"),
            ("smooth_step", "x", "0.5"),
        ][i % 4];
        nodes.push_str(&format!("\"n{i}\": (kind: \"{kind}\", params: {{\"{port}\": {value}}}),"));
        nodes.push_str(&format!("\"sum{i}\": (kind: \"add\"),"));
        links.push_str(&format!("\"n{i} -> sum{i}.a\","));
        if i > 0 {
            links.push_str(&format!("\"sum{} -> sum{i}.b\",", i - 1));
        }
    }
    let many = format!("Graph(version: 1, nodes: {{{nodes}}}, links: [{links} \"sum299 -> last.color\"])");
    let mut graphs = vec![graph_text("many", &SourceText::new("many.ron", many))];
    graphs.extend(examples().iter().map(|path| graph_file(path)));
    for (index, graph) in graphs.into_iter().enumerate() {
        let name = graph.name.clone();
        let module = compiled(&[graph], &Options::default()).module;
        assert!(
            index > 0 || module.wgsl.contains("struct ParameterGroup3 {"),
            "{} parameters",
            module.parameters.len()
        );
        let verified = shadetree::verify::verify(&module).expect("sound WGSL").module;
        let mut found = Vec::new();
        let mut bytes = 0;
        for (_, ty) in verified.types.iter().filter(|(_, ty)| ty.name.as_deref() == Some("Parameters")) {
            let naga::TypeInner::Struct { members, span } = &ty.inner else { panic!("{ty:?}") };
            bytes = span.next_multiple_of(16);
            for member in members {
                let outer = member.name.clone().expect("a name");
                match &verified.types[member.ty].inner {
                    naga::TypeInner::Struct { members, .. } => found.extend(members.iter().map(|inner| {
                        (format!("{outer}.{}", inner.name.as_deref().expect("a name")), member.offset + inner.offset)
                    })),
                    _ => found.push((outer, member.offset)),
                }
            }
        }
        let said: Vec<(String, u32)> = module.parameters.iter().map(|p| (p.name.clone(), p.offset)).collect();
        assert_eq!(said, found, "{name}");
        assert_eq!(module.parameter_bytes, bytes, "{name}");
    }
}
