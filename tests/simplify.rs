//! Every cheaper form that a node of the catalogue declares: it can be made, naga accepts it, and it costs less.

use std::collections::BTreeMap;

use shadetree::compile::{NamedGraph, Options};
use shadetree::cost::{Cost, total};
use shadetree::diagnostic::SourceText;
use shadetree::graph::{Edit, End, Graph, Link, Node, apply};
use shadetree::node::{Definition, Form};
use shadetree::semantic::{Kind, Quantity};
use shadetree::simplify::{Means, Swap, What, made, swaps, wanted_means, weighed};
use shadetree::verify::verify;

use crate::matrix::alone;
use crate::support::{catalog, compiled, graph_text, show};

fn cost(graph: &Graph) -> Cost {
    let named = NamedGraph { name: "alone".into(), graph: graph.clone(), set: BTreeMap::new() };
    let module = compiled(&[named], &Options::default()).module;
    total(&verify(&module).unwrap_or_else(|found| panic!("{}", show(&found))))
}

/// The graph with something behind the node that takes one of its outputs and is seen.
fn followed(graph: &Graph, definition: &Definition, output: &str) -> Graph {
    let ty = &definition.output(output).expect("an output").ty;
    if ty.meaning.quantity == Quantity::Radiance {
        return graph.clone();
    }
    let (kind, input) = match ty.meaning.kind {
        Kind::Normal => ("lambert", "normal"),
        Kind::Point => ("perlin3d", "position"),
        Kind::Texcoord => ("checker", "texcoord"),
        _ => ("unlit", "color"),
    };
    let mut graph = graph.clone();
    let node = |kind: &str| Box::new(Node { kind: kind.into(), ..Node::default() });
    let link = |from: End, to: End| Edit::Link(Box::new(Link::new(from, to)));
    let mut edits = vec![
        Edit::AddNode("look".into(), node(kind)),
        link(End::port("node", output), End::port("look", input)),
        Edit::SetOutput(Some(End::node("look"))),
    ];
    if kind == "lambert" {
        edits.push(Edit::AddNode("sun".into(), node("directional_light")));
        edits.push(link(End::node("sun"), End::node("look")));
    }
    apply(&mut graph, Edit::Batch(edits)).expect("a sound graph");
    graph
}

#[test]
fn every_cheaper_form_can_be_made_and_costs_less() {
    let mut tried = 0;
    let mut wrong = Vec::new();
    for file in catalog().files() {
        let header = file.header().expect("embedded nodes are sound");
        let mut options = BTreeMap::new();
        for spec in &header.cheaper {
            if let Form::Option { name, choices } = &spec.form {
                options.insert(name.clone(), choices[0].clone());
            }
        }
        let definition = file.definition(&options).expect("embedded nodes are sound");
        for output in &definition.main.outputs {
            if header.cheaper.is_empty() {
                break;
            }
            let graph = followed(&alone(&definition, &options, None).graph, &definition, &output.name);
            let own: Vec<Swap> = swaps(&graph, catalog()).into_iter().filter(|s| s.node == "node").collect();
            let means: Means =
                wanted_means(&graph, catalog(), &own).into_iter().map(|at| (at, [0.25, 0.5, 0.75])).collect();
            let full = cost(&graph);
            let mut last = f64::INFINITY;
            for swap in &own {
                let what = format!("{}.{}: {}", file.kind(), output.name, swap.name());
                let Some(after) = made(&graph, catalog(), swap, &means) else {
                    // Directions and the like have no mean.
                    if swap.what != What::Mean || !means.is_empty() {
                        wrong.push(format!("{what}: cannot be made"));
                    }
                    continue;
                };
                tried += 1;
                let cheaper = cost(&after);
                if weighed(cheaper) >= weighed(full) {
                    wrong.push(format!("{what}: costs {cheaper:?} instead of {full:?}"));
                }
                // Choices stand in the order of what they cost.
                if matches!(swap.what, What::Choose(..)) {
                    if weighed(cheaper) >= last {
                        wrong.push(format!("{what}: costs {cheaper:?}, no less than the choice before it"));
                    }
                    last = weighed(cheaper);
                } else {
                    last = f64::INFINITY;
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(tried > 60, "{tried}");
}

/// The lines that declare them change no shader.
#[test]
fn declarations_are_no_part_of_a_shader() {
    let file = catalog().get("fbm3d").expect("a node");
    let bare: String =
        file.source().text.lines().filter(|l| !l.starts_with("//! cheaper:")).map(|l| format!("{l}\n")).collect();
    assert_ne!(bare, file.source().text);
    let definition = file.definition(&BTreeMap::new()).expect("sound");
    let graph = [alone(&definition, &BTreeMap::new(), None)];
    let mut own = catalog().clone();
    let found = own.add_file("procedural/fbm3d_bare.wgsl", &bare.replace("fn fbm3d(", "fn fbm3d_bare("));
    assert_eq!(found, []);
    let mut renamed = graph[0].clone();
    let edit = Edit::SetKind { node: "node".into(), kind: "fbm3d_bare".into(), graph: None };
    apply(&mut renamed.graph, edit).expect("a sound graph");
    let (plain, found) = shadetree::compile::compile(&[renamed], &own, &Options::default());
    let plain = plain.unwrap_or_else(|| panic!("{}", show(&found))).module.wgsl;
    assert_eq!(plain.replace("fbm3d_bare", "fbm3d"), compiled(&graph, &Options::default()).module.wgsl);
}

/// The vertex and the fragment stage of a graph.
fn stages(nodes: &str, links: &str) -> (String, String) {
    let text = format!("Graph(version: 1, nodes: {{{nodes}}}, links: [{links}], output: \"look\")");
    let graph = graph_text("rates", &SourceText::new("rates.ron", text));
    let wgsl = compiled(&[graph], &Options::default()).module.wgsl;
    let (_, stages) = wgsl.split_once("fn vs_main(").expect("a vertex stage");
    let (vertex, fragment) = stages.split_once("@fragment").expect("a fragment stage");
    (vertex.to_owned(), fragment.to_owned())
}

#[test]
fn what_the_vertex_stage_can_compute_is_computed_there() {
    let look = "\"rate\": (kind: \"per_vertex\"), \"look\": (kind: \"unlit\")";
    let links = "\"n.value -> rate.value\", \"rate.value -> look.color\"";
    let (vertex, fragment) = stages(&format!("\"n\": (kind: \"perlin3d\"), {look}"), links);
    assert!(vertex.contains("let n = perlin3d(position_object, parameters.n_scale);"), "{vertex}");
    assert!(vertex.contains("out.rate_1 = n;") && fragment.contains("in.rate_1"), "{vertex}{fragment}");
    assert!(!fragment.contains("perlin3d(") && !fragment.contains("position_object"), "{fragment}");
    // Derivatives, also those of a library, and pictures stay with the fragments.
    for (node, output) in [
        ("(kind: \"fbm3d\")", "value"),
        ("(kind: \"image\", params: {\"image\": \"graphs/textures/tiles.png\"})", "alpha"),
    ] {
        let links = links.replace("n.value", &format!("n.{output}"));
        let (vertex, fragment) = stages(&format!("\"n\": {node}, {look}"), &links);
        assert!(!vertex.contains("out.rate") && !fragment.contains("in.rate"), "{vertex}{fragment}");
    }
    // One behind the other is one, and what is also read elsewhere is computed in both stages.
    let two =
        format!("\"n\": (kind: \"perlin3d\"), \"inner\": (kind: \"per_vertex\"), \"sum\": (kind: \"add\"), {look}");
    let links = "\"n.value -> inner.value\", \"inner.value -> rate.value\", \"rate.value -> sum.a\", \"n.value -> sum.b\", \"sum -> look.color\"";
    let (vertex, fragment) = stages(&two, links);
    assert_eq!((vertex.matches("perlin3d(").count(), vertex.matches("out.rate").count()), (1, 1), "{vertex}");
    assert!(fragment.contains("perlin3d(in.position_object"), "{fragment}");
}

/// More than may be interpolated is computed where it is read, and nothing is lost.
#[test]
fn stages_pass_no_more_than_they_may() {
    let mut nodes = String::from("\"look\": (kind: \"unlit\"), \"s0\": (kind: \"value\"),");
    let mut links = String::new();
    for i in 1..=12 {
        nodes += &format!(
            "\"n{i}\": (kind: \"perlin3d\", params: {{\"scale\": {i}}}), \"v{i}\": (kind: \"per_vertex\"), \"s{i}\": (kind: \"add\"),"
        );
        links += &format!("\"n{i}.value -> v{i}.value\", \"v{i}.value -> s{i}.a\", \"s{} -> s{i}.b\",", i - 1);
    }
    let (vertex, fragment) = stages(&nodes, &format!("{links} \"s12 -> look.color\""));
    assert_eq!(
        (vertex.matches("perlin3d(").count(), fragment.matches("perlin3d(").count()),
        (7, 5),
        "{vertex}{fragment}"
    );
}
