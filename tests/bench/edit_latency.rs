//! From an edit to its picture, without the time that the picture itself takes: `cargo run --release --example edit_latency`.

#![allow(clippy::print_stdout, missing_docs, reason = "an example that prints a table")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::Instant;

use shadetree::compile::Output;
use shadetree::preview::{Answer, Engine, Image, Look, Request, Show, Shown};
use shadetree::render::AdapterOptions;

/// What is shown, the document that is edited, and texts in it that are replaced: a value, and what is structure.
type Case = (&'static str, &'static str, &'static str, [[&'static str; 2]; 2]);

const CASES: [Case; 5] = [
    (
        "stage",
        "surfaces/lambert.ron",
        "lights/spot_pcf.ron",
        [["\"intensity\": 90", "\"intensity\": 91"], ["pcf_shadow", "variance_shadow"]],
    ),
    (
        "stage",
        "surfaces/brick_wall.ron",
        "surfaces/brick_wall.ron",
        [["\"roughness\": 0.5", "\"roughness\": 0.6"], ["oren_nayar\", params: {\"roughness\": 0.5}", "lambert\""]],
    ),
    (
        "stage",
        "surfaces/bumpy_glass.ron",
        "surfaces/bumpy_glass.ron",
        [["\"amplitude\": ", "\"amplitude\": 1"], ["\"octaves\": \"3\"", "\"octaves\": \"4\""]],
    ),
    (
        "scene",
        "scenes/car.ron",
        "lights/spot_soft.ron",
        [["\"intensity\": 90", "\"intensity\": 91"], ["variance_shadow", "moment_shadow"]],
    ),
    (
        "scene",
        "scenes/three_lights.ron",
        "lights/sun_pcf.ron",
        [["\"intensity\": 3", "\"intensity\": 4"], ["pcf_shadow", "variance_shadow"]],
    ),
];

fn main() {
    let (send, bell) = channel();
    let send = std::sync::Mutex::new(send);
    let wake = move || drop(send.lock().map(|s| s.send(())));
    let options = AdapterOptions { backends: std::env::var("WGPU_BACKEND").ok(), ..AdapterOptions::default() };
    let engine = Engine::start(options, Arc::new(wake));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("graphs");
    println!("{:<28} {:<12} {:>10} {:>10} {:>10} {:>6}", "shown", "edit", "compile", "to picture", "frame", "built");
    let mut revision = 0;
    for (sort, shown, edited, [[value, other], [structure, another]]) in CASES {
        let file = root.join(edited);
        let Ok(text) = std::fs::read_to_string(&file) else { continue };
        for changed in [value, structure] {
            assert!(text.contains(changed), "{edited} has no `{changed}`");
        }
        let (value, structure) = (text.replace(value, other), text.replace(structure, another));
        let mut built = 0;
        for (name, text) in [("open", text), ("value", value), ("structure", structure)] {
            revision += 1;
            let show = match sort {
                "scene" => Show::Scene(root.join(shown)),
                _ if edited.starts_with("lights") => {
                    Show::Stage { shape: Shown::Sphere, graphs: vec![file.clone(), root.join(shown)] }
                }
                _ => Show::Stage { shape: Shown::Sphere, graphs: vec![root.join(shown)] },
            };
            let overlay: BTreeMap<PathBuf, Arc<str>> = BTreeMap::from([(file.clone(), text.into())]);
            let look = Look::Output(Output::Radiance);
            let request = Request {
                environment: None,
                revision,
                overlay,
                show,
                look,
                camera: None,
                size: (640, 360),
                samples: 4,
                time: 0.0,
                nodes: Vec::new(),
            };
            let begun = Instant::now();
            engine.ask(request);
            let Some((compile, image)) = wait(&engine, &bell, revision) else { continue };
            let all = begun.elapsed().as_secs_f64() * 1e3;
            let frame: f64 = image.timings.iter().filter_map(|t| t.milliseconds).sum();
            println!(
                "{shown:<28} {name:<12} {compile:>7.1} ms {:>7.1} ms {frame:>7.1} ms {:>6}",
                all - frame,
                image.pipelines_built - built
            );
            built = image.pipelines_built;
        }
    }
}

/// How long the shaders took, and the picture.
fn wait(engine: &Engine, bell: &Receiver<()>, revision: u64) -> Option<(f64, Image)> {
    let mut compile = 0.0;
    loop {
        bell.recv().ok()?;
        for answer in engine.answers() {
            match answer {
                Answer::Shaders(s) if s.revision == revision => {
                    compile = s.milliseconds;
                    if s.shaders.is_empty() {
                        println!("{:?}", s.diagnostics.first().map(|d| &d.message));
                        return None;
                    }
                }
                Answer::Image(image) if image.revision == revision => return Some((compile, image)),
                Answer::Failed { message, .. } => {
                    println!("{message}");
                    return None;
                }
                _ => {}
            }
        }
    }
}
