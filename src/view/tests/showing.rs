use super::{catalog, clean, end, small};
use crate::node::Default as Given;
use crate::semantic::{Kind, Value};
use crate::view::commands::Pending;
use crate::view::palette::{Fit, find, fit_of};
use crate::view::ports::node_view;

fn kinds(query: &str, fits: Option<&Fit>) -> Vec<String> {
    find(&catalog(), query, fits).into_iter().map(|hit| hit.kind).collect()
}

#[test]
fn a_card_shows_ports_values_and_choices() {
    let graph = clean(
        r#"Graph(version: 1, nodes: {
            "noise": (kind: "fbm3d", params: {"scale": 6, "odd": 1}, options: {"octaves": "3"}),
            "ball": (kind: "lambert"),
        }, links: ["noise.value -> ball.albedo"])"#,
    );
    let view = node_view(&graph, &catalog(), "noise", None);
    assert!(view.known && !view.title.is_empty() && view.category == "procedural" && view.subgraph.is_none());
    let scale = view.inputs.iter().find(|p| p.name == "scale").unwrap();
    assert_eq!(scale.value, Some(Value::Numbers(vec![6.0])));
    assert!(view.inputs.iter().any(|p| p.name == "odd"), "what is said of no port can be seen");
    let (spec, current) = view.options.iter().find(|(spec, _)| spec.name == "octaves").unwrap();
    assert!(current == "3" && spec.choices.contains(current));
    assert!(view.outputs[0].linked);
    let ball = node_view(&graph, &catalog(), "ball", None);
    let albedo = ball.inputs.iter().find(|p| p.name == "albedo").unwrap();
    assert!(albedo.linked && albedo.ty.meaning.kind == Kind::Color && albedo.value.is_none());
    let spaces = node_view(&small(&["s pcf_shadow"], &[]), &catalog(), "s", None);
    assert!(spaces.inputs.iter().any(|p| p.hidden));
}

#[test]
fn what_is_not_known_shows_what_is_said_of_it() {
    let graph = clean(
        r#"Graph(version: 1, nodes: {"a": (kind: "brikc", params: {"p": 1}), "b": (graph: "x/stone wall.ron")},
        links: ["a.o -> b.i", "a -> b.j"])"#,
    );
    let view = node_view(&graph, &catalog(), "a", None);
    assert!(!view.known && view.title == "brikc");
    assert_eq!((view.inputs[0].name.as_str(), view.outputs[0].name.as_str()), ("p", "o"));
    let stand = node_view(&graph, &catalog(), "b", None);
    assert_eq!((stand.title.as_str(), stand.inputs.len(), stand.known), ("stone wall", 2, false));
    assert!(!node_view(&graph, &catalog(), "nobody", None).known);
}

#[test]
fn a_subgraph_shows_what_it_exposes() {
    let inner = clean(
        r#"Graph(version: 1, name: "Stone", note: "Rough.", nodes: {
            "noise": (kind: "fbm3d", params: {"scale": 6}, options: {"octaves": "3"}),
        }, expose: (inputs: {"size": "noise.scale"}, outputs: {"height": "noise.value"}, options: {"detail": "noise.octaves"}))"#,
    );
    let outer = clean(r#"Graph(version: 1, nodes: {"s": (graph: "stone.ron", params: {"size": 2})})"#);
    let view = node_view(&outer, &catalog(), "s", Some(&inner));
    assert!(view.known && view.title == "Stone" && view.doc == "Rough.");
    let size = &view.inputs[0];
    assert_eq!((size.name.as_str(), size.value.clone()), ("size", Some(Value::Numbers(vec![2.0]))));
    assert_eq!(size.default, Some(Given::Value(Value::Numbers(vec![6.0]))));
    assert_eq!(view.outputs[0].name, "height");
    assert_eq!((view.options[0].0.name.as_str(), view.options[0].1.as_str()), ("detail", "3"));
}

#[test]
fn nodes_of_a_graph_show_their_own_ports() {
    let graph = clean(
        "Graph(version: 1, nodes: {\"c\": (kind: \"custom\", wgsl: \"fn c(x: f32) -> vec3f { return vec3f(x); }\")})",
    );
    let view = node_view(&graph, &catalog(), "c", None);
    assert!(view.known && view.inputs[0].name == "x" && view.outputs.len() == 1);
}

#[test]
fn the_palette_finds_what_fits() {
    assert_eq!(kinds("pcss", None)[0], "pcss_shadow");
    assert!(kinds("brk", None).contains(&"brick".to_owned()), "letters in their order as a last resort");
    assert_eq!(kinds("", None).len(), catalog().kinds().count());
    let graph = small(&["spot spot_light", "shadow pcf_shadow", "ball lambert", "bricks brick"], &[]);
    let fit = |text: &str, from_output| fit_of(&graph, &catalog(), &Pending { end: end(text), from_output });
    let lit = kinds("", fit("spot", true).as_ref());
    assert!(
        lit.contains(&"pcf_shadow".to_owned()) && lit.contains(&"ggx".to_owned()) && !lit.contains(&"brick".to_owned())
    );
    let color = fit("ball.albedo", false).unwrap();
    let givers = kinds("", Some(&color));
    assert!(givers.contains(&"brick".to_owned()) && !givers.contains(&"lambert".to_owned()));
    let takers = kinds("", fit("bricks.color", true).as_ref());
    assert!(takers.contains(&"ggx".to_owned()) && !takers.contains(&"texcoord".to_owned()));
    assert_eq!(fit("ball", false), None);
}
