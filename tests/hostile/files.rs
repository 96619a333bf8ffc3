//! Files that are too large, endless, no files at all, or bombs, given to the program itself with little memory.

use std::process::{Command, Stdio};

use crate::cli::{Ran, put};

/// Runs the program with this much address space, in MiB, and a minute of processor time: only a hang takes so long.
fn within(mebibytes: u32, line: &str) -> Ran {
    let script = format!("ulimit -v {}; ulimit -t 60; exec \"$0\" \"$@\"", u64::from(mebibytes) << 10);
    Command::new("sh")
        .args(["-c", &script, env!("CARGO_BIN_EXE_shadetree")])
        .args(line.split_whitespace())
        .current_dir(crate::support::root())
        .stdin(Stdio::null())
        .output()
        .expect("the shell starts")
        .into()
}

#[test]
fn a_gigabyte_is_refused_without_being_read() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["big.ron", "big.obj", "big.png", "nodes/big.wgsl"] {
        let path = put(folder.path(), name, "");
        std::fs::File::options().write(true).open(path).and_then(|f| f.set_len(1 << 30)).expect("a sparse file");
    }
    let base = folder.path().display();
    within(200, &format!("check {base}/big.ron")).exits(1).says("ST0503").says("64 MiB");
    within(200, &format!("fmt {base}/big.ron")).exits(1).says("ST0503");
    within(200, &format!("nodes --nodes {base}/nodes")).exits(0).says("ST0503");
    let scene = put(
        folder.path(),
        "s.ron",
        "Scene(version: 1, camera: (position: (0, 1, 4), target: (0, 0, 0)), objects: {\"o\": (shape: Obj(\"big.obj\"), surface: \"m.ron\")})",
    );
    let matte = put(folder.path(), "m.ron", "Graph(version: 1, nodes: {\"m\": (kind: \"unlit\")})");
    within(700, &format!("check {scene}")).exits(1).says("ST0503").says("big.obj");
    let image = put(
        folder.path(),
        "i.ron",
        "Graph(version: 1, nodes: {\"i\": (kind: \"image\", params: {\"image\": \"big.png\"})})",
    );
    within(700, &format!("check {image}")).exits(1).says("big.png");
    within(700, &format!("check {matte}")).exits(0);
}

#[test]
fn what_is_no_file_of_text_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let base = folder.path().display();
    within(200, &format!("check {base}")).exits(3).says("ST0502");
    within(300, "check /dev/zero").exits(1).says("ST0503");
    within(200, "check /dev/null").exits(1).says("ST00");
    let path = folder.path().join("latin.ron");
    std::fs::write(&path, b"Graph(version: 1, name: \"caf\xe9\")").expect("written");
    within(200, &format!("check {}", path.display())).exits(1).says("ST0504").says("byte 28");
    let path = folder.path().join("utf16.ron");
    std::fs::write(&path, b"\xff\xfeG\0r\0").expect("written");
    within(200, &format!("check {}", path.display())).exits(1).says("ST0504");
}

#[test]
fn doubling_subgraphs_end_within_bounds() {
    let folder = tempfile::tempdir().expect("a folder");
    for level in 0..30 {
        let next = level + 1;
        let text = format!(
            "Graph(version: 1, nodes: {{\"a\": (graph: \"l{next}.ron\"), \"b\": (graph: \"l{next}.ron\"), \
             \"sum\": (kind: \"add\")}}, links: [\"a -> sum.a\", \"b -> sum.b\"])"
        );
        put(folder.path(), &format!("l{level}.ron"), &text);
    }
    put(folder.path(), "l30.ron", "Graph(version: 1, nodes: {\"x\": (kind: \"checker\")})");
    let base = folder.path().display();
    within(500, &format!("check {base}/l0.ron")).exits(1).says("ST0060");
    // Small enough to be put in place: 2^10 leaves.
    within(900, &format!("check {base}/l20.ron")).exits(0);
}

#[test]
fn exposed_fans_end_within_bounds() {
    // Each level leads its one input to two inner ones: few nodes, but links double.
    let folder = tempfile::tempdir().expect("a folder");
    for level in 0..30 {
        let next = level + 1;
        let text = format!(
            "Graph(version: 1, nodes: {{\"a\": (graph: \"l{next}.ron\"), \"b\": (graph: \"l{next}.ron\")}}, \
             expose: (inputs: {{\"x\": [\"a.x\", \"b.x\"]}}))"
        );
        put(folder.path(), &format!("l{level}.ron"), &text);
    }
    put(
        folder.path(),
        "l30.ron",
        "Graph(version: 1, nodes: {\"n\": (kind: \"sine\")}, expose: (inputs: {\"x\": \"n.x\"}))",
    );
    within(500, &format!("check {}/l0.ron", folder.path().display())).exits(1).says("ST0060");
}

#[test]
fn circles_of_files_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, next) in [("a", "b"), ("b", "c"), ("c", "a")] {
        put(
            folder.path(),
            &format!("{name}.ron"),
            &format!("Graph(version: 1, nodes: {{\"n\": (graph: \"{next}.ron\")}})"),
        );
    }
    within(300, &format!("check {}/a.ron", folder.path().display())).exits(1).says("ST0062");
    std::os::unix::fs::symlink(folder.path().join("loop.ron"), folder.path().join("loop.ron")).expect("a link");
    within(300, &format!("check {}/loop.ron", folder.path().display())).exits(3).says("ST0501");
}

#[test]
fn folders_of_nodes_that_loop_or_overflow_end() {
    let folder = tempfile::tempdir().expect("a folder");
    put(folder.path(), "nodes/bars.wgsl", crate::cli::generate::STRIPES);
    let nodes = folder.path().join("nodes");
    // Two loops: the paths through them double with each level.
    std::os::unix::fs::symlink(&nodes, nodes.join("again")).expect("a link");
    std::os::unix::fs::symlink(&nodes, nodes.join("and_again")).expect("a link");
    let ran = within(600, &format!("nodes bars --nodes {}", nodes.display())).exits(0);
    assert!(ran.text().contains("Bars of a test"), "{}", ran.text());
    assert!(ran.err.lines().count() < 50, "{} lines", ran.err.lines().count());
}

#[test]
fn pictures_that_promise_too_much_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    // A PNG whose header promises 60,000 x 60,000 pixels in four bytes each, and ends there.
    let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xea\x60\0\0\xea\x60\x08\x06\0\0\0".to_vec();
    png.extend(crc(&png[12..29]).to_be_bytes());
    std::fs::write(folder.path().join("huge.png"), png).expect("written");
    std::fs::write(folder.path().join("huge.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n")
        .expect("written");
    std::fs::write(folder.path().join("text.png"), "hello").expect("written");
    std::fs::write(folder.path().join("empty.png"), "").expect("written");
    for name in ["huge.png", "huge.hdr", "text.png", "empty.png"] {
        let graph = put(
            folder.path(),
            "g.ron",
            &format!("Graph(version: 1, nodes: {{\"i\": (kind: \"image\", params: {{\"image\": \"{name}\"}})}})"),
        );
        within(900, &format!("check {graph}")).exits(1).says(name).says("g.ron:1:");
        put(folder.path(), "m.ron", "Graph(version: 1, nodes: {\"m\": (kind: \"unlit\")})");
        let scene = put(
            folder.path(),
            "s.ron",
            &format!(
                "Scene(version: 1, camera: (position: (0, 1, 4), target: (0, 0, 0)), environment: Image(\"{name}\"), objects: {{\"o\": (shape: Sphere(radius: 1), surface: \"m.ron\")}})"
            ),
        );
        within(900, &format!("check {scene}")).exits(1).says(name);
    }
}

/// The check sum of a PNG chunk.
fn crc(bytes: &[u8]) -> u32 {
    let mut crc = u32::MAX;
    for byte in bytes {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            crc = if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 };
        }
    }
    !crc
}

#[test]
fn a_scene_of_a_hundred_thousand_objects_is_a_clear_error() {
    use std::fmt::Write;
    let folder = tempfile::tempdir().expect("a folder");
    put(folder.path(), "m.ron", "Graph(version: 1, nodes: {\"m\": (kind: \"unlit\")})");
    let scene = |count: u32, shape: &str| {
        let mut text = String::from("Scene(version: 1, camera: (position: (0, 1, 4), target: (0, 0, 0)), objects: {\n");
        for i in 0..count {
            let _ = writeln!(text, "\"o{i}\": (shape: {shape}, surface: \"m.ron\"),");
        }
        text + "})"
    };
    let many = put(folder.path(), "s.ron", &scene(100_000, "Sphere(radius: 1)"));
    within(900, &format!("check {many}")).exits(1).says("ST0414");
    let most = put(folder.path(), "t.ron", &scene(20_000, "Plane(size: (1, 1))"));
    within(900, &format!("check {most}")).exits(0).says("1 shader");
}

#[test]
fn models_with_bad_indices_or_numbers_are_told_by_line() {
    let folder = tempfile::tempdir().expect("a folder");
    put(folder.path(), "m.ron", "Graph(version: 1, nodes: {\"m\": (kind: \"unlit\")})");
    let scene = put(
        folder.path(),
        "s.ron",
        "Scene(version: 1, camera: (position: (0, 1, 4), target: (0, 0, 0)), objects: {\"o\": (shape: Obj(\"a.obj\"), surface: \"m.ron\")})",
    );
    let head = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (text, line) in [
        (format!("{head}f 1 2 4\n"), 4),
        (format!("{head}f 0 1 2\n"), 4),
        (format!("{head}f -9 1 2\n"), 4),
        (format!("{head}f 1 2 99999999999999999999\n"), 4),
        (format!("{head}f 1/7 2 3\n"), 4),
        ("v 0 0 nan\n".to_owned(), 1),
        ("v 0 0 inf\n".to_owned(), 1),
        ("v 0 0 1e300\n".to_owned(), 1),
        ("v 0 0\n".to_owned(), 1),
    ] {
        put(folder.path(), "a.obj", &text);
        within(700, &format!("check {scene}")).exits(1).says(&format!("a.obj:{line}:"));
    }
    put(folder.path(), "a.obj", "# nothing\n");
    within(700, &format!("check {scene}")).exits(1).says("a.obj");
}
