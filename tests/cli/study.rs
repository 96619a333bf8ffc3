//! `study` and `study merge`: cells are measured once, and nothing that was measured is lost.

use std::path::Path;

use serde_json::Value;

use super::{Ran, put, run};
use crate::stage::gpu;

/// Two shadows at two sizes of their maps.
const STUDY: &str = r#"Study(version: 1, title: "small", plain: "hard", rounds: 2, warm_up: 0,
    truth: (references: ["rays", "pcf"], size: (48, 36), samples: 16),
    cases: {"plate": (scene: "SCENE", light: "sun", class: "one layer")},
    methods: {"hard": (shadow: "hard_shadow"), "PCF": (shadow: "pcf_shadow", set: {"width": 3})},
    grids: [(frames: [(48, 36), (32, 24)], vary: {"size": [64, 128]}, quick: true)])"#;

fn small(folder: &Path) -> String {
    put(
        folder,
        "small.ron",
        &STUDY.replace("SCENE", &crate::support::root().join("graphs/scenes/planar.ron").display().to_string()),
    )
}

fn records(folder: &Path) -> Vec<Value> {
    let text = std::fs::read_to_string(folder.join("results.jsonl")).expect("results");
    text.lines().map(|line| serde_json::from_str(line).expect("a record")).collect()
}

fn study(file: &str, out: &Path, more: &str) -> Ran {
    run(&format!("study {file} -o {} {more}", out.display()))
}

#[test]
fn cells_are_measured_once_and_compared_with_the_plain_map() {
    if gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let (file, out) = (small(folder.path()), folder.path().join("out"));
    study(&file, &out, "").exits(0);
    let all = records(&out);
    assert_eq!(all.len(), 8);
    for record in &all {
        assert_eq!((record["version"].as_u64(), record["class"].as_str()), (Some(1), Some("one layer")));
        assert!(record["failure"].is_null() && record["side"].as_u64().is_some(), "{record}");
        assert_eq!(record["wall"].as_array().map(Vec::len), Some(2));
        assert_eq!(record["plain"].as_array().map(Vec::len), Some(2));
        let error = |reference: &str| record["errors"][reference]["regions"]["all"]["rms"].as_f64();
        // A sharp shadow that is filtered, against the sharp one; and against itself.
        assert!(error("rays").is_some_and(|e| e < 0.3), "{record}");
        // One comparison a pixel is as far from the mean over a texel as that is from 0 or 1.
        let most = if record["method"] == "PCF" { 0.05 } else { 0.1 };
        assert!(error("pcf").is_some_and(|e| e < most), "{record}");
        let pictures = record["pictures"].as_str().expect("pictures");
        assert!(out.join(format!("{pictures}.error.png")).is_file());
    }
    assert_eq!(std::fs::read_to_string(out.join("results.csv")).expect("a table").lines().count(), 9);
    // A crash in the middle of a line costs that line.
    let lines = std::fs::read_to_string(out.join("results.jsonl")).expect("results");
    let cut = lines.len() - 40;
    std::fs::write(out.join("results.jsonl"), &lines[..cut]).expect("written");
    let again = study(&file, &out, "--format json").exits(0);
    let told: Value = serde_json::from_str(again.text()).expect("JSON");
    assert_eq!(told["known"], 0, "the batch of the lost cell is measured again");
    let third: Value = serde_json::from_str(study(&file, &out, "--format json").exits(0).text()).expect("JSON");
    assert_eq!((third["measured"].as_u64(), third["known"].as_u64()), (Some(0), Some(8)));
    // The same folder is not for another study.
    let text = std::fs::read_to_string(&file).expect("there").replace("rounds: 2", "rounds: 3");
    let other = put(folder.path(), "other.ron", &text);
    study(&other, &out, "").exits(1).says("ST0621").no_data();
    let lock = std::fs::File::open(out.join(".lock")).expect("a lock");
    lock.try_lock().expect("free");
    study(&file, &out, "").exits(3).says("ST0620").no_data();
    drop(lock);
    let strange = lines.replace("\"version\":1", "\"version\":9");
    std::fs::write(out.join("results.jsonl"), &strange).expect("written");
    study(&file, &out, "").exits(1).says("ST0662").no_data();
    assert_eq!(std::fs::read_to_string(out.join("results.jsonl")).expect("there"), strange, "left as it is");
}

#[test]
fn parts_of_a_study_are_put_together() {
    if gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string(small(folder.path())).expect("there");
    let second = "\"again\": (scene: \"SCENE\", light: \"sun\", class: \"another\")";
    let scene = crate::support::root().join("graphs/scenes/planar.ron").display().to_string();
    let text = text
        .replace("class: \"one layer\")}", &format!("class: \"one layer\"), {}}}", second.replace("SCENE", &scene)));
    let file = put(folder.path(), "two.ron", &text);
    let parts = [1, 2].map(|i| folder.path().join(format!("part{i}")));
    for (i, part) in parts.iter().enumerate() {
        study(&file, part, &format!("--shard {}/2 --quick", i + 1)).exits(0);
        assert_eq!(records(part).len(), 8);
    }
    let whole = folder.path().join("whole");
    let merge = |more: &str| {
        run(&format!("study merge {} {} -o {} {more}", parts[0].display(), parts[1].display(), whole.display()))
    };
    merge("").exits(0);
    assert_eq!(records(&whole).len(), 16);
    merge("").exits(0);
    assert_eq!(records(&whole).len(), 16, "merging twice adds nothing");
    let path = parts[1].join("results.jsonl");
    let results = std::fs::read_to_string(&path).expect("there");
    let adapter = records(&parts[1])[0]["machine"]["adapter"].as_str().expect("a name").to_owned();
    std::fs::write(&path, results.replace(&adapter, "another adapter")).expect("written");
    merge("").exits(1).says("ST0623").says("another adapter").no_data();
    std::fs::remove_dir_all(&whole).expect("removed");
    merge("--mixed").exits(0);
    assert_eq!(records(&whole).len(), 16);
    run(&format!("study merge {} -o {}", folder.path().display(), whole.display())).exits(3).says("ST0501");
}

#[test]
fn what_cannot_be_measured_is_told_before_anything_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string(small(folder.path())).expect("there");
    let out = folder.path().join("out");
    let with = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        let file = put(folder.path(), "changed.ron", &text.replace(from, to));
        let ran = study(&file, &out, "").no_data();
        assert!(!out.join("results.jsonl").exists());
        ran
    };
    with("\"pcf_shadow\"", "\"pcf_shadw\"").exits(1).says("ST0610").says("did you mean `pcf_shadow`?");
    with("{\"width\": 3}", "{\"with\": 3}").exits(1).says("ST0610").says("`with`");
    with("{\"width\": 3}", "{\"width\": 4}").exits(1).says("ST0610").says("choices are");
    with("light: \"sun\"", "light: \"moon\"").exits(1).says("ST0521").says("case `plate`");
    with("planar.ron", "plan.ron").exits(3).says("plan.ron");
    with("\"rays\"", "\"photons\"").exits(1).says("ST0604");
    with("grids: [", "grids: [], old: [").exits(1).says("ST0601");
    let bare = std::fs::read_to_string("graphs/scenes/planar.ron").expect("a scene");
    let bare = bare
        .replace("shape:", "casts: false, shape:")
        .replace("\"../", &format!("\"{}/graphs/", crate::support::root().display()));
    let bare = put(folder.path(), "bare.ron", &bare);
    let scene = crate::support::root().join("graphs/scenes/planar.ron").display().to_string();
    with(&scene, &bare).exits(1).says("ST0612");
    let listed = run(&format!("study {} --list", small(folder.path()))).exits(0);
    assert_eq!(listed.text().lines().count(), 8);
    run(&format!("study {} -o {} --shard 3/2", small(folder.path()), out.display())).exits(2);
}

#[test]
fn the_studies_of_the_project_are_whole() {
    for file in crate::support::files("graphs/studies", "ron") {
        run(&format!("check {}", file.display())).exits(0).says("no errors");
    }
}
