//! The engine on whatever adapter there is, with documents that are nowhere saved.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex};
use std::time::{Duration, Instant};

use super::{Answer, Engine, Image, Look, Request, Shaders, Show, Shown};
use crate::compile::Output;
use crate::render::{AdapterOptions, RenderError, adapters};
use crate::scene::{Environment, FileReference};

/// How long an answer may take on a slow machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// An engine with a bell, or none with a note where the machine has no adapter.
struct Desk {
    engine: Engine,
    bell: Arc<(Mutex<bool>, Condvar)>,
}

impl Desk {
    fn open() -> Option<Self> {
        let options = AdapterOptions { backends: std::env::var("WGPU_BACKEND").ok(), ..AdapterOptions::default() };
        if !adapters(&options).is_ok_and(|found| !found.is_empty()) {
            use std::io::Write;
            let error = RenderError::NoAdapter { wanted: None, found: Vec::new() };
            let _ = writeln!(std::io::stderr(), "SKIPPED, {error}");
            return None;
        }
        let bell = Arc::new((Mutex::new(false), Condvar::new()));
        let ring = bell.clone();
        let wake = move || {
            *ring.0.lock().expect("no panic") = true;
            ring.1.notify_all();
        };
        Some(Self { engine: Engine::start(options, Arc::new(wake)), bell })
    }

    /// Answers until one is as wanted, that one last.
    fn until(&self, wanted: impl Fn(&Answer) -> bool) -> Vec<Answer> {
        let begun = Instant::now();
        let mut all = Vec::new();
        loop {
            for answer in self.engine.answers() {
                let done = wanted(&answer);
                all.push(answer);
                if done {
                    return all;
                }
            }
            let left = PATIENCE.checked_sub(begun.elapsed()).unwrap_or_else(|| panic!("no answer: {all:?}"));
            let rung = self.bell.0.lock().expect("no panic");
            let (mut rung, _) = self.bell.1.wait_timeout_while(rung, left, |rung| !*rung).expect("no panic");
            *rung = false;
        }
    }

    /// The picture of a request.
    fn image(&self, request: &Request) -> Image {
        self.engine.ask(request.clone());
        let end = |a: &Answer| match a {
            Answer::Image(image) => image.revision == request.revision,
            Answer::Failed { .. } => true,
            Answer::Shaders(s) => s.revision == request.revision && s.shaders.is_empty(),
            _ => false,
        };
        match self.until(end).pop() {
            Some(Answer::Image(image)) => image,
            other => panic!("{other:?}"),
        }
    }

    fn shaders(&self, request: &Request) -> Shaders {
        self.engine.ask(request.clone());
        match self.until(|a| matches!(a, Answer::Shaders(s) if s.revision == request.revision)).pop() {
            Some(Answer::Shaders(shaders)) => shaders,
            other => panic!("{other:?}"),
        }
    }
}

fn matte(albedo: &str) -> String {
    format!(
        "Graph(version: 1, nodes: {{\"tone\": (kind: \"color\", params: {{\"color\": {albedo}}}), \"matte\": (kind: \
         \"lambert\")}}, links: [\"tone -> matte.albedo\"])"
    )
}

/// Small, on the stage, from a document that is nowhere saved.
fn request(revision: u64, text: &str) -> Request {
    let path = PathBuf::from("unsaved/matte.ron");
    Request {
        environment: None,
        revision,
        overlay: BTreeMap::from([(path.clone(), text.into())]),
        show: Show::Stage { shape: Shown::Sphere, graphs: vec![path] },
        look: Look::Output(Output::Radiance),
        camera: None,
        size: (32, 24),
        samples: 1,
        time: 0.0,
        nodes: Vec::new(),
    }
}

fn middle(image: &Image) -> &[u8] {
    let (width, height) = image.size;
    let at = 4 * (height / 2 * width + width / 2) as usize;
    &image.rgba[at..at + 4]
}

#[test]
fn everything_may_go_to_another_thread() {
    fn sends<T: Send>() {}
    sends::<Engine>();
    sends::<Request>();
    sends::<Answer>();
}

#[test]
fn a_value_builds_no_pipeline_and_a_camera_does_not_compile() {
    let Some(desk) = Desk::open() else { return };
    let first = desk.image(&request(1, &matte("(0.8, 0.1, 0.1)")));
    let second = desk.image(&request(2, &matte("(0.1, 0.8, 0.1)")));
    assert!(first.pipelines_built > 0);
    assert_eq!(first.pipelines_built, second.pipelines_built);
    assert!(middle(&first)[0] > middle(&first)[1] && middle(&second)[1] > middle(&second)[0]);
    assert_eq!(first.rgba.len(), 4 * 32 * 24);
    assert!(!first.lights.is_empty(), "the stage has a lamp");

    let mut moved = request(3, &matte("(0.1, 0.8, 0.1)"));
    moved.camera = Some(crate::scene::Camera { fov_y: first.camera.fov_y * 2.0, ..first.camera });
    desk.engine.ask(moved.clone());
    let answers = desk.until(|a| matches!(a, Answer::Image(i) if i.revision == 3));
    let compiled = answers.iter().find_map(|a| match a {
        Answer::Shaders(s) if s.revision == 3 => Some(s.milliseconds),
        _ => None,
    });
    assert_eq!(compiled, Some(0.0));
    let Some(Answer::Image(third)) = answers.last() else { panic!("{answers:?}") };
    assert_eq!((third.pipelines_built, Some(third.camera)), (first.pipelines_built, moved.camera));
}

#[test]
fn the_newest_request_wins() {
    let Some(desk) = Desk::open() else { return };
    for revision in 1..=40 {
        desk.engine.ask(request(revision, &matte(&format!("(0.{revision:02}, 0.5, 0.5)"))));
    }
    let answers = desk.until(|a| matches!(a, Answer::Image(i) if i.revision == 40));
    let compiled = answers.iter().filter(|a| matches!(a, Answer::Shaders(_))).count();
    assert!(compiled < 40, "requests that were not begun are replaced");
    let revisions: Vec<u64> = answers
        .iter()
        .filter_map(|a| match a {
            Answer::Image(i) => Some(i.revision),
            _ => None,
        })
        .collect();
    assert!(revisions.is_sorted(), "{revisions:?}");
}

#[test]
fn a_broken_graph_keeps_its_picture_and_recovers() {
    let Some(desk) = Desk::open() else { return };
    desk.image(&request(1, &matte("0.5")));
    let broken = request(2, &matte("0.5").replace("lambert", "lambart"));
    let shaders = desk.shaders(&broken);
    assert!(shaders.shaders.is_empty());
    assert!(shaders.diagnostics.iter().any(|d| d.help.as_deref().is_some_and(|h| h.contains("lambert"))));
    // The last good shaders are seen from elsewhere.
    let moved = Request { revision: 3, size: (16, 16), ..broken };
    desk.engine.ask(moved);
    let answers = desk.until(|a| matches!(a, Answer::Image(_)));
    assert!(matches!(answers.last(), Some(Answer::Image(i)) if i.revision == 3 && i.size == (16, 16)));
    let good = desk.image(&request(4, &matte("0.6")));
    assert_eq!(good.revision, 4);
}

#[test]
fn wires_are_told_from_light_to_surface() {
    let Some(desk) = Desk::open() else { return };
    let text = "Graph(version: 1, nodes: {\"spot\": (kind: \"spot_light\"), \"shade\": (kind: \"pcf_shadow\"), \"matte\": \
                (kind: \"lambert\")}, links: [\"spot -> shade\", \"shade -> matte\"])";
    let shaders = desk.shaders(&request(1, text));
    assert!(shaders.diagnostics.is_empty(), "{:?}", shaders.diagnostics);
    let wires: Vec<(&str, &str)> = shaders.wiring.iter().map(|w| (w.from.0.as_str(), w.to.0.as_str())).collect();
    assert!(wires.contains(&("spot", "shade")) && wires.contains(&("shade", "matte")), "{wires:?}");
    assert!(shaders.wiring.iter().all(|w| w.graph.contains("unsaved")), "{:?}", shaders.wiring);
}

#[test]
fn one_node_can_be_looked_at() {
    let Some(desk) = Desk::open() else { return };
    // The surface is broken; the colour that feeds it can be seen all the same.
    let text = matte("(1.0, 0.0, 0.0)").replace("lambert", "lambart");
    let look = Look::Node { graph: PathBuf::from("unsaved/matte.ron"), node: "tone".into(), port: None };
    let asked = Request { look, ..request(1, &text) };
    assert_eq!(middle(&desk.image(&asked)), [255, 0, 0, 255], "the value itself, without tone mapping");
    desk.engine.thumbnail(Request { revision: 2, size: (8, 8), ..asked });
    let answers = desk.until(|a| matches!(a, Answer::Thumbnail { .. }));
    let Some(Answer::Thumbnail { node, image }) = answers.last() else { panic!("{answers:?}") };
    assert_eq!((node.as_str(), image.size, middle(image)), ("tone", (8, 8), &[255, 0, 0, 255][..]));
}

#[test]
fn every_shape_stands_on_the_stage() {
    let Some(desk) = Desk::open() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("large.obj");
    std::fs::write(&model, "v -900 0 0\nv 900 0 0\nv 0 1800 0\nv 0 0 400\nf 1 2 3\nf 1 4 3\nf 2 3 4\n")
        .expect("written");
    let shapes = [Shown::Sphere, Shown::Cube, Shown::Plane, Shown::Cylinder, Shown::Torus, Shown::Obj(model)];
    for (revision, shape) in (1..).zip(shapes) {
        let mut asked = request(revision, &matte("(1.0, 0.0, 0.0)"));
        let Show::Stage { shape: shown, .. } = &mut asked.show else { panic!("a stage") };
        *shown = shape.clone();
        let image = desk.image(&asked);
        let red = image.rgba.chunks(4).filter(|p| u32::from(p[0]) > 2 * u32::from(p[1]).max(1)).count();
        assert!((40..600).contains(&red), "{shape:?}: {red} pixels of 768");
    }
}

#[test]
fn a_scene_shows_graphs_as_they_are_edited() {
    let Some(desk) = Desk::open() else { return };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("graphs");
    let light = root.join("lights/spot_pcf.ron");
    let scene = format!(
        "Scene(version: 1, camera: (position: (0, 1, 4)), lights: {{\"lamp\": (graph: {:?})}}, objects: {{\"ball\": (shape: \
         Sphere(radius: 1), surface: \"matte.ron\")}})",
        light.display().to_string()
    );
    let asked = |revision, albedo: &str| {
        let scene_file = PathBuf::from("unsaved/scene.ron");
        let mut asked = request(revision, &matte(albedo));
        asked.overlay.insert(scene_file.clone(), scene.as_str().into());
        Request { show: Show::Scene(scene_file), look: Look::Output(Output::Radiance), ..asked }
    };
    let first = desk.image(&asked(1, "(0.8, 0.8, 0.8)"));
    let second = desk.image(&asked(2, "(0.2, 0.2, 0.2)"));
    let sum = |i: &Image| i.rgba.chunks(4).map(|p| u32::from(p[0])).sum::<u32>();
    assert!(sum(&first) > sum(&second) && sum(&second) > 0, "{} {}", sum(&first), sum(&second));
    assert_eq!(first.pipelines_built, second.pipelines_built);

    let bright = Request { environment: Some(Environment::Color([0.6; 3])), ..asked(5, "(0.2, 0.2, 0.2)") };
    assert!(sum(&desk.image(&bright)) > sum(&second), "what lies around lights");
    let missing = FileReference::new("nowhere.hdr");
    let gone = Environment::Image { image: missing, rotation: 0.0, intensity: 1.0 };
    desk.engine.ask(Request { environment: Some(gone), ..asked(6, "0.5") });
    let answers = desk.until(|a| matches!(a, Answer::Failed { .. } | Answer::Image(Image { revision: 6, .. })));
    let told = |a: &Answer| matches!(a, Answer::Failed { message, .. } if message.contains("nowhere.hdr"));
    assert!(answers.last().is_some_and(told), "{answers:?}");

    let error = desk.image(&Request { look: Look::Error { light: first.lights[0].clone() }, ..asked(3, "0.5") });
    assert!(error.number.as_ref().is_some_and(|(name, x)| name == "RMSE" && *x < 0.3), "{:?}", error.number);
    let map = desk.image(&Request { look: Look::Map { light: first.lights[0].clone(), index: 0 }, ..asked(4, "0.5") });
    assert!(map.size.0 == map.size.1 && map.rgba.len() == 4 * (map.size.0 * map.size.1) as usize);
}

#[test]
fn a_lost_device_is_opened_again() {
    let Some(desk) = Desk::open() else { return };
    let first = desk.image(&request(1, &matte("0.5")));
    desk.engine.lose();
    let second = desk.image(&request(2, &matte("0.5")));
    assert_eq!(first.rgba, second.rgba);
}

#[test]
fn a_measurement_comes_point_by_point_and_can_be_called_off() {
    let Some(desk) = Desk::open() else { return };
    let text = "Graph(version: 1, nodes: {\"spot\": (kind: \"spot_light\"), \"shade\": (kind: \"pcf_shadow\"), \"matte\": \
                (kind: \"lambert\")}, links: [\"spot -> shade\", \"shade -> matte\"])";
    let asked = Request { size: (16, 12), ..request(1, text) };
    desk.engine.measure(asked, "spot".into());
    let answers = desk.until(|a| matches!(a, Answer::Point(_) | Answer::Failed { .. }));
    assert!(matches!(answers.last(), Some(Answer::Point(p)) if p.rmse.is_finite()), "{answers:?}");
    desk.engine.cancel();
    desk.until(|a| matches!(a, Answer::Measured));
}

/// A node that works for a long time. One that never ends cannot be tested: nothing can stop its thread, so that the tests
/// would keep a processor busy to their end.
#[test]
fn a_picture_that_takes_too_long_is_left_behind() {
    let Some(mut desk) = Desk::open() else { return };
    let slow = "Graph(version: 1, nodes: {\"slow\": (kind: \"custom\", wgsl: r#\"//! label: Slow
//! category: procedural
//! Counts.

/// start (scalar; = 1): From where.
/// texcoord (texcoord; = @texcoord): Where.
/// -> value (scalar): What comes of it.
fn slow(start: f32, texcoord: vec2f) -> f32 {
    var x = start + texcoord.x;
    for (var i = 0u; i < 20000000u; i++) {
        x = fract(x * 1.37 + 0.11);
    }
    return x;
}
\"#)})";
    desk.engine.ask(request(1, slow));
    let begun = Instant::now();
    while desk.engine.busy().is_none_or(|busy| busy < Duration::from_millis(100)) {
        assert!(begun.elapsed() < PATIENCE, "{:?}", desk.engine.answers());
        let early = desk.engine.answers().into_iter().any(|a| matches!(a, Answer::Image(_)));
        assert!(!early, "the picture was to take long");
        std::thread::sleep(Duration::from_millis(5));
    }
    desk.engine.abandon();
    assert!(desk.engine.busy().is_none());
    let after = desk.image(&request(2, &matte("0.5")));
    assert_eq!(after.revision, 2);
}
