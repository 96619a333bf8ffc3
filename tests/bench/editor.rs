//! How long the editor's window works on a frame: at rest, while it is panned, and while a node is dragged.
//!
//! `cargo bench --bench editor` prints it. Drawing on the screen is not in it; turning shapes into triangles is.
#![allow(missing_docs, reason = "a benchmark has no readers")]
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::fmt::Write as _;
use std::time::Instant;

use eframe::egui::{self, Event, Modifiers, PointerButton, Pos2, pos2, vec2};
use egui_kittest::Harness;
use shadetree::gui::{Editor, Options};
use shadetree::node::Catalog;

/// As in the program.
#[cfg(feature = "mimalloc")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// A graph of so many nodes, in rows.
fn text(count: usize) -> String {
    let (mut nodes, mut links, mut layout) = (String::new(), String::new(), String::new());
    for i in 0..count {
        let kind = ["multiply", "add", "sine", "smooth_step", "maximum"][i % 5];
        let _ = writeln!(nodes, "\"n{i}\": (kind: \"{kind}\"),");
        let _ = writeln!(layout, "\"n{i}\": ({}, {}),", i % 50 * 260, i / 50 * 220);
        if i > 0 {
            let _ = writeln!(links, "\"n{} -> n{i}\",", i - 1);
        }
    }
    format!("Graph(version: 1, nodes: {{\n{nodes}}}, links: [\n{links}], layout: {{\n{layout}}})")
}

/// One frame with its triangles, in milliseconds.
fn frame(harness: &mut Harness<'_, Editor>) -> f64 {
    let start = Instant::now();
    harness.step();
    let output = harness.output();
    let triangles = harness.ctx.tessellate(output.shapes.clone(), output.pixels_per_point);
    std::hint::black_box(triangles.len());
    start.elapsed().as_secs_f64() * 1e3
}

fn told(name: &str, count: usize, mut times: Vec<f64>) {
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize];
    println!("{count:>6} nodes  {name:<26} median {:>7.2} ms   99th of 100 {:>7.2} ms", at(0.5), at(0.99));
}

fn main() {
    let folder = tempfile::tempdir().expect("a folder");
    for count in [100, 1_000, 5_000] {
        let path = folder.path().join(format!("{count}.ron"));
        std::fs::write(&path, text(count)).expect("written");
        let options = Options { files: vec![path], catalog: Catalog::embedded(), paused: true, ..Options::default() };
        let mut harness =
            Harness::builder().with_size(vec2(1920.0, 1080.0)).build_eframe(|cc| Editor::new(&cc.egui_ctx, options));
        let opened = Instant::now();
        harness.step();
        println!("{count:>6} nodes  opened in {:.1} ms", opened.elapsed().as_secs_f64() * 1e3);
        for _ in 0..10 {
            harness.step();
        }
        let middle = pos2(800.0, 400.0);
        told("all in view, at rest", count, (0..100).map(|_| frame(&mut harness)).collect());
        told("all in view, panned", count, panned(&mut harness, middle));
        zoom(&mut harness, middle, 8);
        told("titles, panned", count, panned(&mut harness, middle));
        zoom(&mut harness, middle, 32);
        told("near, panned", count, panned(&mut harness, middle));
        harness.key_press_modifiers(Modifiers::COMMAND, egui::Key::A);
        harness.step();
        let nudge = |harness: &mut Harness<'_, Editor>| {
            harness.key_press_modifiers(Modifiers::COMMAND, egui::Key::ArrowRight);
            frame(harness)
        };
        told("all nodes moved by keys", count, (0..40).map(|_| nudge(&mut harness)).collect());
    }
}

/// Turns the wheel towards a place, a quarter nearer a step.
fn zoom(harness: &mut Harness<'_, Editor>, at: Pos2, steps: usize) {
    for _ in 0..steps {
        harness.event(Event::PointerMoved(at));
        let (unit, phase) = (egui::MouseWheelUnit::Point, egui::TouchPhase::Move);
        harness.event(Event::MouseWheel { unit, delta: vec2(0.0, 60.0), modifiers: Modifiers::NONE, phase });
        harness.step();
    }
    harness.run_steps(20);
}

/// Frames while the middle button drags the canvas.
fn panned(harness: &mut Harness<'_, Editor>, from: Pos2) -> Vec<f64> {
    let button =
        |pos, pressed| Event::PointerButton { pos, button: PointerButton::Middle, pressed, modifiers: Modifiers::NONE };
    harness.event(Event::PointerMoved(from));
    harness.event(button(from, true));
    harness.step();
    let mut times = Vec::new();
    let mut at = from;
    for i in 0..100_u8 {
        at += vec2(if i % 20 < 10 { 9.0 } else { -9.0 }, if i % 8 < 4 { 5.0 } else { -5.0 });
        harness.event(Event::PointerMoved(at));
        times.push(frame(harness));
    }
    harness.event(button(at, false));
    harness.step();
    times
}
