//! `generate` and `check`: targets, reflection, overrides, user nodes, files whole or not there.

use std::process::Stdio;

use serde_json::Value as Json;

use super::{LIGHT, SURFACE, names, program, put, run, run_fed, run_with};

#[test]
fn every_target_comes_out_in_its_own_form() {
    let wgsl = run(&format!("generate {LIGHT} {SURFACE}")).exits(0);
    assert!(wgsl.text().contains("@fragment\nfn fs_main("), "{}", wgsl.text());
    assert_eq!(wgsl.err, "", "nothing but data");
    let of = |target: &str| run(&format!("generate {LIGHT} {SURFACE} --target {target}")).exits(0);
    assert_eq!(of("wgsl").out, wgsl.out);
    assert!(of("msl").text().contains("#include <metal_stdlib>"));
    assert!(of("hlsl").text().contains("SV_Position") && of("hlsl").text().contains("SV_Target0"));
    let glsl = of("glsl");
    assert_eq!(glsl.text().matches("#version").count(), 2, "a vertex and a fragment shader");
    let spirv = of("spirv").out;
    assert_eq!(spirv[..4], 0x0723_0203_u32.to_le_bytes());
    assert_eq!(spirv.len() % 4, 0);
}

#[test]
fn the_extension_of_the_file_names_the_language() {
    let folder = tempfile::tempdir().expect("a folder");
    for (extension, mark) in [("wgsl", "@fragment"), ("metal", "metal_stdlib"), ("hlsl", "SV_Target0")] {
        let path = folder.path().join(format!("a.{extension}"));
        run(&format!("generate {LIGHT} {SURFACE} -o {}", path.display())).exits(0).no_data();
        let text = std::fs::read_to_string(&path).expect("written");
        assert!(text.contains(mark), "{extension}: {text}");
    }
    let path = folder.path().join("a.spv");
    run(&format!("generate {LIGHT} {SURFACE} -o {}", path.display())).exits(0);
    assert_eq!(std::fs::read(&path).expect("written")[..4], [3, 2, 0x23, 7]);
    let path = folder.path().join("a.glsl");
    run(&format!("generate {LIGHT} {SURFACE} -o {}", path.display())).exits(0);
    let left = ["a.fragment.glsl", "a.hlsl", "a.metal", "a.spv", "a.vertex.glsl", "a.wgsl"];
    let found = names(folder.path());
    assert_eq!(found.len(), left.len(), "{found:?}");
    assert_eq!(found.iter().filter(|n| n.ends_with(".glsl")).count(), 2, "one file a stage: {found:?}");
}

#[test]
fn names_that_contradict_the_target_are_usage_errors() {
    let folder = tempfile::tempdir().expect("a folder");
    let base = folder.path().display();
    run(&format!("generate {LIGHT} {SURFACE} --target msl -o {base}/a.wgsl")).exits(2).says("ST0500").no_data();
    run(&format!("generate {LIGHT} {SURFACE} -o {base}/a.txt")).exits(2).says("names no shading language");
    run(&format!("generate {LIGHT} {SURFACE} --target cuda")).exits(2).says("possible values");
    run("generate").exits(2).says("FILE");
    assert_eq!(names(folder.path()), [""; 0]);
}

#[test]
#[cfg(unix)]
fn binary_output_is_refused_on_a_terminal() {
    // `script` gives the program a terminal; where it is not installed there is nothing to look at.
    let line = format!("{} generate {LIGHT} {SURFACE} --target spirv", env!("CARGO_BIN_EXE_shadetree"));
    let run = std::process::Command::new("script")
        .args(["-qec", &line, "/dev/null"])
        .current_dir(crate::support::root())
        .stdin(Stdio::null())
        .output();
    let Ok(output) = run else {
        assert!(std::env::var_os("CI").is_none(), "CI needs `script` (package bsdutils)");
        return;
    };
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("ST0506") && text.contains("-o"), "{text}");
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn stdin_and_stdout_are_dashes() {
    let light = std::fs::read(crate::support::root().join(LIGHT)).expect("an example");
    let fed = run_fed(&format!("generate - {SURFACE} -o -"), &light).exits(0);
    assert!(fed.text().contains("fn fs_main("), "{}", fed.text());
    run_fed("check -", b"Graph(version: 1, nodes: {\"a\": (kind: \"nope\")})").exits(1).says("-:1:").says("ST0200");
    run_fed("check -", b"").exits(1).says("ST00");
}

#[test]
fn stdin_cannot_be_read_twice() {
    run_fed("check - -", b"Graph(version: 1, nodes: {})").exits(2).says("stdin");
}

#[test]
fn a_reflection_and_a_shader_cannot_share_stdout() {
    run(&format!("generate {LIGHT} {SURFACE} --reflect -")).exits(2).says("--reflect").no_data();
    let folder = tempfile::tempdir().expect("a folder");
    let shader = folder.path().join("a.wgsl");
    let alone = run(&format!("generate {LIGHT} {SURFACE} --reflect - -o {}", shader.display())).exits(0);
    assert!(serde_json::from_str::<Json>(alone.text()).is_ok(), "{}", alone.text());
}

#[test]
fn the_reflection_tells_bindings_parameters_and_passes() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("r.json");
    run(&format!("generate {LIGHT} {SURFACE} --reflect {}", file.display())).exits(0);
    let json: Json = serde_json::from_str(&std::fs::read_to_string(&file).expect("written")).expect("JSON");
    assert_eq!(json["schema"], 1);
    let list = |key: &str| json[key].as_array().unwrap_or_else(|| panic!("no list `{key}` in {json:#}")).clone();
    assert!(!list("bindings").is_empty());
    let passes = json["plan"]["maps"][0]["passes"].as_array().unwrap_or_else(|| panic!("no passes in {json:#}"));
    assert!(passes.iter().all(|p| p["name"].is_string() && p["formats"].is_array()), "{passes:?}");
    assert_eq!(passes[0]["kind"], "geometry");
    let parameters = list("parameters");
    let named = |path: &str| {
        let found = parameters.iter().find(|p| p["path"].as_str().is_some_and(|x| x.ends_with(path)));
        found.unwrap_or_else(|| panic!("no parameter `{path}` in {parameters:?}"))
    };
    for parameter in &parameters {
        assert!(parameter["offset"].as_u64().is_some_and(|o| o % 4 == 0), "{parameter}");
        for key in ["type", "unit", "range", "default"] {
            assert!(parameter.get(key).is_some(), "no `{key}` in {parameter}");
        }
    }
    let roughness = named(".roughness");
    assert_eq!(roughness["type"], "f32");
    assert_eq!(roughness["range"], serde_json::json!([0.0, 1.0]));
    assert_eq!(named(".outer_angle")["unit"], "deg");
}

#[test]
fn overrides_change_the_shader_and_mistakes_in_them_are_input_errors() {
    let plain = run(&format!("generate {LIGHT} {SURFACE} --bake")).exits(0);
    let set = run_with(&["generate", LIGHT, SURFACE, "--bake", "--set", "clay.albedo=(0.125, 0.5, 0.75)"]).exits(0);
    assert!(set.text().contains("vec3f(0.125, 0.5, 0.75)") && !plain.text().contains("vec3f(0.125, 0.5, 0.75)"));
    let wide = run(&format!("generate {LIGHT} {SURFACE} --option shadow.width=7")).exits(0);
    assert_ne!(wide.out, run(&format!("generate {LIGHT} {SURFACE} --option shadow.width=3")).exits(0).out);
    for (argument, code) in [
        ("spto.range=2", "ST0511"),
        ("spot.rnge=2", "ST0203"),
        ("spot.range=(1,x)", "ST0510"),
        ("spot.range=NaN", "ST0510"),
        ("spot.range=-1", "ST0206"),
        ("spot.position=true", "ST0204"),
    ] {
        run_with(&["generate", LIGHT, SURFACE, "--set", argument]).exits(1).says(code).says("help").no_data();
    }
    run(&format!("generate {LIGHT} {SURFACE} --option shadow.width=8")).exits(1).says("ST0202").says("it can be");
    run(&format!("generate {LIGHT} {SURFACE} --set spot.range")).exits(2).says("NODE.NAME=VALUE");
}

#[test]
fn a_broken_user_node_is_told_of_and_the_others_work() {
    let folder = tempfile::tempdir().expect("a folder");
    let nodes = folder.path().join("nodes");
    put(&nodes, "bars.wgsl", STRIPES);
    put(
        &nodes,
        "wrong.wgsl",
        "//! label: Wrong\n//! category: math\n\n/// x (scalar; = 1): In.\n/// -> y (scalar): Out.\nfn wrong(x: f32) -> f32 {\n    return x +;\n}\n",
    );
    let graph =
        "Graph(version: 1, nodes: {\"s\": (kind: \"bars\"), \"m\": (kind: \"lambert\")}, links: [\"s -> m.albedo\"])";
    let file = put(folder.path(), "g.ron", graph);
    let nodes = nodes.display();
    let made = run(&format!("generate {LIGHT} {file} --nodes {nodes}")).exits(0).says("wrong.wgsl:7:");
    assert!(made.text().contains("fn bars("), "{}", made.text());
    // Who checks wants to know of everything.
    run(&format!("check {LIGHT} {file} --nodes {nodes}")).exits(1).says("wrong.wgsl:7:");
    run(&format!("nodes bars --nodes {nodes}")).exits(0).says("wrong.wgsl:7:");
    run(&format!("check {LIGHT} {file}")).exits(1).says("ST0200");
    run(&format!("check {LIGHT} {file} --nodes {nodes}/none")).exits(3).says("ST0501");
}

pub(crate) const STRIPES: &str = "//! label: Bars of a test
//! category: texture
//! Bars along one axis.

/// texcoord (texcoord; = @texcoord): Where.
/// count (scalar; = 8): How many.
/// -> color (color reflectance): Black or white.
fn bars(texcoord: vec2f, count: f32) -> vec3f {
    return vec3f(step(0.5, fract(texcoord.x * count)));
}
";

#[test]
fn check_reports_all_files_at_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let one = put(folder.path(), "one.ron", "Graph(version: 1, nodes: {\"a\" (kind: \"lambert\")})");
    let two = put(folder.path(), "two.ron", "Graph(version: 1, nodes: {}, links: [\"x -> y\"])");
    let three = folder.path().join("three.ron").display().to_string();
    let four = folder.path().display().to_string();
    let ran = run(&format!("check {one} {two} {three} {four}")).exits(3).no_data();
    let ran = ran.says("one.ron:1:").says("two.ron:1:").says("three.ron").says("ST0501").says("ST0502");
    assert!(ran.err.contains("`x`") && ran.err.contains("`y`"), "{}", ran.err);
    run(&format!("check {LIGHT} {SURFACE}")).exits(0).says("no errors; 1 shader").no_data();
    run("check graphs/scenes/car.ron").exits(0).says("no errors");
    assert_eq!(run(&format!("check -q {LIGHT} {SURFACE}")).exits(0).err, "");
}

#[test]
fn nothing_is_written_when_the_input_is_wrong_or_the_output_cannot_be() {
    let folder = tempfile::tempdir().expect("a folder");
    let bad = put(folder.path(), "bad.ron", "Graph(version: 1, nodes: {\"a\": (kind: \"nope\")})");
    let out = put(folder.path(), "out.wgsl", "the last good one");
    let base = folder.path().display();
    run(&format!("generate {bad} -o {out} --reflect {base}/r.json")).exits(1);
    assert_eq!(std::fs::read_to_string(&out).expect("kept"), "the last good one");
    run(&format!("generate {LIGHT} {SURFACE} -o {base}/no/such/a.wgsl")).exits(3).says("ST0505");
    run(&format!("generate {LIGHT} {SURFACE} -o {base} --target wgsl")).exits(3).says("folder");
    run(&format!("generate {LIGHT} {SURFACE} -o {out} --reflect {base}/no/r.json")).exits(3).says("ST0505");
    assert_eq!(std::fs::read_to_string(&out).expect("kept"), "the last good one");
    assert_eq!(names(folder.path()), ["bad.ron", "out.wgsl"]);
}

#[test]
fn a_scene_gives_a_shader_for_each_surface() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("s.wgsl");
    run(&format!("generate graphs/scenes/glass_room.ron -o {}", out.display())).exits(0);
    let files = names(folder.path());
    assert!(files.len() > 1 && files.iter().all(|f| f.starts_with("s.") && f.ends_with(".wgsl")), "{files:?}");
    run(&format!("generate graphs/scenes/glass_room.ron {LIGHT}")).exits(2).says("scene");
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let mut child = program()
        .args(["nodes", "--format", "json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    let ended = child.wait_with_output().expect("it ends");
    assert_eq!((ended.status.code(), String::from_utf8_lossy(&ended.stderr).as_ref()), (Some(0), ""));
}
