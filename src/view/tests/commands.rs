use super::{after, catalog, clean, end, links, set, small};
use crate::graph::{Edit, End};
use crate::view::commands::*;

fn brick() -> crate::graph::Graph {
    clean(
        r#"Graph(version: 1, nodes: {
            "bricks": (kind: "brick", params: {"columns": 12}),
            "bump": (kind: "bump", params: {"amplitude": 0.01}),
            "wall": (kind: "oren_nayar", params: {"roughness": 0.5}),
        }, links: [(link: "bricks.color -> wall.albedo", note: "n"), "bricks.mask -> bump.height", "bump -> wall"],
        layout: {"bricks": (0, 0), "bump": (200, 100), "wall": (400, 0)},
        frames: {"all": (at: (-10, -10), size: (1000, 1000)), "one": (at: (-5, -5), size: (100, 50))},
        waypoints: {"bricks.color -> wall.albedo": [(300, -50)]})"#,
    )
}

fn lamp() -> crate::graph::Graph {
    small(
        &["spot spot_light", "shadow pcf_shadow", "ball lambert", "noise fbm3d"],
        &["spot -> shadow", "shadow -> ball", "noise -> ball.albedo"],
    )
}

#[test]
fn names_are_short_and_free() {
    let graph = small(&["perlin k", "perlin_2 k", "a-7 k"], &[]);
    for (wanted, free) in [
        ("perlin", "perlin_3"),
        ("perlin_2", "perlin_3"),
        ("new", "new"),
        ("a-7", "a-7_2"),
        ("a.b/c", "abc"),
        ("  ", "node"),
        ("...", "node"),
    ] {
        assert_eq!(free_name(&graph, wanted), free);
    }
    let long = free_name(&graph, &"ä".repeat(200));
    assert!(crate::graph::check_name(&long).is_ok(), "{long}");
    for (kind, name) in [("fbm3d", "fbm"), ("pcss_shadow", "shadow"), ("spot_light", "spot"), ("separate3", "separate")]
    {
        let (edit, given) = add(&graph, &catalog(), kind, [1.0, 2.0]);
        assert_eq!(given, name);
        let changed = after(&graph, edit);
        assert_eq!((changed.nodes[name].kind.as_str(), changed.layout[name]), (kind, [1.0, 2.0]));
    }
}

#[test]
fn links_are_made_replaced_or_refused_in_words() {
    let (graph, catalog) = (brick(), catalog());
    let with = |from: &str, to: &str| connect(&graph, &catalog, &end(from), &end(to));
    let linked = after(&graph, with("bricks.mask", "wall.roughness").unwrap());
    assert!(links(&linked).contains(&"bricks.mask -> wall.roughness".to_owned()));
    let replaced = after(&graph, with("bricks.mask", "wall.albedo").unwrap());
    assert_eq!(links(&replaced), ["bricks.mask -> bump.height", "bricks.mask -> wall.albedo", "bump -> wall"]);
    assert!(replaced.waypoints.is_empty());
    for (from, to, why) in [
        ("wall", "bricks.columns", "`wall` gives color radiance (vec3f), and `bricks.columns` takes"),
        ("wall", "wall.albedo", "cannot depend on itself"),
        ("bump", "wall", "they are linked already"),
        ("nobody", "wall", "there is no node `nobody`"),
        ("bricks.nothing", "wall", "has no output `nothing`"),
        ("bricks", "wall.nothing", "has no input `nothing`"),
    ] {
        let said = with(from, to).unwrap_err();
        assert!(said.contains(why), "{from} -> {to}: {said}");
    }
    let chain = small(&["a add", "b add", "c add"], &["a -> b.a", "b -> c.a"]);
    let said = connect(&chain, &catalog, &end("c"), &end("a.a")).unwrap_err();
    assert_eq!(said, "`a` feeds `c` already, and nothing can feed itself");
    let dark = small(&["spot spot_light", "ball lambert"], &[]);
    let lit = after(&dark, connect(&dark, &catalog, &end("spot"), &end("ball")).unwrap());
    assert_eq!(links(&lit), ["spot -> ball"]);
}

#[test]
fn dropped_wires_find_their_port() {
    let catalog = catalog();
    let wire = |end: End, from_output| Pending { end, from_output };
    let graph = brick();
    let (edit, name) = add_linked(&graph, &catalog, "ggx", [0.0; 2], &wire(end("bricks.color"), true)).unwrap();
    assert!(links(&after(&graph, edit)).contains(&format!("bricks.color -> {name}.base_color")));
    let (edit, name) = add_linked(&graph, &catalog, "checker", [0.0; 2], &wire(end("wall.albedo"), false)).unwrap();
    let changed = links(&after(&graph, edit));
    assert!(changed.contains(&format!("{name} -> wall.albedo")) && changed.len() == 3, "{changed:?}");
    let lamp = lamp();
    let (edit, name) = add_linked(&lamp, &catalog, "hard_shadow", [0.0; 2], &wire(end("spot"), true)).unwrap();
    assert!(links(&after(&lamp, edit)).contains(&format!("spot -> {name}")));
    assert!(add_linked(&graph, &catalog, "checker", [0.0; 2], &wire(end("wall"), true)).is_none());
}

#[test]
fn deleting_can_heal_the_wires() {
    let graph = small(&["a k", "b k", "c k", "d k"], &["a -> b", "b -> c.x", "b.o -> d"]);
    let gone = after(&graph, delete(&graph, &set(&["b", "nobody"]), false));
    assert!(gone.links.is_empty() && gone.nodes.len() == 3);
    let healed = after(&graph, delete(&graph, &set(&["b"]), true));
    assert_eq!(links(&healed), ["a -> c.x", "a -> d"]);
    let healed = after(&graph, delete(&graph, &set(&["a", "b"]), true));
    assert!(healed.links.is_empty());
}

#[test]
fn copies_keep_what_lies_inside() {
    let graph = brick();
    let text = copy(&graph, &set(&["bricks", "wall"]));
    let part = clean(&text);
    assert_eq!(links(&part), ["bricks.color -> wall.albedo"]);
    assert_eq!(part.frames.keys().collect::<Vec<_>>(), ["one"]);
    let (edit, names) = paste(&graph, &text, Some([1000.0, 500.0])).unwrap();
    assert_eq!(names, set(&["bricks_2", "wall_2"]));
    let pasted = after(&graph, edit);
    assert_eq!(pasted.layout["bricks_2"], [1005.0, 505.0]);
    assert_eq!(pasted.nodes["wall_2"].params, graph.nodes["wall"].params);
    assert_eq!(pasted.waypoints[&(end("bricks_2.color"), end("wall_2.albedo"))], [[1305.0, 455.0]]);
    assert!(pasted.frames.contains_key("one 2") && pasted.links.iter().any(|l| l.note == "n" && l.to.node == "wall_2"));
    assert!(paste(&graph, "Graph(", None).is_err() && paste(&graph, "nonsense", None).is_err());
    let (edit, names) = duplicate(&graph, &set(&["wall"]), true);
    assert_eq!(names, set(&["wall_2"]));
    let twice = links(&after(&graph, edit));
    assert!(
        twice.contains(&"bricks.color -> wall_2.albedo".to_owned()) && twice.contains(&"bump -> wall_2".to_owned())
    );
    let (edit, _) = duplicate(&graph, &set(&["wall"]), false);
    assert_eq!(after(&graph, edit).links.len(), 3);
}

#[test]
fn kinds_are_swapped_with_their_wires() {
    let (graph, catalog) = (brick(), catalog());
    let swapped = after(&graph, swap_kind(&graph, &catalog, "wall", "ggx"));
    assert_eq!(swapped.nodes["wall"].kind, "ggx");
    assert!(swapped.nodes["wall"].params.contains_key("roughness"));
    assert_eq!(links(&swapped)[0], "bricks.color -> wall.base_color");
    assert_eq!(swapped.links[0].note, "n");
    assert_eq!(swapped.waypoints[&(end("bricks.color"), end("wall.base_color"))], [[300.0, -50.0]]);
    let unpinned = after(&graph, swap_kind(&graph, &catalog, "wall", "time"));
    assert!(links(&unpinned).contains(&"bricks.color -> wall".to_owned()));
    assert!(unpinned.nodes["wall"].params.is_empty());
    let lamp = lamp();
    let kinds = compatible_kinds(&lamp, &catalog, "shadow");
    let shadows: Vec<String> = catalog
        .files()
        .filter(|f| f.header().unwrap().category == "shadow" && f.kind() != "pcf_shadow")
        .map(|f| f.kind().to_owned())
        .collect();
    assert_eq!(kinds, shadows);
    let lights = compatible_kinds(&lamp, &catalog, "spot");
    assert_eq!(lights, ["directional_light", "point_light", "rectangle_light"]);
    let surfaces = compatible_kinds(&lamp, &catalog, "ball");
    assert!(surfaces.contains(&"oren_nayar".to_owned()) && !surfaces.contains(&"fbm3d".to_owned()), "{surfaces:?}");
    let noises = compatible_kinds(&lamp, &catalog, "noise");
    assert!(noises.contains(&"perlin3d".to_owned()) && !noises.contains(&"spot_light".to_owned()));
}

#[test]
fn nodes_are_put_on_wires() {
    let (graph, catalog) = (lamp(), catalog());
    let at = [5.0, 5.0];
    let (from, to) = (end("noise"), end("ball.albedo"));
    let (edit, name) = insert_on_link(&graph, &catalog, &from, &to, Insert::Kind("color_ramp2"), at).unwrap();
    let changed = links(&after(&graph, edit));
    assert!(
        changed.contains(&format!("noise -> {name}.factor")) && changed.contains(&format!("{name} -> ball.albedo")),
        "{changed:?}"
    );
    let (edit, name) =
        insert_on_link(&graph, &catalog, &end("shadow"), &end("ball"), Insert::Kind("hard_shadow"), at).unwrap();
    let changed = links(&after(&graph, edit));
    assert!(changed.contains(&format!("shadow -> {name}")) && changed.contains(&format!("{name} -> ball")));
    assert!(insert_on_link(&graph, &catalog, &from, &to, Insert::Node("spot"), at).is_none());
    assert!(insert_on_link(&graph, &catalog, &from, &to, Insert::Kind("glass"), at).is_none());
    let mut free = graph.clone();
    free.nodes.insert("g".into(), crate::graph::Node { kind: "gamma".into(), ..Default::default() });
    let (edit, _) = insert_on_link(&free, &catalog, &from, &to, Insert::Node("g"), at).unwrap();
    assert!(links(&after(&free, edit)).contains(&"g -> ball.albedo".to_owned()));
}

#[test]
fn things_are_put_in_line() {
    let graph = brick();
    let sizes = |_: &str| [100.0, 60.0];
    let all = set(&["bricks", "bump", "wall"]);
    let place = |how, name: &str| after(&graph, align(&graph, &all, &sizes, how)).layout[name];
    assert_eq!(place(How::Left, "wall"), [0.0, 0.0]);
    assert_eq!(place(How::Right, "bricks"), [400.0, 0.0]);
    assert_eq!(place(How::Top, "bump"), [200.0, 0.0]);
    assert_eq!(place(How::Bottom, "wall"), [400.0, 100.0]);
    assert_eq!(place(How::CenterX, "bricks"), [200.0, 0.0]);
    assert_eq!(place(How::CenterY, "bump"), [200.0, 50.0]);
    let uneven = after(&graph, Edit::Move("bump".into(), Some([50.0, 0.0])));
    assert_eq!(after(&uneven, align(&uneven, &all, &sizes, How::DistributeX)).layout["bump"], [200.0, 0.0]);
    let moved = after(&graph, move_all(&graph, &set(&["bricks", "wall"]), [1.0, 2.0]));
    assert_eq!((moved.layout["wall"], moved.layout["bump"]), ([401.0, 2.0], [200.0, 100.0]));
    assert_eq!(moved.waypoints.values().next().unwrap(), &[[301.0, -48.0]]);
    let moved = after(&graph, move_frame(&graph, "all", [10.0, 0.0], &sizes));
    assert_eq!((moved.layout["bump"], moved.frames["one"].at), ([210.0, 100.0], [5.0, -5.0]));
    let (edit, title) = frame(&graph, &set(&["bump"]), &sizes);
    assert_eq!(after(&graph, edit).frames[&title].size, [148.0, 140.0]);
    let muted = after(&graph, set_muted(&graph, &all, true));
    assert!(muted.nodes.values().all(|n| n.muted));
    assert_eq!(after(&graph, set_collapsed(&graph, &all, true)).collapsed, all);
}

#[test]
fn pins_keep_notes_and_bends() {
    let graph = after(&brick(), Edit::SetWaypoints(end("bump"), end("wall"), vec![[1.0, 2.0]]));
    let pinned = after(&graph, pin(&graph, &end("bump"), &end("wall"), "normal", "normal"));
    assert!(links(&pinned).contains(&"bump.normal -> wall.normal".to_owned()));
    assert_eq!(pinned.waypoints[&(end("bump.normal"), end("wall.normal"))], [[1.0, 2.0]]);
    let same = after(&graph, expose(&graph, "wall", "albedo", "the color"));
    assert_eq!(same.expose.inputs["the_color"], [end("wall.albedo")]);
    assert!(after(&same, unexpose(&same, "wall", "albedo")).expose.is_empty());
}
