use std::collections::BTreeMap;

use super::{clean, small};
use crate::graph::{End, Graph, Link, Node};
use crate::view::layout::{arrange, placed};

fn overlap(places: &BTreeMap<String, [f64; 2]>, sizes: &dyn Fn(&str) -> [f64; 2]) -> Option<(String, String)> {
    // Sorted by their left edges, only near ones can overlap.
    let mut boxes: Vec<(&String, [f64; 2], [f64; 2])> = places.iter().map(|(n, at)| (n, *at, sizes(n))).collect();
    boxes.sort_by(|a, b| a.1[0].total_cmp(&b.1[0]).then(a.1[1].total_cmp(&b.1[1])));
    for (i, (a, at, size)) in boxes.iter().enumerate() {
        for (b, other, other_size) in &boxes[i + 1..] {
            if other[0] >= at[0] + size[0] {
                break;
            }
            if other[1] < at[1] + size[1] && at[1] < other[1] + other_size[1] {
                return Some(((*a).clone(), (*b).clone()));
            }
        }
    }
    None
}

fn sizes(name: &str) -> [f64; 2] {
    let bytes: usize = name.bytes().map(usize::from).sum();
    [120.0 + (bytes % 7) as f64 * 20.5, 60.0 + (bytes % 5) as f64 * 33.3]
}

/// Nodes of which each is fed by up to three before it.
fn large(count: usize) -> Graph {
    let mut graph = Graph::default();
    let name = |i: usize| format!("n{i:05}");
    for i in 0..count {
        graph.nodes.insert(name(i), Node { kind: "k".into(), ..Node::default() });
        for step in [1, 7, 31].into_iter().take(i % 4).filter(|step| *step <= i) {
            graph.links.push(Link::new(End::node(name(i - step)), End::port(name(i), format!("p{step}"))));
        }
    }
    graph.links.sort_by(|a, b| (&a.from, &a.to).cmp(&(&b.from, &b.to)));
    graph
}

#[test]
fn what_feeds_is_left_of_what_is_fed() {
    let graph = small(&["a k", "b k", "c k", "d k", "e k"], &["a -> b", "b -> c", "d -> c", "a -> c"]);
    let places = arrange(&graph, &sizes);
    let x = |name: &str| places[name][0];
    assert!(x("a") < x("b") && x("b") < x("c") && x("d") == x("b"));
    assert!(places["e"][1] > places["c"][1], "what has no link lies below");
    assert_eq!(overlap(&places, &sizes), None);
}

#[test]
fn crossings_are_undone() {
    let graph = small(&["a k", "b k", "x k", "y k", "z k"], &["a -> y", "b -> x", "x -> z.p", "y -> z.q"]);
    let places = arrange(&graph, &sizes);
    assert_eq!(places["a"][1] < places["b"][1], places["y"][1] < places["x"][1]);
}

#[test]
fn thousands_are_arranged_at_once() {
    let graph = large(5000);
    let places = arrange(&graph, &sizes);
    assert_eq!(places.len(), 5000);
    assert_eq!(overlap(&places, &sizes), None);
    assert_eq!(places, arrange(&graph.clone(), &sizes));
    let odd = arrange(&graph, &|_| [f64::NAN, f64::INFINITY]);
    assert!(odd.values().flatten().all(|x| x.is_finite()));
}

#[test]
fn cycles_through_subgraphs_are_arranged_too() {
    let graph = clean(
        r#"Graph(version: 1, nodes: {"a": (kind: "k"), "s": (graph: "s.ron")}, links: ["a -> s.in", "s.out -> a"])"#,
    );
    assert_eq!(overlap(&arrange(&graph, &sizes), &sizes), None);
}

#[test]
fn given_places_stay() {
    let mut graph = large(200);
    graph.layout.insert("n00003".into(), [-50.0, 70.0]);
    graph.layout.insert("n00004".into(), [500.0, -70.0]);
    let places = placed(&graph, &sizes);
    assert_eq!((places["n00003"], places["n00004"], places.len()), ([-50.0, 70.0], [500.0, -70.0], 200));
    assert_eq!(overlap(&places, &sizes), None);
    assert_eq!(placed(&large(50), &sizes), arrange(&large(50), &sizes));
}
