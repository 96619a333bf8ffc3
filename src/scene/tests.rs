//! Scene files: round trips, mistakes, hostile texts, and every example.

use proptest::prelude::*;

use super::*;
use crate::diagnostic::{SourceText, has_errors};

const FULL: &str = r#"Scene(
    version: 1,
    name: "All",
    note: "Every field once",
    camera: (position: (1, 2, 3), target: (0, 0.5, 0), up: (0, 0, 1), fov: 35.5, near: 0.05, far: 50, aperture: 2.8),
    environment: Sky(zenith: (0.1, 0.2, 0.3), intensity: 0.5),
    lights: {
        "a": (
            graph: "../lights/spot_vsm.ron",
            set: {"spot.intensity": 12.5, "spot.position": (1, 2, 3), "x.flag": true, "x.image": "a.png"},
        ),
    },
    objects: {
        "ball": (
            note: "A ball",
            shape: Sphere(radius: 0.5, segments: 32),
            surface: "a.ron",
            set: {"lambert.albedo": (0.1, 0.2, 0.3)},
            translate: (0, 0.5, 0),
            rotate: (10, 20, 30),
            scale: 2,
            casts: false,
            receives: false,
            layer: [1, "two", Three(x: 4)],
        ),
        "box": (
            shape: Box(size: (1, 2, 3), bevel: 0.05),
            surface: "a.ron",
            scale: (1, 2, 1),
        ),
        "model": (
            shape: Obj("car.obj"),
            surface: "a.ron",
        ),
        "plane": (
            shape: Plane(size: (2, 3), segments: (4, 5)),
            surface: "a.ron",
        ),
        "ring": (
            shape: Torus(major: 1, minor: 0.25),
            surface: "a.ron",
        ),
        "tube": (
            shape: Cylinder(radius: 0.1, height: 2, capped: false),
            surface: "a.ron",
        ),
    },
    future: Some("thing"),
)
"#;

fn read_text(text: &str) -> (Option<Scene>, Vec<String>) {
    let (scene, found) = read(&SourceText::new("s.ron", text));
    let spot = |d: &crate::diagnostic::Diagnostic| match &d.place.span {
        Some(span) => format!("{} {}", d.code, &span.source.text[span.range.clone()].lines().next().unwrap_or("")),
        None => d.code.to_string(),
    };
    (scene, found.iter().map(spot).collect())
}

#[test]
fn a_full_scene_survives_byte_for_byte() {
    let (scene, found) = read_text(FULL);
    assert_eq!(found, ["ST0010 aperture", "ST0010 layer", "ST0010 future"]);
    assert_eq!(write(&scene.unwrap()), FULL);
}

#[test]
fn order_and_spelling_become_canonical_and_comments_notes() {
    let text = "// top\nScene(objects: {\"b\": (surface: \"s\", shape: Sphere, /* why */ scale: (2.0, 2., 2)), \
                \"a\": (shape: Obj(path: \"m.obj\"), surface: \"s\")}, environment: Color((1, 0.50, 0)), version: 1, \
                camera: (far: 100.0, position: (0, 0, 1e0), target: (0, 0, 0)))";
    let (scene, found) = read_text(text);
    assert!(found.is_empty(), "{found:?}");
    let expected = r#"Scene(
    version: 1,
    note: "top",
    camera: (position: (0, 0, 1), target: (0, 0, 0), fov: 40),
    environment: Color(1, 0.5, 0),
    objects: {
        "a": (
            shape: Obj("m.obj"),
            surface: "s",
        ),
        "b": (
            note: "why",
            shape: Sphere(radius: 0.5),
            surface: "s",
            scale: 2,
        ),
    },
)
"#;
    assert_eq!(write(&scene.unwrap()), expected);
}

#[test]
fn every_mistake_has_its_code_and_place() {
    let object = |inner: &str| format!("Scene(version: 1, camera: (fov: 40), objects: {{\"o\": ({inner})}})");
    let scene = |inner: &str| {
        format!("Scene(version: 1, camera: ({inner}), objects: {{\"o\": (shape: Sphere, surface: \"s\")}})")
    };
    let cases = [
        ("Graph(version: 1)".to_string(), "ST0400 Graph"),
        ("Scene(version: 2)".into(), "ST0402 2"),
        ("Scene(version: \"1\", camera: (fov: 40), objects: {})".into(), "ST0401 \"1\""),
        ("Scene(version: 1, objects: {})".into(), "ST0403 Scene"),
        (scene("fov: 180"), "ST0404 180"),
        (scene("fov: NaN"), "ST0009 NaN"),
        (scene("near: 0"), "ST0404 0"),
        (scene("near: 2, far: 1"), "ST0406 1"),
        (scene("position: (1, 2, 3), target: (1, 2, 3)"), "ST0405 (1, 2, 3)"),
        (scene("position: (0, 5, 0), target: (0, 0, 0), up: (0, 2, 0)"), "ST0405 (0, 2, 0)"),
        (object("shape: Sphere(radius: 0), surface: \"s\""), "ST0407 Sphere(radius: 0)"),
        (object("shape: Box(size: (1, -1, 1)), surface: \"s\""), "ST0407 Box(size: (1, -1, 1))"),
        (object("shape: Box(bevel: 0.6), surface: \"s\""), "ST0404 Box(bevel: 0.6)"),
        (object("shape: Torus(major: 1, minor: 2), surface: \"s\""), "ST0404 Torus(major: 1, minor: 2)"),
        (object("shape: Sphere(segments: 1e9), surface: \"s\""), "ST0404 1e9"),
        (object("shape: Spere(radius: 1), surface: \"s\""), "ST0408 Spere(radius: 1)"),
        (object("shape: Sphere(radios: 1), surface: \"s\""), "ST0409 radios"),
        (object("shape: Sphere, surface: \"s\", scale: 0"), "ST0407 0"),
        (object("shape: Sphere, surface: \"s\", scale: (1, inf, 1)"), "ST0009 inf"),
        (object("shape: Sphere, surface: \"\""), "ST0411 \"\""),
        (object("shape: Sphere, surface: \"s\", set: {\"albedo\": 1}"), "ST0412 \"albedo\""),
        (object("shape: Sphere, surface: \"s\", set: {\"a.b\": None}"), "ST0413 None"),
        ("Scene(version: 1, camera: (fov: 40), objects: {\"o\": (shape: Sphere, surface: \"s\"), \"o\": (shape: Box, surface: \"s\")})".into(), "ST0006 \"o\""),
    ];
    for (text, expected) in cases {
        let (_, found) = read_text(&text);
        assert!(found.iter().any(|f| f == expected), "{text}\nexpected {expected}, found {found:?}");
    }
    let (_, found) = read_text("Scene(camera: (fov: 0), objects: {\"o\": (scale: 0)}, environment: Colour(1))");
    let codes: Vec<&str> = found.iter().map(|f| &f[..6]).collect();
    assert_eq!(codes, ["ST0401", "ST0404", "ST0408", "ST0011", "ST0407", "ST0011"]);
    let (scene, found) = read_text("Scene(version: 1, camera: (fov: 40))");
    assert!(scene.is_some() && found.len() == 1 && found[0].starts_with("ST0410"), "{found:?}");
}

#[test]
fn codes_are_sorted_and_explained_once() {
    assert!(CODES.windows(2).all(|pair| pair[0].0 < pair[1].0));
}

#[test]
fn rotations_turn_about_fixed_axes_x_first() {
    let turned = |rotate| Transform { rotate, ..Transform::default() }.matrix().transform_vector3(glam::Vec3::Y);
    assert!((turned([90.0, 0.0, 0.0]) - glam::Vec3::Z).length() < 1e-6);
    assert!((turned([90.0, 90.0, 0.0]) - glam::Vec3::X).length() < 1e-6);
    assert!((turned([90.0, 90.0, 90.0]) - glam::Vec3::Y).length() < 1e-6);
}

/// Every file with this ending under a folder of the project.
fn files(folder: &str, ending: &str) -> Vec<std::path::PathBuf> {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let found = std::fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path());
    found.filter(|path| path.extension().is_some_and(|e| e == ending)).collect()
}

#[test]
fn example_scenes_are_canonical_and_name_files_that_exist() {
    let scenes = files("graphs/scenes", "ron");
    assert!(scenes.len() >= 7);
    for path in scenes {
        let text = std::fs::read_to_string(&path).unwrap();
        let (scene, found) = read(&SourceText::new(path.display().to_string(), text.clone()));
        assert!(found.is_empty(), "{}: {found:?}", path.display());
        let scene = scene.unwrap();
        assert!(!scene.note.is_empty() && !scene.name.is_empty(), "{}", path.display());
        assert_eq!(write(&scene), text, "{}", path.display());
        let models = scene.objects.iter().filter_map(|o| match &o.shape {
            Shape::Obj(file) => Some(file),
            _ => None,
        });
        let graphs = scene.lights.iter().map(|l| &l.graph).chain(scene.objects.iter().map(|o| &o.surface));
        for file in models.chain(graphs) {
            assert!(path.with_file_name("").join(&file.path).is_file(), "{}: {}", path.display(), file.path);
        }
    }
}

#[test]
fn example_graphs_are_canonical() {
    for folder in ["graphs/lights", "graphs/surfaces", "graphs/lib"] {
        for path in files(folder, "ron") {
            let text = std::fs::read_to_string(&path).unwrap();
            let (graph, found) = crate::graph::read(&SourceText::new(path.display().to_string(), text.clone()));
            assert!(found.is_empty(), "{}: {found:?}", path.display());
            let graph = graph.unwrap();
            assert!(!graph.note.is_empty() && !graph.name.is_empty(), "{}", path.display());
            assert_eq!(crate::graph::write(&graph), text, "{}", path.display());
        }
    }
}

#[test]
fn example_models_are_sound() {
    let models = files("graphs/models", "obj");
    assert!(models.len() >= 4);
    for path in models {
        let text = std::fs::read_to_string(&path).unwrap();
        let mesh = from_obj(&SourceText::new(path.display().to_string(), text)).unwrap();
        assert!(mesh.normals.iter().all(|n| n.is_normalized()), "{}", path.display());
        assert!(mesh.tangents.iter().zip(&mesh.normals).all(|(t, n)| n.dot(t.truncate()).abs() < 1e-4));
        assert!(checks::volume(&mesh) > 0.0, "{} is inside out", path.display());
    }
}

proptest! {
    #[test]
    fn damaged_scenes_never_panic(at in 0..FULL.len(), with in "[-(){}\\[\\]:,\"a-zA-Z0-9.\\x00é ]{0,4}", cut in 0..40usize) {
        let mut text = FULL.to_string();
        text.replace_range(at..(at + cut).min(FULL.len()), &with);
        let (scene, found) = read(&SourceText::new("s.ron", text));
        if let (Some(scene), false) = (scene, has_errors(&found)) {
            let written = write(&scene);
            let (again, found) = read(&SourceText::new("s.ron", written.clone()));
            prop_assert!(!has_errors(&found), "{written}\n{found:?}");
            prop_assert_eq!(write(&again.unwrap()), written);
            for object in &scene.objects {
                let _ = object.transform.matrix();
                let _ = object.shape.mesh();
            }
        }
    }

    #[test]
    fn damaged_models_never_panic(text in "((v|vt|vn|f|o|#)( -?[0-9a-z/.]{0,5}){0,5}\n){0,20}") {
        let _ = from_obj(&SourceText::new("m.obj", text));
    }
}
