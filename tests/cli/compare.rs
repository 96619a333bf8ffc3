//! `compare`: every shadow on a light, measured; and `--kind`, which puts one there.

use serde_json::Value;

use super::{names, put, run};
use crate::stage::gpu;

const PLANAR: &str = "graphs/scenes/planar.ron --light sun --size 48x27";

#[test]
fn shadows_are_measured_and_shown() {
    // Says so where there is no adapter.
    if gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let sheet = folder.path().join("sheet.png");
    let ran =
        run(&format!("compare {PLANAR} --only hard_shadow,pcf_shadow --format json -o {}", sheet.display())).exits(0);
    let rows: Vec<Value> = ran.text().lines().map(|l| serde_json::from_str(l).expect("a row")).collect();
    let kinds: Vec<&str> = rows.iter().filter_map(|r| r["shadow"].as_str()).collect();
    assert_eq!(kinds, ["hard_shadow", "pcf_shadow"]);
    for row in &rows {
        let rms = row["rms"].as_f64().expect("a number");
        // A sharp edge of one plate over a ground: right but for the pixels on it.
        assert!(rms < 0.1 && row["pixels"].as_u64() > Some(400), "{row}");
    }
    // Two kinds side by side: three pictures each, with a line of text above and the gaps between.
    let picture = image::open(&sheet).expect("a PNG");
    assert_eq!((picture.width(), picture.height()), (2 * (3 * (48 + 8) + 8), 16 + 16 + 27 + 16 + 16));
    assert_eq!(names(folder.path()), ["sheet.png"]);
}

#[test]
fn what_cannot_be_compared_is_refused() {
    run("compare graphs/scenes/planar.ron --light moon").exits(1).says("ST0521").says("its lights are sun");
    run("compare graphs/scenes/planar.ron --light sun --only soft_shadow").exits(2).says("is not a kind of shadow");
    run("compare graphs/scenes/planar.ron --light sun -o sheet.jpg").exits(2).says("is not a .png");
    run("compare graphs/lights/sun.ron --light sun").exits(1).says("is not a scene");
    let folder = tempfile::tempdir().expect("a folder");
    let lamp = "Graph(version: 1, nodes: {\"sun\": (kind: \"directional_light\")})";
    let file = put(folder.path(), "lamp.ron", lamp);
    let scene = std::fs::read_to_string("graphs/scenes/planar.ron").expect("a scene");
    let graph = scene.split("graph: \"").nth(1).and_then(|t| t.split('"').next()).expect("a light");
    let scene = put(folder.path(), "bare.ron", &scene.replace(graph, &file));
    run(&format!("compare {scene} --light sun")).exits(1).says("has 0 shadows");
}

#[test]
fn a_node_can_be_of_another_kind_and_keeps_what_it_can() {
    let lights = "graphs/lights/spot_soft.ron graphs/surfaces/lambert.ron";
    let ran = run(&format!("generate {lights} --kind shadow=moment_shadow")).exits(0);
    assert!(ran.text().contains("moment_shadow(") && !ran.text().contains("variance_shadow("));
    run(&format!("generate {lights} --kind shade=pcf_shadow")).exits(1).says("--kind names the node `shade`");
    run(&format!("generate {lights} --kind shadow=pfc_shadow")).exits(1).says("did you mean `pcf_shadow`?");
    run(&format!("generate {lights} --kind shadow")).exits(2).says("NODE=KIND");
}
