use super::*;
use crate::semantic::Value;
use proptest::prelude::*;

const START: &str = r#"Graph(
    version: 1,
    nodes: {
        "a": (kind: "k", params: {"x": 1}, later: 7),
        "b": (kind: "k", note: "n"),
        "c": (kind: "k"),
    },
    links: ["a -> b", (link: "b.o -> c.i", note: "l")],
    output: "c",
    expose: (inputs: {"i": ["a.x", "b.x"]}, outputs: {"o": "c.o"}, options: {"p": "a.p"}),
    layout: {"a": (1, 2), "c": (3, 4)},
    frames: {"Basics": (at: (0, 0), size: (9, 9), color: (0, 0.5, 1), text: "why", later: 1)},
    collapsed: ["b"],
    waypoints: {"a -> b": [(1, 1), (2, 1)], "b.o -> c.i": [(5, 5)]},
)"#;

fn start() -> Graph {
    read(&SourceText::new("t.ron", START)).0.unwrap()
}

#[test]
fn a_removed_node_comes_back_with_all_that_hung_on_it() {
    for name in ["a", "b", "c"] {
        let mut graph = start();
        let before = write(&graph);
        let undo = apply(&mut graph, Edit::RemoveNode(name.into())).unwrap();
        let without = write(&graph);
        assert!(!without.contains(&format!("\"{name}")), "{without}");
        clean_but_for_unknown(&without);
        let redo = apply(&mut graph, undo).unwrap();
        assert_eq!(write(&graph), before);
        apply(&mut graph, redo).unwrap();
        assert_eq!(write(&graph), without);
    }
}

#[test]
fn the_canvas_goes_along_with_nodes_and_links() {
    let mut graph = start();
    let before = write(&graph);
    let back = apply(&mut graph, Edit::RenameNode("b".into(), "z".into())).unwrap();
    let renamed = write(&graph);
    for part in ["collapsed: [\n        \"z\"", "\"a -> z\": [(1, 1), (2, 1)]", "\"z.o -> c.i\": [(5, 5)]"] {
        assert!(renamed.contains(part), "{renamed}");
    }
    apply(&mut graph, back).unwrap();
    assert_eq!(write(&graph), before);
    let back = apply(&mut graph, Edit::Unlink(End::node("a"), End::node("b"))).unwrap();
    assert_eq!(graph.waypoints.len(), 1);
    apply(&mut graph, back).unwrap();
    assert_eq!(write(&graph), before);
}

#[test]
fn links_may_cross_in_a_batch_that_ends_without_a_cycle() {
    let mut graph = start();
    let before = write(&graph);
    let link = |text: &str| Edit::Link(Box::new(Link::parse(text).unwrap()));
    let turn = vec![link("b -> a"), Edit::Unlink(End::node("a"), End::node("b"))];
    let back = apply(&mut graph, Edit::Batch(turn)).unwrap();
    apply(&mut graph, back).unwrap();
    assert_eq!(write(&graph), before);
    let cycle = Edit::Batch(vec![Edit::SetName("n".into()), link("b -> a")]);
    assert!(matches!(apply(&mut graph, cycle), Err(EditError::Cycle(_))));
    assert_eq!(write(&graph), before);
}

#[test]
fn a_node_in_the_place_of_a_subgraph_closes_no_cycle() {
    let text =
        r#"Graph(version: 1, nodes: {"a": (kind: "k"), "s": (graph: "s.ron")}, links: ["a -> s.i", "s.o -> a"])"#;
    let (graph, found) = read(&SourceText::new("t.ron", text));
    assert!(found.is_empty(), "a way through a subgraph may be none: {found:?}");
    let mut graph = graph.unwrap();
    let before = write(&graph);
    let edit = Edit::SetKind { node: "s".into(), kind: "k".into(), graph: None };
    assert!(matches!(apply(&mut graph, edit), Err(EditError::Cycle(_))));
    assert_eq!(write(&graph), before);
}

fn clean_but_for_unknown(text: &str) {
    let (_, found) = read(&SourceText::new("t.ron", text));
    assert!(found.iter().all(|d| d.code == "ST0010"), "{text}\n{found:?}");
}

#[test]
fn impossible_edits_say_why_and_change_nothing() {
    let link = |text: &str| Edit::Link(Box::new(Link::parse(text).unwrap()));
    let a = || "a".to_string();
    for (edit, message) in [
        (link("c -> a"), "the link would close a cycle: a -> b -> c -> a"),
        (link("a -> b"), "there is already a link `a -> b`"),
        (link("a -> a.x"), "a link cannot lead from `a` to itself"),
        (link("a -> z"), "there is no node `z`"),
        (Edit::AddNode(a(), Box::default()), "there is already a node `a`"),
        (Edit::RenameNode(a(), "b".into()), "there is already a node `b`"),
        (Edit::RenameNode(a(), "x/y".into()), "`x/y` cannot name a node because of the `/`"),
        (Edit::Move(a(), Some([f64::NAN, 0.0])), "`a` must be a finite number"),
        (Edit::Unlink(End::node("a"), End::node("c")), "there is no link `a -> c`"),
        (Edit::SetOutput(Some(End::node("z"))), "there is no node `z`"),
        (Edit::SetCollapsed("z".into(), true), "there is no node `z`"),
        (Edit::SetFrame("f".into(), Some(Box::default())), "the frame `f` has no size"),
        (Edit::RenameFrame("f".into(), "g".into()), "there is no frame `f`"),
        (Edit::SetWaypoints(End::node("a"), End::node("c"), vec![]), "there is no link `a -> c`"),
        (
            Edit::SetWaypoints(End::node("a"), End::node("b"), vec![[0.0; 2]; 65]),
            "the graph cannot have more bends in one link",
        ),
        (Edit::Batch(vec![Edit::RemoveNode(a()), link("b -> c"), link("b -> a")]), "there is no node `a`"),
    ] {
        let mut graph = start();
        let before = write(&graph);
        assert_eq!(apply(&mut graph, edit).unwrap_err().to_string(), message);
        assert_eq!(write(&graph), before);
    }
}

fn any_edit() -> impl Strategy<Value = Edit> {
    let name = || prop::sample::select(vec!["a", "b", "c", "d e", "f"]).prop_map(String::from);
    let end = || (name(), prop::option::of("[xyo]")).prop_map(|(node, port)| End { node, port });
    let value = prop_oneof![
        any::<bool>().prop_map(Value::Bool),
        prop::collection::vec(-1e9..1e9, 1..5).prop_map(Value::Numbers),
        any::<String>().prop_map(Value::Text),
    ];
    let position = prop::option::of([-1e4..1e4, -1e4..1e4]);
    let one = prop_oneof![
        (name(), "[a-z]{1,3}").prop_map(|(name, kind)| Edit::AddNode(name, Box::new(Node { kind, ..Node::default() }))),
        name().prop_map(Edit::RemoveNode),
        (name(), name()).prop_map(|(from, to)| Edit::RenameNode(from, to)),
        (name(), "[a-z]{1,3}").prop_map(|(node, kind)| Edit::SetKind { node, kind, graph: None }),
        (name(), "[xyz]", prop::option::of(value)).prop_map(|(node, param, value)| Edit::SetParam {
            node,
            param,
            value
        }),
        (name(), "[xyz]", prop::option::of("[a-z]{0,3}"))
            .prop_map(|(node, option, value)| { Edit::SetOption { node, option, value } }),
        (name(), prop::option::of(any::<String>())).prop_map(|(node, wgsl)| Edit::SetWgsl(node, wgsl)),
        (name(), any::<bool>()).prop_map(|(node, muted)| Edit::SetMuted(node, muted)),
        (name(), any::<String>()).prop_map(|(node, note)| Edit::SetNodeNote(node, note)),
        (end(), end(), any::<String>()).prop_map(|(from, to, note)| Edit::SetLinkNote(from, to, note)),
        any::<String>().prop_map(Edit::SetNote),
        any::<String>().prop_map(Edit::SetName),
        (end(), end()).prop_map(|(from, to)| Edit::Link(Box::new(Link::new(from, to)))),
        (end(), end()).prop_map(|(from, to)| Edit::Unlink(from, to)),
        (name(), position).prop_map(|(node, position)| Edit::Move(node, position)),
        (name(), prop::option::of(1.0..1e4_f64)).prop_map(|(name, size)| {
            let frame = |size| Box::new(Frame { size: [size, 2.0], text: name.clone(), ..Frame::default() });
            Edit::SetFrame(name.clone(), size.map(frame))
        }),
        (name(), name()).prop_map(|(from, to)| Edit::RenameFrame(from, to)),
        (name(), any::<bool>()).prop_map(|(node, collapsed)| Edit::SetCollapsed(node, collapsed)),
        (end(), end(), prop::collection::vec([-1e4..1e4, -1e4..1e4], 0..4))
            .prop_map(|(from, to, points)| Edit::SetWaypoints(from, to, points)),
        prop::option::of(end()).prop_map(Edit::SetOutput),
        end().prop_map(|end| {
            let expose = Expose { inputs: [("i".to_string(), vec![end])].into(), ..Expose::default() };
            Edit::SetExpose(Box::new(expose))
        }),
    ];
    one.prop_recursive(2, 8, 4, |inner| prop::collection::vec(inner, 0..4).prop_map(Edit::Batch))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn inverses_take_everything_back(edits in prop::collection::vec(any_edit(), 1..40)) {
        let mut graph = start();
        let mut states = vec![write(&graph)];
        let mut undo = Vec::new();
        for edit in edits {
            let before = write(&graph);
            match apply(&mut graph, edit) {
                Ok(inverse) => {
                    undo.push(inverse);
                    let written = write(&graph);
                    clean_but_for_unknown(&written);
                    let again = read(&SourceText::new("t.ron", written.clone())).0.unwrap();
                    prop_assert_eq!(write(&again), written.clone());
                    states.push(written);
                }
                Err(_) => prop_assert_eq!(write(&graph), before),
            }
        }
        while let Some(inverse) = undo.pop() {
            prop_assert_eq!(Some(write(&graph)), states.pop());
            let redo = apply(&mut graph, inverse).unwrap();
            let undone = write(&graph);
            let again = apply(&mut graph, redo).unwrap();
            apply(&mut graph, again).unwrap();
            prop_assert_eq!(write(&graph), undone);
        }
        prop_assert_eq!(vec![write(&graph)], states);
    }
}
