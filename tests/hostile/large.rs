//! Too many, too deep, too wide.

use std::fmt::Write;

use super::make;

/// A graph of these nodes and links, each as a graph file writes it.
fn graph(nodes: impl IntoIterator<Item = String>, links: impl IntoIterator<Item = String>) -> String {
    let mut text = String::from("Graph(version: 1, nodes: {\n");
    for node in nodes {
        let _ = writeln!(text, "{node},");
    }
    text.push_str("}, links: [\n");
    for link in links {
        let _ = writeln!(text, "\"{link}\",");
    }
    text.push_str("])");
    text
}

/// A node that could stand alone.
fn sine(i: usize) -> String {
    format!("\"n{i}\": (kind: \"sine\", params: {{\"x\": 0.5}})")
}

fn chain(length: usize) -> String {
    let nodes = (0..length).map(sine);
    graph(nodes, (1..length).map(|i| format!("n{} -> n{i}", i - 1)))
}

#[test]
fn a_hundred_thousand_nodes_are_a_clear_error() {
    let nodes = (0..100_000).map(sine);
    assert_eq!(make(&graph(nodes, [])).fails(), ["ST0060"]);
}

#[test]
fn a_chain_beyond_the_limit_is_a_clear_error() {
    assert_eq!(make(&chain(50_000)).fails(), ["ST0060"]);
}

#[test]
fn a_chain_as_deep_as_the_limit_works_on_a_small_stack() {
    // Two megabytes is what threads get; nothing may recurse over the depth of a graph.
    let work = || make(&chain(shadetree::graph::MAX_NODES)).works();
    let thread = std::thread::Builder::new().stack_size(2 << 20).spawn(work).expect("a thread");
    let wgsl = thread.join().expect("no panic");
    // What another function reads is no `let`, but still a line.
    let value = |l: &str| Some(l.strip_prefix("    ")?.trim_start_matches("let ").split_once(" = ")?.0.to_owned());
    let of_a_node = |name: String| name.strip_prefix('n').is_some_and(|n| n.starts_with(|c: char| c.is_ascii_digit()));
    let lines = wgsl.lines().filter(|l| value(l).is_some_and(of_a_node));
    assert_eq!(lines.count(), shadetree::graph::MAX_NODES, "one line a node");
}

#[test]
fn inline_nodes_in_a_row_stay_shallow() {
    let nodes = (0..5_000).map(|i| format!("\"n{i}\": (kind: \"add\", params: {{\"a\": 0.5, \"b\": 1.5}})"));
    let wgsl = make(&graph(nodes, (1..5_000).map(|i| format!("n{} -> n{i}.a", i - 1)))).works();
    let deepest = wgsl.lines().map(|l| l.matches('(').count()).max();
    assert!(deepest < Some(64), "a line nests {deepest:?} deep");
}

#[test]
fn one_node_can_feed_ten_thousand() {
    let middle = (0..10_000).map(sine);
    let ends = ["\"source\": (kind: \"checker\")".to_owned(), "\"last\": (kind: \"unlit\")".to_owned()];
    let links = (0..10_000).map(|i| format!("source.value -> n{i}.x"));
    let text = graph(middle.chain(ends.clone()), links.clone().chain(["n77 -> last.color".to_owned()]));
    let codes = make(&text);
    // Only one of them is used, so only that is in the text; whoever asks what the others are for is told.
    assert!(codes.found.len() <= 300, "{} diagnostics", codes.found.len());
}

#[test]
fn ten_thousand_links_into_one_node_are_told_in_few_words() {
    let nodes = || (0..10_000).map(|i| format!("\"n{i}\": (kind: \"checker\")"));
    let last = || ["\"last\": (kind: \"lambert\")".to_owned()];
    let codes = make(&graph(nodes().chain(last()), (0..10_000).map(|i| format!("n{i} -> last")))).fails();
    assert!(codes.contains(&"ST0214"), "{codes:?}");
    let codes = make(&graph(nodes().chain(last()), (0..10_000).map(|i| format!("n{i}.color -> last.albedo")))).fails();
    assert!(codes.contains(&"ST0212"), "{codes:?}");
}

#[test]
fn five_hundred_lights_on_one_surface_end() {
    let nodes = (0..500).map(|i| format!("\"n{i}\": (kind: \"point_light\")"));
    let text =
        graph(nodes.chain(["\"last\": (kind: \"lambert\")".to_owned()]), (0..500).map(|i| format!("n{i} -> last")));
    let made = make(&text);
    assert!(made.wgsl.is_some() || made.found.iter().any(|d| d.code.starts_with("ST0")), "neither works nor fails");
}

#[test]
fn as_many_mistakes_as_nodes_are_not_all_listed() {
    let each = |what: &str| graph((0..15_000).map(|i| format!("\"n{i}\": ({what})")), []);
    assert!(make(&each("kind: \"nope\"")).fails().contains(&"ST0200"));
    assert!(make(&each("kind: \"lambert\", params: {\"x\": 1}")).fails().contains(&"ST0203"));
    assert!(make(&each("kind: \"lambert\", options: {\"x\": \"1\"}")).fails().contains(&"ST0201"));
    assert!(make(&each("kind: \"lambert\"")).fails().contains(&"ST0221"));
    let links = (1..15_000).map(|i| format!("n0.nothing -> n{i}.nowhere"));
    let nodes = (0..15_000).map(sine);
    assert!(make(&graph(nodes, links)).fails().contains(&"ST0208"));
}

#[test]
fn many_loose_ends_are_warned_of_in_few_words() {
    let nodes = (0..15_000).map(sine);
    let made = make(&graph(nodes.chain(["\"last\": (kind: \"unlit\")".to_owned()]), []));
    assert!(made.found.len() <= 300, "{} warnings", made.found.len());
    made.works();
}

#[test]
fn one_node_with_thousands_of_settings_is_told_in_few_words() {
    let settings = |n: usize| (0..n).map(|i| format!("\"o{i}\": \"x\"")).collect::<Vec<_>>().join(", ");
    let text = format!("Graph(version: 1, nodes: {{\"m\": (kind: \"lambert\", options: {{{}}})}})", settings(5_000));
    assert!(make(&text).fails().contains(&"ST0201"));
    let text = format!("Graph(version: 1, nodes: {{\"m\": (kind: \"lambert\", params: {{{}}})}})", settings(5_000));
    assert!(make(&text).fails().contains(&"ST0203"));
}

#[test]
fn nesting_is_bounded_in_ron_and_in_wgsl() {
    for depth in [100, 100_000] {
        for (open, close) in [("(", ")"), ("[", "]"), ("{1:", "}"), ("Some(", ")"), ("(a:", ")")] {
            let text = format!("{}1{}", open.repeat(depth), close.repeat(depth));
            assert!(make(&text).fails().contains(&"ST0004"), "{open}");
            let graph = format!("Graph(version: 1, nodes: {{\"a\": (kind: \"sine\", params: {{\"x\": {text}}})}})");
            assert!(make(&graph).fails().contains(&"ST0004"), "{open}");
            make(&open.repeat(depth)).fails();
        }
        let comments = format!("{}{}", "/*".repeat(depth), "*/".repeat(depth));
        let text = format!("{comments}Graph(version: 1, nodes: {{\"a\": (kind: \"unlit\")}})");
        make(&text).works();
        for (open, close) in [
            ("(", ")"),
            ("-", ""),
            ("!", ""),
            ("x[", "]"),
            ("vec2f(", ")"),
            ("abs(", ")"),
            ("{", "}"),
            ("1.0 + (", ")"),
            ("array<", ">"),
        ] {
            let body = format!("{}x{}", open.repeat(depth), close.repeat(depth));
            for wgsl in [
                format!("/// x (scalar; = 1): In.\n/// -> y (scalar): Out.\nfn c(x: f32) -> f32 {{ return {body}; }}"),
                format!("/// x (scalar; = 1): In.\n/// -> y (scalar): Out.\nfn c(x: f32) -> f32 {{ {body} }}"),
                format!("/// x (scalar; = 1): In.\n/// -> y (scalar): Out.\nfn c(x: {body}) -> f32 {{ return 1.0; }}"),
                body.clone(),
            ] {
                let text = format!("Graph(version: 1, nodes: {{\"a\": (kind: \"custom\", wgsl: r#\"{wgsl}\"#)}})");
                // Some of these are valid at a hundred levels; none may panic.
                make(&text);
            }
        }
    }
}

#[test]
fn huge_strings_and_numbers_are_read_or_refused() {
    let long = "x".repeat(4 << 20);
    let with = |fields: &str| format!("Graph(version: 1, nodes: {{\"a\": (kind: \"unlit\", {fields})}})");
    make(&with(&format!("note: \"{long}\""))).works();
    make(&format!("Graph(version: 1, name: \"{long}\", nodes: {{\"a\": (kind: \"unlit\")}})")).works();
    assert!(make(&with(&format!("params: {{\"{long}\": 1}}"))).fails().contains(&"ST0203"));
    make(&format!("Graph(version: 1, nodes: {{\"{long}\": (kind: \"unlit\")}})")).fails();
    make(&format!("Graph(version: 1, nodes: {{\"a\": (kind: \"{long}\")}})")).fails();
    make(&format!("Graph(version: 1, links: [\"{long} -> {long}\"])")).fails();
    make(&format!("Graph(version: 1, nodes: {{\"a\": (kind: \"unlit\")}}, output: \"{long}\")")).fails();
    for number in [
        "1e999",
        "-1e999",
        "NaN",
        "inf",
        "-inf",
        "3.5e38",
        "0x10000000000000000000",
        "1_0",
        "1e",
        "1e99999999999999999999",
        "9999999999999999999999999999999999999999999",
    ] {
        let made = make(&with(&format!("params: {{\"color\": {number}}}")));
        assert!(made.wgsl.is_some() || !made.fails().is_empty(), "{number}");
        let made = make(&format!("Graph(version: {number}, nodes: {{\"a\": (kind: \"unlit\")}})"));
        assert!(made.wgsl.is_none(), "no version: {number}");
    }
    let digits = "9".repeat(1 << 20);
    assert!(make(&with(&format!("params: {{\"color\": {digits}}}"))).wgsl.is_none());
    make(&with(&format!("params: {{\"color\": 0.{digits}}}"))).works();
    let many = vec!["1"; 100_000].join(", ");
    make(&with(&format!("params: {{\"color\": ({many})}}"))).fails();
}

#[test]
fn ten_thousand_lights_on_one_surface_take_no_quadratic_time() {
    // Who looked through all lights for each link, or through all links for each light, would take minutes here.
    let lights = (0..10_000).map(|i| format!("\"l{i}\": (kind: \"point_light\")"));
    let links = (0..10_000).map(|i| format!("l{i} -> body"));
    let text = graph(lights.chain(["\"body\": (kind: \"lambert\")".to_owned()]), links);
    let wgsl = make(&text).works();
    assert_eq!(wgsl.matches(" = lambert(").count(), 10_000);
    // The same through a shadow each.
    let nodes = (0..500).map(|i| format!("\"l{i}\": (kind: \"spot_light\"), \"s{i}\": (kind: \"hard_shadow\")"));
    let links = (0..500).flat_map(|i| [format!("l{i} -> s{i}"), format!("s{i} -> body")]);
    let text = graph(nodes.chain(["\"body\": (kind: \"lambert\")".to_owned()]), links);
    assert_eq!(make(&text).works().matches(" = hard_shadow(").count(), 500);
}
