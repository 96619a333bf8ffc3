use std::collections::BTreeSet;
use std::sync::Arc;

use super::{catalog, clean, set};
use crate::compile::{NamedGraph, Options, compile};
use crate::graph::{self, Graph, apply, expand};
use crate::view::commands::make_subgraph;

const LIT: &str = r#"Graph(version: 1, nodes: {
        "ball": (kind: "ggx", params: {"metallic": 0.5}),
        "bump": (kind: "bump", params: {"amplitude": 0.01}),
        "noise": (kind: "fbm3d", params: {"scale": 6}, options: {"octaves": "3"}),
        "ramp": (kind: "color_ramp2", params: {"high": (0.8, 0.1, 0.1)}),
        "spot": (kind: "spot_light"),
        "shade": (kind: "pcf_shadow"),
        "time": (kind: "wave"),
    },
    links: ["bump -> ball", "noise -> bump.height", "noise.value -> ramp.factor", "ramp.color -> ball.base_color",
        "shade -> ball", "spot -> shade"],
    output: "ball",
    layout: {"ball": (400, 0), "noise": (0, 0)},
    expose: (inputs: {"size": "noise.scale"}, options: {"detail": "noise.octaves"}))"#;

fn wgsl(graph: &Graph, load: graph::Loader<'_>) -> String {
    let (flat, found) = expand(graph, load);
    assert!(!crate::diagnostic::has_errors(&found), "{found:#?}");
    let named = NamedGraph { name: "g".into(), graph: flat.unwrap(), set: Default::default() };
    let (compiled, found) = compile(&[named], &catalog(), &Options::default());
    compiled.unwrap_or_else(|| panic!("{found:#?}")).module.wgsl
}

/// Lines of code without what a node's name decides.
fn code(wgsl: &str, stand: &str) -> BTreeSet<String> {
    let lines = wgsl.lines().filter(|l| !l.trim_start().starts_with("//"));
    lines.map(|l| l.replace(&format!("{stand}_"), "").split_whitespace().collect()).collect()
}

fn check(nodes: &[&str]) -> (Graph, Graph) {
    let graph = clean(LIT);
    let (edit, inner, name) = make_subgraph(&graph, &catalog(), &set(nodes), "lib/stone.ron", "Stone").unwrap();
    let mut outer = graph.clone();
    let undo = apply(&mut outer, edit).unwrap();
    let (inner, outer) = (clean(&graph::write(&inner)), clean(&graph::write(&outer)));
    assert_eq!(outer.nodes[&name].graph.as_deref(), Some("lib/stone.ron"));
    let shared = Arc::new(inner.clone());
    let load = |path: &str, _: &str| Ok((path.to_owned(), shared.clone()));
    let never = |_: &str, _: &str| Err(Vec::new());
    let (before, now) = (wgsl(&graph, &never), wgsl(&outer, &load));
    assert_eq!(code(&before, &name), code(&now, &name), "{nodes:?}\n{before}\n{now}");
    let mut back = outer.clone();
    apply(&mut back, undo).unwrap();
    assert_eq!(graph::write(&back), graph::write(&graph));
    (inner, outer)
}

#[test]
fn a_subgraph_makes_the_same_shader() {
    for nodes in [
        &["noise"][..],
        &["noise", "bump"],
        &["noise", "ramp"],
        &["bump", "ramp", "noise"],
        &["ball"],
        &["ball", "ramp"],
        &["spot", "shade"],
        &["shade"],
        &["noise", "ball"],
        &["ball", "bump", "noise", "ramp", "shade", "spot", "time"],
    ] {
        check(nodes);
    }
}

#[test]
fn what_crosses_and_what_was_set_is_exposed() {
    let (inner, outer) = check(&["noise", "bump"]);
    let names = |keys: Vec<&String>| keys.into_iter().cloned().collect::<Vec<_>>();
    assert_eq!(names(inner.expose.inputs.keys().collect()), ["amplitude", "scale"]);
    assert_eq!(names(inner.expose.outputs.keys().collect()), ["bump", "value"]);
    assert_eq!(outer.expose.inputs["size"][0].to_string(), "stone.scale");
    assert_eq!(outer.expose.options["detail"][0].to_string(), "stone.octaves");
    assert!(outer.layout.contains_key("stone"));
}

#[test]
fn impossible_subgraphs_say_why() {
    let mut graph = clean(LIT);
    let made = |graph: &Graph, nodes: &[&str], path: &str| {
        make_subgraph(graph, &catalog(), &set(nodes), path, "T").map(|m| m.1)
    };
    assert_eq!(made(&graph, &[], "x.ron").unwrap_err(), "no nodes are chosen");
    assert_eq!(made(&graph, &["noise"], "lib/").unwrap_err(), "the file needs a name");
    let image = crate::semantic::Value::Text("a.png".into());
    graph.nodes.get_mut("noise").unwrap().params.insert("map".into(), image);
    let inner = made(&graph, &["noise"], "one/two/x.ron").unwrap();
    assert_eq!(inner.nodes["noise"].params["map"], crate::semantic::Value::Text("../../a.png".into()));
    assert!(made(&graph, &["noise"], "../x.ron").unwrap_err().contains("`a.png`"));
}
