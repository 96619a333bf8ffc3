//! `render`: pictures, channels, sizes, and machines without an adapter.

use std::path::Path;

use super::{LIGHT, Ran, SURFACE, names, program, put, run};

/// Renders small; what is said of the adapter does not matter here.
fn small(line: &str, out: &Path) -> Ran {
    run(&format!("render {line} -o {} --size 24x16 --samples 1", out.display()))
}

/// Runs the program where no adapter can be found.
pub(super) fn without_adapter(line: &str) -> Ran {
    let mut command = program();
    command.args(line.split_whitespace()).env("WGPU_BACKEND", "vulkan");
    command.env("VK_DRIVER_FILES", "/nowhere").env("VK_ICD_FILENAMES", "/nowhere");
    command.output().expect("the program starts").into()
}

#[test]
fn pictures_are_png_or_exr_of_the_size_that_was_asked_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let png = folder.path().join("a.png");
    small(&format!("{LIGHT} {SURFACE}"), &png).exits(0).no_data();
    let picture = image::open(&png).expect("a PNG").into_rgba8();
    assert_eq!(picture.dimensions(), (24, 16));
    assert!(picture.pixels().any(|p| p.0 != picture.get_pixel(0, 0).0), "not of one colour");
    let exr = folder.path().join("a.EXR");
    small("graphs/scenes/planar.ron", &exr).exits(0);
    assert_eq!(std::fs::read(&exr).expect("written")[..4], [0x76, 0x2f, 0x31, 0x01]);
    let size = exr::prelude::read_first_flat_layer_from_file(&exr).expect("an EXR").layer_data.size;
    assert_eq!((size.width(), size.height()), (24, 16));
    assert_eq!(names(folder.path()), ["a.EXR", "a.png"]);
}

#[test]
fn every_channel_can_be_shown() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = "graphs/scenes/planar.ron";
    for name in ["radiance", "normal", "depth", "visibility:sun", "irradiance:sun", "map:sun"] {
        let out = folder.path().join(format!("{}.exr", name.replace(':', "_")));
        small(&format!("{scene} --aov {name}"), &out).exits(0);
        let image = exr::prelude::read_first_flat_layer_from_file(&out).unwrap_or_else(|e| panic!("{name}: {e}"));
        let channels = image.layer_data.channel_data.list;
        let all = || channels.iter().flat_map(|c| c.sample_data.values_as_f32());
        assert!(all().all(f32::is_finite), "{name}");
        // Alpha is one everywhere, so it shows nothing.
        let colors = channels.iter().filter(|c| c.name != *"A");
        assert!(colors.flat_map(|c| c.sample_data.values_as_f32()).any(|x| x != 0.0), "{name} shows nothing");
    }
    let out = folder.path().join("x.exr");
    small(&format!("{scene} --aov visibility:moon"), &out).exits(1).says("moon");
    small(&format!("{scene} --aov map:moon"), &out).exits(1).says("moon");
    small("graphs/lights/point.ron graphs/surfaces/lambert.ron --aov map:point", &out).exits(1).says("ST0512");
    small(&format!("{scene} --aov colour"), &out).exits(2).says("expected radiance");
    assert!(!out.exists());
}

#[test]
fn graphs_are_shown_in_a_scene() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = "graphs/scenes/planar.ron";
    let (own, other) = (folder.path().join("own.png"), folder.path().join("other.png"));
    small(scene, &own).exits(0);
    small(&format!("graphs/surfaces/checkered.ron --scene {scene}"), &other).exits(0);
    assert_ne!(std::fs::read(&own).expect("written"), std::fs::read(&other).expect("written"));
    small(&format!("{scene} --scene {scene}"), &other).exits(2).says("--scene");
    small(&format!("{SURFACE} --scene {LIGHT}"), &other).exits(2).says("names a graph");
    small(&format!("{SURFACE} --scene {}/none.ron", folder.path().display()), &other).exits(3).says("ST0501");
    let set = folder.path().join("set.png");
    small(&format!("{scene} --set sun.intensity=0.5"), &set).exits(0);
    assert_ne!(std::fs::read(&own).expect("written"), std::fs::read(&set).expect("written"));
}

#[test]
fn output_that_cannot_be_written_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    small(&format!("{LIGHT} {SURFACE}"), &folder.path().join("no/such/a.png")).exits(3).says("ST0505");
    let taken = folder.path().join("taken.png");
    std::fs::create_dir(&taken).expect("a folder");
    small(&format!("{LIGHT} {SURFACE}"), &taken).exits(3).says("folder");
    small(&format!("{LIGHT} {SURFACE}"), &folder.path().join("a.jpg")).exits(2).says(".png").says(".exr");
    small(&format!("{LIGHT} {SURFACE}"), Path::new("-")).exits(2).says("ST0500");
    run(&format!("render {LIGHT} {SURFACE}")).exits(2).says("--output");
    assert_eq!(names(folder.path()), ["taken.png"]);
}

#[test]
#[cfg(unix)]
fn a_folder_without_permission_is_an_io_error() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().expect("a folder");
    let locked = folder.path().join("locked");
    std::fs::create_dir(&locked).expect("a folder");
    std::fs::set_permissions(&locked, std::fs::Permissions::from_mode(0o555)).expect("set");
    // Nothing is locked for root.
    if std::fs::write(locked.join("probe"), "x").is_err() {
        small(&format!("{LIGHT} {SURFACE}"), &locked.join("a.png")).exits(3).says("ST0505");
        assert_eq!(names(&locked), [""; 0]);
    }
    std::fs::set_permissions(&locked, std::fs::Permissions::from_mode(0o755)).expect("set back");
}

#[test]
fn without_an_adapter_the_package_is_named_and_all_else_works() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("a.png");
    let line = format!("render {LIGHT} {SURFACE} -o {} --size 24x16", out.display());
    without_adapter(&line).exits(4).says("ST0513").says("mesa-vulkan-drivers").no_data();
    let json = without_adapter(&format!("{line} --format json")).exits(4);
    assert_eq!(json.diagnostics()[0]["code"], "ST0513");
    without_adapter(&format!("generate {LIGHT} {SURFACE}")).exits(0);
    without_adapter(&format!("check {LIGHT} {SURFACE}")).exits(0);
    without_adapter("nodes").exits(0);
    without_adapter(&format!("fmt --check {LIGHT}")).exits(0);
    run(&format!("{line} --adapter no_such_adapter")).exits(4).says("no_such_adapter");
    assert_eq!(names(folder.path()), [""; 0]);
}

#[test]
fn an_unknown_backend_is_a_usage_error() {
    let ran = program().args(["render", LIGHT, SURFACE, "-o", "never.png"]).env("WGPU_BACKEND", "glide").output();
    Ran::from(ran.expect("the program starts")).exits(2).says("glide");
}

#[test]
fn mistakes_in_what_a_picture_needs_are_told_with_their_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("a.png");
    put(folder.path(), "not.png", "this is no picture");
    let textured = |image: &str| {
        format!(
            "Graph(version: 1, nodes: {{\"i\": (kind: \"image\", params: {{\"image\": \"{image}\"}}), \
             \"m\": (kind: \"lambert\")}}, links: [\"i.color -> m.albedo\"])"
        )
    };
    let missing = put(folder.path(), "missing.ron", &textured("none.png"));
    let wrong = put(folder.path(), "wrong.ron", &textured("not.png"));
    for command in ["check", "render"] {
        let tail = if command == "render" { format!("-o {} --size 24x16", out.display()) } else { String::new() };
        run(&format!("{command} {LIGHT} {missing} {tail}")).exits(3).says("none.png");
        run(&format!("{command} {LIGHT} {wrong} {tail}")).exits(1).says("not.png");
    }
    let scene = |shape: &str, lights: &str| {
        format!(
            "Scene(version: 1, camera: (position: (0, 1, 4), target: (0, 0, 0), fov: 40), lights: {{{lights}}}, \
             objects: {{\"o\": (shape: {shape}, surface: \"m.ron\")}})"
        )
    };
    put(folder.path(), "m.ron", "Graph(version: 1, nodes: {\"m\": (kind: \"unlit\")})");
    put(folder.path(), "bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 nan\nf 1 2 9\n");
    let cases = [
        (scene("Obj(\"none.obj\")", ""), 3, "none.obj"),
        (scene("Obj(\"bad.obj\")", ""), 1, "bad.obj:"),
        (scene("Sphere(radius: 0)", ""), 1, "ST04"),
        (scene("Sphere(radius: 1)", "\"k\": (graph: \"nolight.ron\")"), 3, "nolight.ron"),
    ];
    for (text, code, mark) in cases {
        let file = put(folder.path(), "s.ron", &text);
        for command in ["check", "render"] {
            let tail = if command == "render" { format!("-o {} --size 24x16", out.display()) } else { String::new() };
            run(&format!("{command} {file} {tail}")).exits(code).says(mark);
        }
    }
    assert!(!out.exists());
}
