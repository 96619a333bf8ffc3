//! `choose`: the cheapest shadow that keeps to a bound, from a fixed table of costs, and what becomes of it.

use serde_json::Value;

use super::{names, put, run};
use crate::stage::gpu;
use crate::support::expect_file;

/// Constants of no device in particular, so that the choice is the same everywhere.
const COSTS: &str = "tests/cli/costs.json";
const SMALL: &str = "--size 64x48 --costs tests/cli/costs.json";

fn plan(line: &str) -> Value {
    let ran = run(&format!("choose {line} {SMALL} --format json"));
    serde_json::from_slice(&ran.out).unwrap_or_else(|e| panic!("{e}: {}", ran.err))
}

/// A small scene of plates over a ground, under a sharp sun straight above.
fn plates(folder: &std::path::Path, more: &str, casts: bool) -> String {
    put(
        folder,
        "sun.ron",
        "Graph(version: 1, nodes: {\"sun\": (kind: \"directional_light\", params: {\"angle\": 0, \"direction\": (0.2, -1, 0.1)}), \"shadow\": (kind: \"pcf_shadow\")}, links: [\"sun -> shadow\"])",
    );
    put(folder, "matte.ron", "Graph(version: 1, nodes: {\"matte\": (kind: \"lambert\")})");
    let flag = if casts { "" } else { ", casts: false" };
    let text = format!(
        "Scene(version: 1, camera: (position: (1, 3, 4), target: (0, 0.2, 0), fov: 40), lights: {{\"sun\": (graph: \"sun.ron\")}}, objects: {{\n\
         \"ground\": (shape: Plane(size: (6, 6)), surface: \"matte.ron\"{flag}),\n\
         \"plate\": (shape: Plane(size: (1, 1)), surface: \"matte.ron\", translate: (0, 1, 0){flag}),\n{more}}})"
    );
    put(folder, "scene.ron", &text)
}

#[test]
fn the_plan_of_the_parallel_plates_is_as_expected() {
    assert!(std::path::Path::new(COSTS).exists());
    let ran = run(&format!("choose graphs/scenes/planar.ron --max-error 0.03 --explain {SMALL}")).exits(0);
    expect_file("tests/golden/choose/planar.txt", &ran.out);
    let again = run(&format!("choose graphs/scenes/planar.ron --max-error 0.03 --explain {SMALL}")).exits(0);
    assert_eq!(ran.out, again.out, "the same table gives the same plan");
}

#[test]
fn a_tighter_bound_costs_no_less_and_its_bound_is_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = plates(folder.path(), "", true);
    let of = |error: f64| plan(&format!("{scene} --max-error {error}"));
    let (loose, tight) = (of(0.15), of(0.06));
    let number = |plan: &Value, name: &str| plan["chosen"][name].as_f64().expect("a number");
    assert_eq!((&loose["verdict"], &tight["verdict"]), (&"met".into(), &"met".into()), "{loose} {tight}");
    assert!(number(&loose, "bound") <= 0.15 && number(&tight, "bound") <= 0.06);
    assert!(number(&loose, "ms") <= number(&tight, "ms"));
    let cheap = plan(&format!("{scene} --max-error 0.06 --budget-ms 0.0001"));
    assert_eq!(cheap["verdict"], "unmet", "no shadow is that cheap");
}

#[test]
fn where_nothing_casts_there_is_no_shadow_code_and_no_device_is_asked() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = plates(folder.path(), "", false);
    let out = folder.path().join("chosen.ron");
    let ran = run(&format!("choose {scene} --max-error 0.01 -o {}", out.display())).exits(0);
    assert!(ran.text().contains("no shadow code: nothing casts a shadow"), "{}", ran.text());
    let graph = std::fs::read_to_string(&out).expect("a graph");
    assert!(!graph.contains("shadow") && graph.contains("directional_light"), "{graph}");
}

#[test]
fn the_chosen_graph_is_canonical_and_its_scene_can_be_checked() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = plates(folder.path(), "", true);
    let out = folder.path().join("chosen");
    run(&format!("choose {scene} --max-error 0.15 -o {} {SMALL}", out.display())).exits(0);
    assert_eq!(names(&out), ["scene.ron", "sun.ron"]);
    run(&format!("check {}/scene.ron", out.display())).exits(0);
    run(&format!("check {}/sun.ron", out.display())).exits(0);
    run(&format!("fmt --check {0}/scene.ron {0}/sun.ron", out.display())).exits(0);
}

#[test]
fn what_is_chosen_holds_its_bound_when_it_is_rendered() {
    if gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let scene = plates(folder.path(), "", true);
    let plan = plan(&format!("{scene} --max-error 0.12 --verify"));
    let verified = plan["verified"].as_array().expect("a list");
    assert_eq!(verified.last().map(|v| &v["holds"]), Some(&Value::Bool(true)), "{plan}");
}

#[test]
fn what_cannot_be_chosen_for_is_refused() {
    let choose = |line: &str| run(&format!("choose {line}"));
    choose("graphs/scenes/planar.ron --max-error 0").exits(2).says("above 0");
    choose("graphs/scenes/planar.ron --max-error NaN").exits(2).says("above 0");
    choose("graphs/scenes/planar.ron --max-error 0.1 --budget-ms -1").exits(2);
    choose("graphs/scenes/planar.ron --max-error 0.1 --metric best").exits(2).says("metrics are rms");
    choose("graphs/lights/sun.ron --max-error 0.1").exits(1).says("ST0700");
    choose("graphs/scenes/planar.ron --max-error 0.1 --light moon").exits(1).says("ST0702").says("its lights are sun");
    choose("graphs/scenes/three_lights.ron --max-error 0.1 -o one.ron").exits(2).says("ST0705");
    choose("graphs/scenes/planar.ron --max-error 0.1 --costs README.md").exits(1).says("ST0706");
    let folder = tempfile::tempdir().expect("a folder");
    let scene = plates(folder.path(), "", true);
    let text = std::fs::read_to_string(&scene).expect("a scene");
    let dark = put(folder.path(), "dark.ron", &text.replace("lights: {\"sun\": (graph: \"sun.ron\")}, ", ""));
    choose(&format!("{dark} --max-error 0.1")).exits(1).says("ST0701");
    let two = "Graph(version: 1, nodes: {\"a\": (kind: \"spot_light\"), \"b\": (kind: \"spot_light\")}, output: \"a\")";
    put(folder.path(), "sun.ron", two);
    choose(&format!("{scene} --max-error 0.1 {SMALL}")).exits(1).says("ST0703");
}
