//! `figure`: forms, what is refused, and what is drawn.

use std::path::Path;

use super::{LIGHT, Ran, SURFACE, names, put, run};

fn figure(line: &str, out: &Path) -> Ran {
    run(&format!("figure {line} -o {} --size 24x16", out.display()))
}

#[test]
fn figures_are_svg_or_png_and_come_out_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    let (svg, again, png) = (folder.path().join("a.svg"), folder.path().join("b.SVG"), folder.path().join("a.png"));
    let line = format!("{LIGHT} {SURFACE}");
    figure(&line, &svg).exits(0).no_data();
    figure(&line, &again).exits(0).no_data();
    let text = std::fs::read_to_string(&svg).expect("written");
    assert!(text.starts_with("<svg ") && text.contains("fs_main") && text.contains("data:image/png;base64,"), "{text}");
    assert_eq!(text, std::fs::read_to_string(&again).expect("written"));
    figure(&line, &png).exits(0).no_data();
    let picture = image::open(&png).expect("a PNG").into_rgb8();
    assert!(picture.width() > 2000 && picture.pixels().any(|p| p.0 == [255; 3]));
    let set = folder.path().join("set.svg");
    figure(&format!("{SURFACE} --scene graphs/scenes/planar.ron --set spot.range=7"), &set).exits(1);
    figure(&format!("{line} --set spot.range=7.25"), &set).exits(0);
    assert!(std::fs::read_to_string(&set).expect("written").contains(">7.25</text>"));
    assert_eq!(names(folder.path()), ["a.png", "a.svg", "b.SVG", "set.svg"]);
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("a.svg");
    figure(SURFACE, &folder.path().join("a.pdf")).exits(2).says("neither an .svg nor a .png");
    figure("graphs/scenes/planar.ron", &out).exits(2).says("is a scene");
    figure("no/such.ron", &out).exits(3).says("ST0501");
    let broken = put(folder.path(), "broken.ron", "Graph(version: 1, nodes: {\"a\": (kind: \"no_such_kind\")})\n");
    figure(&broken, &out).exits(1).says("no_such_kind");
    let syntax = put(folder.path(), "syntax.ron", "Graph(version: 1, nodes: {\n");
    figure(&syntax, &out).exits(1).says("syntax.ron");
    assert!(!out.exists());
}
