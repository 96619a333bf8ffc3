use std::collections::BTreeSet;

use proptest::prelude::*;

use super::{catalog, clean};
use crate::diagnostic::SourceText;
use crate::graph::{Edit, End, Frame, Graph, read, write};
use crate::semantic::Value;
use crate::view::Document;
use crate::view::commands::*;

const START: &str = r#"Graph(version: 1, name: "Start", note: "kept", nodes: {
    "bricks": (kind: "brick", params: {"columns": 12}), "bump": (kind: "bump"), "wall": (kind: "oren_nayar"),
    "spot": (kind: "spot_light"), "shadow": (kind: "pcf_shadow"), "inner": (graph: "inner.ron"),
    }, links: ["bricks.color -> wall.albedo", "bricks.mask -> bump.height", "bump -> wall", "spot -> shadow",
    "shadow -> wall", "inner.out -> wall.roughness"], output: "wall",
    layout: {"bricks": (0, 0), "wall": (300, 0)}, frames: {"f": (at: (-9, -9), size: (90, 90))},
    waypoints: {"bump -> wall": [(1, 2)]}, expose: (inputs: {"columns": "bricks.columns"}))"#;

const KINDS: [&str; 9] =
    ["brick", "perlin3d", "bump", "ggx", "pcss_shadow", "point_light", "custom", "mix_values", "no_such_kind"];

fn sizes(name: &str) -> [f64; 2] {
    [100.0 + name.len() as f64, 80.0]
}

/// What one number makes of a graph: an edit by some command.
fn command(graph: &Graph, seed: u64) -> Option<Edit> {
    let mut state = seed;
    let mut pick = |count: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) as usize) % count.max(1)
    };
    let catalog = catalog();
    let names: Vec<&String> = graph.nodes.keys().collect();
    let links = &graph.links;
    let name = |n: usize| names.get(n).map_or_else(|| "gone".to_owned(), |name| (*name).clone());
    let (a, b) = (name(pick(names.len())), name(pick(names.len())));
    let some: BTreeSet<String> = names.iter().filter(|_| pick(4) == 0).map(|n| (*n).clone()).collect();
    let kind = KINDS[pick(KINDS.len())];
    let link = links.get(pick(links.len()));
    let (x, y) = (pick(1000) as f64, pick(1000) as f64 / 7.0);
    let port = ["a", "color", "value", "albedo", "normal"][pick(5)];
    let end =
        |node: &str, port: usize| if port == 0 { End::node(node) } else { End::port(node, ["value", "a"][port % 2]) };
    Some(match pick(24) {
        0 => add(graph, &catalog, kind, [x, y]).0,
        1 => add_linked(graph, &catalog, kind, [x, y], &Pending { end: End::node(a), from_output: y > 70.0 })?.0,
        2 => connect(graph, &catalog, &end(&a, pick(3)), &end(&b, pick(3))).ok()?,
        3 => delete(graph, &some, true),
        4 => delete(graph, &[a].into(), false),
        5 => paste(graph, &copy(graph, &some), Some([x, y])).unwrap().0,
        6 => duplicate(graph, &some, y > 50.0).0,
        7 | 8 => swap_kind(graph, &catalog, &a, kind),
        9 => insert_on_link(graph, &catalog, &link?.from, &link?.to, Insert::Kind(kind), [x, y])?.0,
        10 => set_muted(graph, &some, x > 500.0),
        11 => set_collapsed(graph, &some, x > 500.0),
        12 => make_subgraph(graph, &catalog, &some, "lib/part.ron", "Part").ok()?.0,
        13 => expose(graph, &a, port, "public"),
        14 => frame(graph, &some, &sizes).0,
        15 => move_all(graph, &some, [x, -y]),
        16 => move_frame(graph, graph.frames.keys().next()?, [x, y], &sizes),
        17 => align(graph, &some, &sizes, [How::Left, How::DistributeX, How::CenterY][pick(3)]),
        18 => pin(graph, &link?.from, &link?.to, port, "b"),
        19 => Edit::RenameNode(a, free_name(graph, kind)),
        20 => Edit::SetWaypoints(link?.from.clone(), link?.to.clone(), vec![[x, y]; pick(3)]),
        21 => {
            Edit::SetFrame(kind.into(), (x > 300.0).then(|| Box::new(Frame { size: [x, y + 1.0], ..Frame::default() })))
        }
        22 => Edit::SetParam { node: a, param: port.into(), value: Some(Value::Numbers(vec![x])) },
        _ => place_missing(graph, &sizes),
    })
}

fn lossless(text: &str) {
    let (graph, found) = read(&SourceText::new("t.ron", text));
    assert!(found.is_empty(), "{text}\n{found:#?}");
    assert_eq!(write(&graph.unwrap()), text);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]
    #[test]
    fn everything_can_be_taken_back(seeds in prop::collection::vec(any::<u64>(), 200)) {
        let start = clean(START);
        let mut document = Document::new(start);
        let first = document.text();
        for (step, seed) in seeds.iter().enumerate() {
            // What grows without end is cut back.
            if document.graph().nodes.len() > 60 {
                let many = document.graph().nodes.keys().skip(8).cloned().collect();
                let cut = delete(document.graph(), &many, true);
                document.change("cut", cut).unwrap();
            }
            let Some(edit) = command(document.graph(), *seed) else { continue };
            let before = document.text();
            let made = if seed % 3 == 0 { document.gesture("g", "key", edit) } else { document.change("c", edit) };
            match made {
                Ok(()) if step % 10 == 0 => lossless(&document.text()),
                Ok(()) => {}
                Err(_) => prop_assert_eq!(document.text(), before),
            }
        }
        let last = document.text();
        lossless(&last);
        let steps = document.history().count();
        while document.undo().is_some() {}
        prop_assert_eq!(document.text(), first);
        prop_assert!(!document.is_changed());
        while document.redo().is_some() {}
        prop_assert_eq!(document.text(), last);
        prop_assert_eq!(document.history().count(), steps);
    }

    #[test]
    fn copies_are_equal_but_for_their_names(seeds in prop::collection::vec(any::<u64>(), 30)) {
        let mut document = Document::new(clean(START));
        for seed in seeds {
            if let Some(edit) = command(document.graph(), seed) {
                let _ = document.change("", edit);
            }
        }
        let all: BTreeSet<String> = document.graph().nodes.keys().cloned().collect();
        let text = copy(document.graph(), &all);
        let (edit, names) = paste(&Graph::default(), &text, None).unwrap();
        prop_assert_eq!(&names, &all);
        let mut empty = Document::new(Graph::default());
        empty.change("paste", edit).unwrap();
        let (one, other) = (document.graph(), empty.graph());
        let ends = |graph: &Graph| graph.links.iter().map(ToString::to_string).collect::<Vec<_>>();
        prop_assert_eq!(ends(one), ends(other));
        for (name, node) in &one.nodes {
            let copied = &other.nodes[name];
            prop_assert_eq!((&node.kind, &node.params, &node.options), (&copied.kind, &copied.params, &copied.options));
        }
        // Beside itself, too, no name is lost.
        let (edit, names) = paste(one, &text, None).unwrap();
        prop_assert!(names.is_disjoint(&all) && names.len() == all.len());
        let links = one.links.len();
        document.change("paste", edit).unwrap();
        prop_assert_eq!(document.graph().links.len(), 2 * links);
    }
}
