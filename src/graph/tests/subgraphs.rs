use std::collections::BTreeMap;
use std::sync::Arc;

use super::*;
use crate::semantic::Value;

const STONE: &str = r#"Graph(
    version: 1,
    nodes: {
        "grain": (graph: "grain.ron", params: {"freq": 2}),
        "mix": (kind: "mix", params: {"amount": 0.5}, options: {"mode": "add"}),
    },
    links: ["grain -> mix.a"],
    output: "mix",
    expose: (inputs: {"scale": ["grain.freq", "mix.amount"], "base": "mix.b"}, outputs: {"grain": "grain"}, options: {"mode": "mix.mode"}),
)"#;
const GRAIN: &str = r#"Graph(version: 1, nodes: {"noise": (kind: "noise", params: {"freq": 1})},
    expose: (inputs: {"freq": "noise.freq"}))"#;

fn expanded(files: &[(&str, &str)], root: &str) -> (Option<Graph>, Vec<String>) {
    let files: BTreeMap<String, Arc<Graph>> = files
        .iter()
        .map(|(name, text)| (name.to_string(), Arc::new(read(&SourceText::new(*name, *text)).0.unwrap())))
        .collect();
    let load = |path: &str, _by: &str| match files.get(path) {
        Some(graph) => Ok((path.to_string(), graph.clone())),
        None => Err(vec![Diagnostic::error("ST0001", format!("no file {path}"), Default::default())]),
    };
    let (graph, found) = expand(&read(&SourceText::new("root.ron", root)).0.unwrap(), &load);
    (graph, told(&found))
}

#[test]
fn a_subgraph_takes_the_place_of_its_node() {
    let root = r#"Graph(version: 1, nodes: {
        "stone": (graph: "stone.ron", params: {"scale": 7, "mix.c": true}, options: {"mode": "mul"}),
        "look": (kind: "look"), "paint": (kind: "paint")},
        links: ["paint -> stone.base", "stone.grain -> look.bump", "stone -> look"],
        expose: (inputs: {"s": "stone.scale"}), layout: {"look": (1, 2), "stone": (3, 4)})"#;
    let (graph, found) = expanded(&[("stone.ron", STONE), ("grain.ron", GRAIN)], root);
    assert_eq!(found, [""; 0]);
    let graph = graph.unwrap();
    assert_eq!(graph.nodes.keys().collect::<Vec<_>>(), ["look", "paint", "stone/grain/noise", "stone/mix"]);
    let links: Vec<String> = graph.links.iter().map(Link::to_string).collect();
    assert_eq!(
        links,
        [
            "paint -> stone/mix.b",
            "stone/grain/noise -> look.bump",
            "stone/grain/noise -> stone/mix.a",
            "stone/mix -> look"
        ]
    );
    // Outer values stand over inner ones, and remember the file that they were written in.
    assert_eq!(graph.nodes["stone/grain/noise"].params["freq"], Value::Numbers(vec![7.0]));
    assert_eq!(graph.nodes["stone/mix"].params["amount"], Value::Numbers(vec![7.0]));
    assert_eq!(graph.nodes["stone/mix"].params["c"], Value::Bool(true));
    assert_eq!(graph.nodes["stone/mix"].options["mode"], "mul");
    let at = |place: crate::diagnostic::Place| place.span.unwrap().source.name.clone();
    assert_eq!(at(graph.param_place("stone/mix", "amount")), "root.ron");
    assert_eq!(at(graph.place("stone/mix")), "stone.ron");
    assert_eq!(at(graph.link_place(&graph.links[2])), "stone.ron");
    let exposed: Vec<String> = graph.expose.inputs["s"].iter().map(End::to_string).collect();
    assert_eq!(exposed, ["stone/grain/noise.freq", "stone/mix.amount"]);
    assert_eq!(graph.layout.keys().collect::<Vec<_>>(), ["look"]);
}

#[test]
fn the_last_node_of_a_graph_can_be_a_subgraph() {
    let loose = r#"Graph(version: 1, nodes: {"a": (kind: "k"), "b": (kind: "k")}, output: "a")"#;
    let (graph, found) =
        expanded(&[("l.ron", loose)], r#"Graph(version: 1, nodes: {"s": (graph: "l.ron", muted: true)})"#);
    assert_eq!(found, [""; 0]);
    let graph = graph.unwrap();
    assert_eq!(graph.output, Some(End::node("s/a")));
    assert!(graph.nodes["s/b"].muted);
}

#[test]
fn what_is_not_offered_is_told_with_what_is() {
    let root = r#"Graph(version: 1, nodes: {"s": (graph: "stone.ron", params: {"scal": 1, "mox.c": 1}), "x": (kind: "k")},
        links: ["x -> s", "s.grian -> x"])"#;
    let (graph, found) = expanded(&[("stone.ron", STONE), ("grain.ron", GRAIN)], root);
    assert!(graph.is_none());
    assert_eq!(
        found,
        [
            "ST0064 1:62 the subgraph `s` (stone.ron) exposes no parameter `scal`",
            "ST0064 1:73 `mox.c` names the node `mox`, which is not in the subgraph (stone.ron)",
            "ST0065 2:23 it is not clear which input of the subgraph `s` (stone.ron) is meant",
            "ST0064 2:30 the subgraph `s` (stone.ron) exposes no output `grian`",
        ]
        .map(String::from)
    );
}

#[test]
fn files_in_a_cycle_are_named() {
    let one = r#"Graph(version: 1, nodes: {"t": (graph: "two.ron")})"#;
    let two = r#"Graph(version: 1, nodes: {"o": (graph: "one.ron")})"#;
    let (graph, found) = expanded(&[("one.ron", one), ("two.ron", two)], one);
    assert!(graph.is_none());
    assert_eq!(found, ["ST0062 1:40 these graph files contain each other: two.ron -> one.ron -> two.ron"]);
    let (_, found) = expanded(&[], one);
    assert_eq!(found, ["ST0001 1:40 no file two.ron"]);
}

#[test]
fn a_cycle_through_a_subgraph_is_one_only_if_its_links_close() {
    let apart = r#"Graph(version: 1, nodes: {"a": (kind: "k"), "b": (kind: "k")},
        expose: (inputs: {"in": "a.x"}, outputs: {"out": "b.o"}))"#;
    let root =
        r#"Graph(version: 1, nodes: {"s": (graph: "s.ron"), "x": (kind: "k")}, links: ["s.out -> x", "x -> s.in"])"#;
    assert_eq!(expanded(&[("s.ron", apart)], root).1, [""; 0]);
    let joined = apart.replace(", \"b\": (kind: \"k\")", "").replace("b.o", "a.o");
    let found = expanded(&[("s.ron", &joined)], root).1;
    assert_eq!(found.len(), 1);
    assert!(found[0].ends_with("the links form a cycle: s/a -> x -> s/a"), "{found:?}");
}

/// Files `0.ron`, `1.ron` and on, each holding the next one under each of the names.
fn tower(names: &[&str], height: usize) -> Vec<(String, String)> {
    let file = |i: usize| {
        let nodes: String = names.iter().map(|name| format!("\"{name}\": (graph: \"{}.ron\"),", i + 1)).collect();
        (format!("{i}.ron"), format!("Graph(version: 1, nodes: {{{nodes}}})"))
    };
    let top = (format!("{height}.ron"), "Graph(version: 1, nodes: {\"n\": (kind: \"k\")})".to_string());
    (0..height).map(file).chain([top]).collect()
}

#[test]
fn growth_is_bounded() {
    for (names, height, code) in
        [(&["a", "b"][..], 25, Some("ST0060")), (&["a"], MAX_NESTING + 1, Some("ST0063")), (&["a"], MAX_NESTING, None)]
    {
        let files = tower(names, height);
        let files: Vec<(&str, &str)> = files.iter().map(|(n, t)| (n.as_str(), t.as_str())).collect();
        let (graph, found) = expanded(&files, files[0].1);
        assert_eq!(graph.is_none(), code.is_some());
        let codes: Vec<&str> = found.iter().map(|d| &d[..6]).collect();
        assert_eq!(codes, Vec::from_iter(code));
    }
}
