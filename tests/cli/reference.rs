//! `render --reference`: the truth, without an adapter.

use std::path::Path;

use super::{Ran, SURFACE, names, put, render::without_adapter};

const SCENE: &str = "graphs/scenes/planar.ron --aov visibility:sun";

/// On a machine without an adapter, small.
fn truth(line: &str, out: &Path) -> Ran {
    without_adapter(&format!("render {line} -o {} --size 24x16", out.display()))
}

/// Red of every pixel, none where nothing is seen.
fn pixels(path: &Path) -> Vec<Option<u8>> {
    let picture = image::open(path).expect("a PNG").into_rgba8();
    assert_eq!(picture.dimensions(), (24, 16));
    picture.pixels().map(|p| (p.0[3] > 0).then_some(p.0[0])).collect()
}

#[test]
fn the_truth_is_written_with_its_error_and_needs_no_adapter() {
    let folder = tempfile::tempdir().expect("a folder");
    let (rays, pcf) = (folder.path().join("rays.png"), folder.path().join("pcf.png"));
    truth(&format!("{SCENE} --reference rays --reference-samples 64"), &rays)
        .exits(0)
        .no_data()
        .says("64 rays a pixel: standard error 0.0");
    truth(&format!("{SCENE} --reference pcf --reference-samples 4"), &pcf)
        .exits(0)
        .no_data()
        .says("each texel as 4 x 4: half as fine differs by 0.0");
    let (rays, pcf) = (pixels(&rays), pixels(&pcf));
    for picture in [&rays, &pcf] {
        let seen: Vec<u8> = picture.iter().flatten().copied().collect();
        assert!(seen.len() > 100 && seen.contains(&0) && seen.contains(&255), "light and shadow: {seen:?}");
    }
    // Both are about the same shadow: few pixels lie on its edge.
    let differ = rays.iter().zip(&pcf).filter(|(a, b)| a.is_some() != b.is_some()).count();
    let apart = rays.iter().zip(&pcf).filter_map(|(a, b)| Some(a.as_ref()?.abs_diff(*b.as_ref()?)));
    assert_eq!((differ, apart.filter(|d| *d > 128).count()), (0, 0));
    let exr = folder.path().join("truth.exr");
    truth(&format!("{SCENE} --reference rays -q"), &exr).exits(0).no_data();
    let size = exr::prelude::read_first_flat_layer_from_file(&exr).expect("an EXR").layer_data.size;
    assert_eq!((size.width(), size.height()), (24, 16));
    assert_eq!(names(folder.path()), ["pcf.png", "rays.png", "truth.exr"]);
}

#[test]
fn the_filter_is_the_shadows_unless_the_command_line_says_otherwise() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("a.png");
    let line =
        format!("graphs/lights/spot_pcf.ron {SURFACE} --aov visibility:spot --reference pcf --reference-samples 2");
    truth(&format!("{line} --option shadow.size=256"), &out).exits(0).says("5 texels of 256, bilinear taps");
    let own = pixels(&out);
    truth(&format!("{line} --option shadow.size=256 --option shadow.taps=nearest --option shadow.width=3"), &out)
        .exits(0)
        .says("3 texels of 256, nearest taps");
    truth(&format!("{line} --option shadow.size=256 --kernel 31"), &out).exits(0).says("31 texels of 256");
    assert_ne!(pixels(&out), own);
}

#[test]
fn lights_of_all_kinds_have_a_truth_by_rays() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("a.png");
    for (light, name) in [("point", "point"), ("spot", "spot"), ("sun_splits", "sun")] {
        let line = format!("graphs/lights/{light}.ron {SURFACE} --aov visibility:{name} --reference rays");
        truth(&format!("{line} --reference-samples 5"), &out).exits(0).says("16 rays a pixel");
        assert!(pixels(&out).contains(&Some(0)), "{light} casts no shadow");
    }
    let line = format!("graphs/lights/spot.ron {SURFACE} --aov visibility:spot --reference rays --set spot.radius=0");
    truth(&line, &out).exits(0).says("one ray a pixel");
    // A surface brings no light: it is shown under the stage's.
    truth(&format!("{SURFACE} --aov visibility:spot --reference rays"), &out).exits(0);
}

#[test]
fn what_has_no_truth_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("a.png");
    let lit = |light: &str, how: &str| format!("graphs/lights/{light}.ron {SURFACE} --aov visibility:{how}");
    truth("graphs/scenes/planar.ron --reference rays", &out).exits(2).says("--aov visibility:LIGHT");
    truth("graphs/scenes/planar.ron --aov depth --reference rays", &out).exits(2).says("visibility");
    truth(&format!("{SCENE} --reference-samples 4"), &out).exits(2).says("--reference");
    truth(&format!("{SCENE} --kernel 4"), &out).exits(2).says("--reference");
    truth(&format!("{SCENE} --reference guess"), &out).exits(2).says("guess");
    truth(&format!("{SCENE} --reference pcf --reference-samples 1"), &out).exits(2).says("2 to 64");
    truth("graphs/scenes/planar.ron --aov visibility:moon --reference rays", &out).exits(1).says("ST0219").says("moon");
    truth(&lit("spot", "spot --reference pcf"), &out).exits(1).says("ST0520").says("no shadow");
    let linked = put(
        folder.path(),
        "linked.ron",
        "Graph(version: 1, nodes: {\"place\": (kind: \"vector3\"), \"lamp\": (kind: \"spot_light\")}, \
         links: [\"place -> lamp.position\"])",
    );
    let line = format!("{linked} {SURFACE} --aov visibility:lamp --reference rays");
    truth(&line, &out).exits(1).says("ST0520").says("`position`");
    truth(&format!("{SCENE} --set no.such=1 --reference rays"), &out).exits(1).says("ST0511");
    truth(&format!("{SCENE} --set sun.center=x --reference rays"), &out).exits(1);
    assert_eq!(names(folder.path()), ["linked.ron"]);
    truth(&format!("{SCENE} --set matte.albedo=1,1,1 --reference rays"), &out).exits(0);
}

#[test]
#[cfg(unix)]
fn ctrl_c_leaves_nothing() {
    use std::process::{Command, Stdio};
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("a.png");
    let mut child = super::program()
        .args(format!("render {SCENE} --reference rays --reference-samples 100000 --size 640x360").split_whitespace())
        .args([Path::new("-o"), &out])
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    std::thread::sleep(std::time::Duration::from_millis(1500));
    assert!(child.try_wait().expect("known").is_none(), "it is at work");
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill runs");
    assert!(sent.success());
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    assert_eq!(names(folder.path()), [""; 0]);
}
