//! `simplify`: ladders of examples, their files, and what is refused.

use serde_json::Value;

use super::{names, put, run};
use crate::stage::gpu;

/// The rungs of a run, and its single swaps.
fn records(text: &str) -> (Vec<Value>, Vec<Value>) {
    let all = text.lines().map(|l| serde_json::from_str::<Value>(l).expect("a record"));
    all.partition(|r| r["record"] == "rung")
}

/// Errors rise and costs fall along a ladder that starts at the full material.
fn is_ladder(rungs: &[Value]) {
    assert_eq!(rungs[0]["error"].as_f64(), Some(0.0), "{rungs:?}");
    let cost =
        |r: &Value| r["operations"].as_u64().expect("a count") + 16 * r["texture_reads"].as_u64().expect("a count");
    let error = |r: &Value| r["error"].as_f64().expect("a number");
    for pair in rungs.windows(2) {
        assert!(error(&pair[1]) >= error(&pair[0]) && cost(&pair[1]) < cost(&pair[0]), "{pair:?}");
        assert!(pair[1]["time_ratio"]["median"].as_f64() > Some(0.0), "{pair:?}");
        assert!(pair[1]["swaps"].as_array().is_some_and(|s| !s.is_empty()), "{pair:?}");
    }
}

#[test]
fn ladders_of_examples_hold_and_their_files_are_sound() {
    // Says so where there is no adapter.
    if gpu().is_none() {
        return;
    }
    for (surface, size) in [("rust", "48x36"), ("textured", "40x30")] {
        let folder = tempfile::tempdir().expect("a folder");
        let out = folder.path().join("lods");
        let line = format!("simplify graphs/surfaces/{surface}.ron --size {size} --format json");
        let ran = run(&format!("{line} --max-error 0.5 -o {}", out.display())).exits(0);
        let (rungs, singles) = records(ran.text());
        is_ladder(&rungs);
        assert!(rungs.len() >= 3 && !singles.is_empty(), "{rungs:?}");
        assert!(rungs.iter().all(|r| r["error"].as_f64() <= Some(0.5)), "{rungs:?}");
        let written: Vec<String> = (1..rungs.len()).map(|i| format!("{surface}.lod{i}.ron")).collect();
        assert_eq!(names(&out), written);
        for file in &written {
            let path = out.join(file);
            run(&format!("check {}", path.display())).exits(0);
            run(&format!("fmt --check {}", path.display())).exits(0);
        }
        // Counted costs are the same whenever they are counted, and so are errors on one machine.
        let (again, _) = records(run(&format!("{line} --max-error 0.5")).exits(0).text());
        let chosen =
            |rungs: &[Value]| rungs.iter().map(|r| (r["swaps"].clone(), r["error"].clone())).collect::<Vec<_>>();
        assert_eq!(chosen(&again), chosen(&rungs));
    }
}

#[test]
fn each_distance_has_its_own_ladder_and_lights_stay() {
    if gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let files = "graphs/lights/sun_pcf.ron graphs/surfaces/brick_wall.ron";
    let out = format!("--size 48x36 --rungs 2 --distance 12,4 -o {}", folder.path().display());
    let ran = run(&format!("simplify {files} {out} --format json")).exits(0);
    let (rungs, _) = records(ran.text());
    let (near, far): (Vec<Value>, Vec<Value>) = rungs.into_iter().partition(|r| r["distance"].as_f64() == Some(4.0));
    is_ladder(&near);
    is_ladder(&far);
    assert!(near.len() <= 3 && far.len() <= 3, "{near:?} {far:?}");
    assert!(far.iter().all(|r| r["distance"].as_f64() == Some(12.0)));
    assert!(far[0]["pixels"].as_u64() < near[0]["pixels"].as_u64());
    let listed = names(folder.path());
    assert!(
        listed.iter().any(|n| n == "brick_wall.4m.lod1.ron") && listed.iter().all(|n| !n.contains("sun")),
        "{listed:?}"
    );
    // By time the same files are tried; which are chosen is the machine's affair.
    let ran = run("simplify graphs/surfaces/marble.ron --size 32x24 --by time --max-error 0.3").exits(0);
    assert!(ran.text().contains("full") && ran.text().contains("each swap by itself"), "{}", ran.text());
}

#[test]
fn what_cannot_be_simplified_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    run("simplify graphs/lights/spot_pcf.ron")
        .exits(1)
        .says("ST0750")
        .says("none of the graphs has a surface")
        .no_data();
    let two = "graphs/surfaces/lambert.ron graphs/surfaces/ggx.ron";
    run(&format!("simplify {two}")).exits(1).says("ST0750").says("2 of the graphs");
    run("simplify graphs/scenes/planar.ron").exits(2).says("--scene").no_data();
    run("simplify graphs/surfaces/none.ron").exits(3).says("ST0501");
    run("simplify graphs/surfaces/rust.ron --max-error -1").exits(2);
    let broken = put(folder.path(), "broken.ron", "Graph(version: 1, nodes: {\"a\": (kind: \"lambrt\")})");
    run(&format!("simplify {broken}")).exits(1).no_data();
    let file = put(folder.path(), "file", "x");
    run(&format!("simplify graphs/surfaces/rust.ron -o {file}")).exits(3).says("ST0505").no_data();
    if gpu().is_none() {
        return;
    }
    let far = "simplify graphs/surfaces/rust.ron --size 16x12 --distance 5000";
    run(far).exits(1).says("ST0751").says("--distance").no_data();
    let ran = run("simplify graphs/surfaces/unlit.ron --size 32x24").exits(0).says("ST0753");
    assert!(ran.text().contains("full") && !ran.text().contains("lod1"), "{}", ran.text());
    let node = "//! label: Odd\n//! category: surface\n//! cheaper: kind lambrt - B.\n//! inline\n\n/// color (color): C.\n/// -> radiance (color radiance): R.\nfn odd(color: vec3f) -> vec3f { return color * 2.0; }\n";
    put(folder.path(), "nodes/odd.wgsl", node);
    let graph = put(
        folder.path(),
        "odd.ron",
        "Graph(version: 1, nodes: {\"a\": (kind: \"odd\", params: {\"color\": (0.5, 0.5, 0.5)})})",
    );
    let nodes = folder.path().join("nodes");
    let ran = run(&format!("simplify {graph} --nodes {} --size 32x24", nodes.display())).exits(0);
    ran.says("ST0752").says("did you mean `lambert`?");
}

/// What changes evenly over a triangle is the same whether it is computed for each vertex or for each fragment.
#[test]
fn what_is_linear_is_the_same_at_either_rate() {
    if gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let nodes = |muted: &str| {
        format!(
            "\"at\": (kind: \"position\"), \"parts\": (kind: \"separate3\"), \"scaled\": (kind: \"multiply\", params: {{\"b\": 0.25}}), \"rate\": (kind: \"per_vertex\"{muted}), \"look\": (kind: \"unlit\")"
        )
    };
    let links =
        "\"at -> parts\", \"parts.y -> scaled.a\", \"scaled.product -> rate.value\", \"rate.value -> look.color\"";
    let picture = |name: &str, muted: &str| {
        let graph = format!("Graph(version: 1, nodes: {{{}}}, links: [{links}])", nodes(muted));
        let file = put(folder.path(), &format!("{name}.ron"), &graph);
        let out = folder.path().join(format!("{name}.png"));
        run(&format!("render {file} --size 32x24 -o {}", out.display())).exits(0);
        image::open(&out).expect("a PNG").into_rgb8()
    };
    let (vertex, fragment) = (picture("vertex", ""), picture("fragment", ", muted: true"));
    let shades: std::collections::BTreeSet<u8> = fragment.pixels().map(|p| p.0[0]).collect();
    assert!(shades.len() > 20, "the ball is seen: {shades:?}");
    for (a, b) in vertex.pixels().zip(fragment.pixels()) {
        assert!((0..3).all(|i| a.0[i].abs_diff(b.0[i]) <= 1), "{a:?} is not {b:?}");
    }
}
