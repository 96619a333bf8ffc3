use super::*;
use proptest::prelude::*;

/// Every field in its canonical form.
const FULL: &str = r##"Graph(
    version: 1,
    name: "Bumpy glass",
    note: r#"What "this" is for."#,
    nodes: {
        "bump": (kind: "bump", params: {"strength": 0.4}, options: {"octaves": "3"}, note: "why"),
        "glass": (kind: "glass", params: {"clear": true, "ior": 1.5, "tint": (0.9, 1, 0.95)}, muted: true),
        "stone": (graph: "lib/stone.ron", params: {"noise.scale": 3}, later: [1, (a: 'x')]),
        "stripe": (kind: "custom", wgsl: r#"fn stripe(x: f32) -> f32 {
    return x;
}"#),
    },
    links: [
        (link: "bump -> glass", note: "abstract", weight: 2),
        "stone.value -> bump.height",
    ],
    output: "glass",
    expose: (
        inputs: {
            "height": "bump.height",
            "tint": ["glass.tint", "stripe.tint"],
        },
        outputs: {
            "color": "glass.color",
        },
        options: {
            "octaves": "bump.octaves",
        },
        later: 1,
    ),
    future: Thing(1, 2.50, None),
    layout: {
        "bump": (0, 120),
        "glass": (-12.5, 3e21),
    },
    frames: {
        "Normals, bent": (at: (-20, 100), size: (300, 200.5), color: (0.2, 0.4, 1), text: "why", later: 1),
        "plain": (at: (0, 0), size: (1, 1)),
    },
    collapsed: [
        "glass",
        "stone",
    ],
    waypoints: {
        "bump -> glass": [(10, 20), (30, -40.5)],
    },
)
"##;

#[test]
fn a_canonical_file_comes_back_byte_for_byte() {
    let (graph, found) = read(&SourceText::new("t.ron", FULL));
    assert_eq!(
        told(&found),
        [
            "ST0010 8:71 the field `later` is not known here",
            "ST0010 14:51 the field `weight` is not known here",
            "ST0010 29:9 the field `later` is not known here",
            "ST0010 37:98 the field `later` is not known here",
            "ST0010 31:5 the field `future` is not known here",
        ]
    );
    assert_eq!(write(&graph.unwrap()), FULL);
    let empty = "Graph(\n    version: 1,\n)\n";
    assert_eq!(write(&clean(empty)), empty);
}

#[test]
fn places_point_at_what_was_written() {
    let (graph, _) = read(&SourceText::new("t.ron", FULL));
    let graph = graph.unwrap();
    let line = |place: crate::diagnostic::Place| place.span.unwrap().line_column();
    let written = |place: crate::diagnostic::Place| {
        let span = place.span.unwrap();
        span.source.text[span.range].to_string()
    };
    assert_eq!(line(graph.place("glass")), (7, 9));
    assert_eq!(written(graph.kind_place("stone")), "\"lib/stone.ron\"");
    assert_eq!(written(graph.param_place("glass", "tint")), "(0.9, 1, 0.95)");
    assert_eq!(written(graph.option_place("bump", "octaves")), "\"3\"");
    assert_eq!(written(graph.link_place(&graph.links[0])), "\"bump -> glass\"");
    assert_eq!(graph.param_place("glass", "absent").port.as_deref(), Some("absent"));
    let wgsl = graph.wgsl_span("stripe").unwrap();
    assert_eq!(Some(&wgsl.source.text[wgsl.range]), graph.nodes["stripe"].wgsl.as_deref());
    let place = graph.place("nobody");
    assert_eq!((place.file.as_deref(), place.node.as_deref()), (Some("t.ron"), Some("nobody")));
}

#[test]
fn every_mistake_is_told_in_one_reading() {
    let text = r#"Graph(
    version: 1,
    nodes: {
        "a.b": (kind: "x"),
        "noise": (kind: "x", params: {"p": inf, "q": {}, "r": (1, 2, 3, 4, 5), "s": (1, "t")}),
        "both": (kind: "x", graph: "y.ron"),
        "none": (),
        "glass": (kynd: "glass"),
        "noise": (kind: "y"),
    },
    links: ["niose -> glass", "noise -> noise", "noise glass", 7, "noise -> both", "noise -> both"],
    output: "glas.color",
    layout: {"gone": (0, 0), "noise": (1, NaN)},
    frames: {"": (at: (0, 0), size: (1, 1)), "f": (at: (0, 0)), "g": (at: (0, 0), size: (1, 0)), "h": (at: 1, size: (1, 1))},
    collapsed: ["nosie", 3],
    waypoints: {"noise": [], "noise -> gone": [(0, 0)], "noise -> both": [(0, inf)], "noise->both": 7},
)"#;
    let (_, found) = read(&SourceText::new("t.ron", text));
    assert_eq!(
        told(&found),
        [
            "ST0006 9:9 `noise` is given twice here",
            "ST0053 4:9 `a.b` cannot name a node because of the `.`",
            "ST0009 5:44 `inf` is not a finite number",
            "ST0061 5:54 `q` cannot be a map `{...}`",
            "ST0061 5:63 `r` cannot be a tuple of 5",
            "ST0008 5:89 expected a number, found a text",
            "ST0054 6:17 the node `both` says both a `kind` and a `graph`",
            "ST0054 7:17 the node `none` does not say what it is",
            "ST0010 8:19 the field `kynd` is not known here",
            "ST0054 8:18 the node `glass` does not say what it is",
            "ST0056 11:14 the link names the node `niose`, which is not in the graph",
            "ST0057 11:31 the link leads from `noise` to itself",
            "ST0055 11:49 `noise glass` has no `->`",
            "ST0008 11:64 expected a text in quotes, found the number `7`",
            "ST0058 11:84 the link `noise -> both` is given twice",
            "ST0056 12:13 the output names the node `glas`, which is not in the graph",
            "ST0056 13:14 there is a position for `gone`, and no such node",
            "ST0009 13:43 `NaN` is not a finite number",
            "ST0069 14:14 the title of a frame has 1 to 200 bytes that are not only spaces",
            "ST0011 14:51 the frame has no field `size`",
            "ST0069 14:65 the frame `g` has no size",
            "ST0008 14:108 expected 2 numbers `(...)`, found the number `1`",
            "ST0056 15:17 there is an entry in `collapsed` for `nosie`, and no such node",
            "ST0008 15:26 expected a text in quotes, found the number `3`",
            "ST0055 16:17 `noise` has no `->`",
            "ST0056 16:30 there are bends for `noise -> gone`, and no such link",
            "ST0009 16:79 `inf` is not a finite number",
            "ST0008 16:101 expected a list `[...]`, found the number `7`",
        ]
    );
    let help = |code: &str| found.iter().find(|d| d.code == code && d.help.is_some()).and_then(|d| d.help.clone());
    assert_eq!(help("ST0010").as_deref(), Some("did you mean `kind`?"));
    assert_eq!(help("ST0056").as_deref(), Some("did you mean `noise`?"));
}

#[test]
fn other_roots_and_versions_are_refused() {
    let told_of = |text: &str| {
        let (graph, found) = read(&SourceText::new("t.ron", text));
        (graph.is_some(), told(&found))
    };
    assert_eq!(
        told_of("Scene(version: 1)"),
        (false, vec!["ST0050 1:1 expected `Graph(...)`, found `Scene(...)`".into()])
    );
    assert_eq!(told_of("[1]"), (false, vec!["ST0050 1:1 expected `Graph(...)`, found a list `[...]`".into()]));
    let missing = "ST0051 1:1 the graph does not say which version of the format it is written in";
    assert_eq!(told_of("Graph(nodes: {})"), (true, vec![missing.into()]));
    assert_eq!(told_of("Graph()"), (true, vec![missing.into()]));
    let newer = "ST0052 1:16 the graph is of version 2, and versions up to 1 can be read here";
    assert_eq!(told_of("Graph(version: 2)"), (false, vec![newer.into()]));
    let odd = "ST0051 1:16 a version is a whole number, not the number `-1`";
    assert_eq!(told_of("Graph(version: -1)"), (true, vec![odd.into()]));
}

#[test]
fn cycles_are_named() {
    let text = r#"Graph(version: 1, nodes: {"a": (kind: "k"), "b": (kind: "k"), "c": (kind: "k"), "s": (graph: "s.ron")},
    links: ["a -> b", "b.x -> c.y", "c -> a", "a -> s.in", "s.out -> a"])"#;
    let (_, found) = read(&SourceText::new("t.ron", text));
    assert_eq!(told(&found), ["ST0059 2:37 the links form a cycle: a -> b -> c -> a"]);
}

#[test]
fn large_graphs_are_refused_and_long_chains_are_not() {
    let nodes = |n: usize| (0..n).map(|i| format!("\"n{i}\": (kind: \"k\"),\n")).collect::<String>();
    let (_, found) = read(&SourceText::new("t.ron", format!("Graph(version: 1, nodes: {{{}}})", nodes(MAX_NODES + 1))));
    assert_eq!(found.iter().map(|d| d.code).collect::<Vec<_>>(), ["ST0060"]);
    let links: String = (1..MAX_NODES).map(|i| format!("\"n{} -> n{i}\",\n", i - 1)).collect();
    let graph = clean(&format!("Graph(version: 1, nodes: {{{}}}, links: [{links}])", nodes(MAX_NODES)));
    assert_eq!(graph.links.len(), MAX_NODES - 1);
    let links = "\"a -> b\",".repeat(MAX_LINKS + 1);
    let (_, found) = read(&SourceText::new("t.ron", format!("Graph(version: 1, links: [{links}])")));
    assert_eq!(found.iter().map(|d| d.code).collect::<Vec<_>>(), ["ST0060"]);
    let links: String = (0..5000).map(|i| format!("\"a{i} -> b\",")).collect();
    let (_, found) = read(&SourceText::new("t.ron", format!("Graph(version: 1, links: [{links}])")));
    assert_eq!(found.last().map(|d| d.code), Some("ST0066"));
}

#[test]
fn comments_become_notes() {
    let text = r#"// Before all.
Graph(
    version: 1, // the version
    nodes: {
        // About a.

        /* More
         * of it. */
        "a": (kind: "k", note: "Noted."), // Behind a.
        "b": (
            kind: "k", // Inside b.
        ),
        // After the last node.
    },
    links: [
        "a -> b", // Why.
    ],
)
"#;
    let graph = clean(text);
    assert_eq!(graph.note, "Before all.\nthe version\nAfter the last node.");
    assert_eq!(graph.nodes["a"].note, "Noted.\nAbout a.\nMore\nof it.\nBehind a.");
    assert_eq!(graph.nodes["b"].note, "Inside b.");
    assert_eq!(graph.links[0].note, "Why.");
    let written = write(&graph);
    assert_eq!(write(&clean(&written)), written);
}

#[test]
fn version_0_is_migrated() {
    let graph = clean(include_str!("version_0.ron"));
    assert_eq!(write(&graph), include_str!("version_0.expected.ron"));
    assert_eq!(graph.link_place(&graph.links[0]).span.unwrap().line_column().0, 11);
}

#[test]
fn moving_a_node_changes_only_the_layout() {
    let mut graph = clean("Graph(version: 1, nodes: {\"a\": (kind: \"k\")}, layout: {\"a\": (0, 0)})");
    let before = write(&graph);
    apply(&mut graph, Edit::Move("a".into(), Some([5.5, 1e-7]))).unwrap();
    let after = write(&graph);
    let changed: Vec<_> = before.lines().zip(after.lines()).filter(|(a, b)| a != b).collect();
    assert_eq!(changed, [("        \"a\": (0, 0),", "        \"a\": (5.5, 0.0000001),")]);
}

proptest! {
    #[test]
    fn broken_graphs_do_not_panic(cuts in prop::collection::vec((any::<prop::sample::Index>(), "[\\[\\](){}\",:>./\\-a-z0-9]{0,4}"), 1..8)) {
        let mut text: Vec<char> = FULL.chars().collect();
        for (at, put) in cuts {
            let at = at.index(text.len() + 1);
            text.splice(at..(at + 2).min(text.len()), put.chars());
        }
        let (graph, found) = read(&SourceText::new("t.ron", text.into_iter().collect::<String>()));
        if let Some(graph) = graph && !crate::diagnostic::has_errors(&found) {
            let written = write(&graph);
            let (again, found) = read(&SourceText::new("t.ron", written.clone()));
            prop_assert!(!crate::diagnostic::has_errors(&found), "{written}\n{found:?}");
            prop_assert_eq!(write(&again.unwrap()), written);
        }
    }
}
