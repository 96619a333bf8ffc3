//! The real editor, driven by what assistive tools are told of it.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

use super::{Editor, Options, Places};
use crate::node::Catalog;
use crate::render::{AdapterChoice, AdapterOptions};

/// An editor in a window of its own, without a screen.
struct Bench {
    harness: Harness<'static, Editor>,
    folder: tempfile::TempDir,
}

impl Bench {
    fn new(files: &[&str]) -> Self {
        Self::within(tempfile::tempdir().expect("a folder"), files)
    }

    fn within(folder: tempfile::TempDir, files: &[&str]) -> Self {
        Self::started(folder, files, false)
    }

    fn started(folder: tempfile::TempDir, files: &[&str], paused: bool) -> Self {
        let places = Places::within(folder.path());
        let files: Vec<PathBuf> = files
            .iter()
            .map(|f| Path::new(env!("CARGO_MANIFEST_DIR")).join("graphs").join(f))
            .map(|from| {
                let to = folder.path().join(from.file_name().expect("a file"));
                std::fs::copy(&from, &to).expect("an example");
                to
            })
            .collect();
        let adapter = AdapterOptions { choice: AdapterChoice::Cpu, backends: None };
        let options = Options {
            files,
            scene: None,
            nodes: Vec::new(),
            catalog: Catalog::embedded(),
            adapter,
            places: Some(places),
            paused,
        };
        let harness = Harness::builder().with_size(vec2(1280.0, 800.0)).with_max_steps(30).build_eframe(move |cc| {
            let mut editor = Editor::new(&cc.egui_ctx, options);
            editor.settings.welcomed = true;
            if matches!(editor.dialog, Some(super::dialogs::Dialog::Welcome)) {
                editor.dialog = None;
            }
            editor
        });
        let mut bench = Self { harness, folder };
        bench.steps(4);
        bench
    }

    fn steps(&mut self, count: usize) {
        self.harness.run_steps(count);
    }

    /// Steps until something holds.
    fn until(&mut self, what: &str, done: impl Fn(&Editor) -> bool) {
        let start = Instant::now();
        while !done(self.harness.state()) {
            assert!(start.elapsed() < Duration::from_secs(60), "waited in vain for {what}");
            std::thread::sleep(Duration::from_millis(10));
            self.steps(1);
        }
    }

    fn key(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.steps(3);
    }

    fn key_sequence(&mut self, keys: &[(Modifiers, Key)]) {
        keys.iter().for_each(|(modifiers, key)| self.key(*modifiers, *key));
    }

    fn text(&mut self, text: &str) {
        self.harness.event(Event::Text(text.to_owned()));
        self.steps(3);
    }

    /// Picks the first of what a list offers for some words.
    fn pick(&mut self, words: &str) {
        self.steps(2);
        self.text(words);
        self.key(Modifiers::NONE, Key::Enter);
        self.steps(2);
    }

    fn place(&self, label: &str) -> Pos2 {
        self.harness.get_by_label(label).rect().center()
    }

    fn click(&mut self, at: Pos2) {
        self.press(at, true);
        self.press(at, false);
        self.steps(2);
    }

    fn press(&mut self, pos: Pos2, pressed: bool) {
        self.harness.event(Event::PointerMoved(pos));
        self.harness.event(Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        self.steps(1);
    }

    fn drag(&mut self, from: Pos2, to: Pos2) {
        self.press(from, true);
        for i in 1..=6_u8 {
            let p = from + (to - from) * f32::from(i) / 6.0;
            self.harness.event(Event::PointerMoved(p));
            self.steps(1);
        }
        self.press(to, false);
        self.steps(2);
    }

    fn document(&self) -> String {
        self.harness.state().document().expect("a document").text()
    }

    fn kind_of(&self, node: &str) -> String {
        let graph = self.harness.state().document().expect("a document").graph();
        graph.nodes.get(node).unwrap_or_else(|| panic!("no node {node} among {:?}", graph.nodes.keys())).kind.clone()
    }

    fn node_of_kind(&self, kind: &str) -> String {
        let graph = self.harness.state().document().expect("a document").graph();
        let found = graph.nodes.iter().find(|(_, n)| n.kind == kind).map(|(name, _)| name.clone());
        found.unwrap_or_else(|| {
            panic!("no {kind} among {:?}", graph.nodes.values().map(|n| &n.kind).collect::<Vec<_>>())
        })
    }

    /// Presses Z until there is nothing more to take back, or to do again.
    fn all_the_way(&mut self, modifiers: Modifiers, done: impl Fn(&crate::view::Document) -> bool) {
        for _ in 0..50 {
            if done(self.harness.state().document().expect("a document")) {
                return;
            }
            self.key(modifiers, Key::Z);
        }
        let editor = self.harness.state();
        let (undo, redo) = editor.document().map(|d| (d.undo_label(), d.redo_label())).expect("a document");
        let open = (editor.finder.is_some(), editor.dialog.is_some(), self.harness.ctx.text_edit_focused());
        panic!("no end: {undo:?} {redo:?} {open:?}");
    }

    fn picture(&mut self) -> Vec<u8> {
        self.until("a picture of what is there now", |e| e.feed.is_settled(&e.preview));
        self.harness.state().preview.image.as_ref().expect("a picture").rgba.clone()
    }

    fn canvas(&self, x: f32, y: f32) -> Pos2 {
        let rect = self.harness.state().canvas;
        rect.min + Vec2::new(x, y)
    }
}

const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

/// The names by which a link's ends are told.
fn output_of(node: &str) -> String {
    format!("{node} / output (whole node)")
}

#[test]
fn a_glass_under_a_shadowed_lamp_is_built_from_nothing_and_taken_back() {
    let mut bench = Bench::new(&[]);
    let empty = bench.document();
    let hole = bench.canvas(60.0, 60.0);
    bench.harness.hover_at(hole);
    bench.steps(1);
    bench.key(Modifiers::SHIFT, Key::A);
    bench.pick("spot light");
    let spot = bench.node_of_kind("spot_light");
    // A wire into the open offers what can take it.
    let unlit = bench.picture();
    let (from, to) = (bench.place(&output_of(&spot)), bench.canvas(420.0, 60.0));
    bench.drag(from, to);
    bench.pick("variance shadow");
    let shadow = bench.node_of_kind("variance_shadow");
    let (from, to) = (bench.place(&output_of(&shadow)), bench.canvas(40.0, 40.0));
    bench.drag(from, to);
    bench.pick("glass");
    let glass = bench.node_of_kind("glass");
    let links: Vec<String> =
        bench.harness.state().document().expect("a document").graph().links.iter().map(ToString::to_string).collect();
    assert_eq!(links, [format!("{shadow} -> {glass}"), format!("{spot} -> {shadow}")]);
    let glassy = bench.picture();
    assert!(bench.harness.state().feed.found.is_empty(), "{:?}", bench.harness.state().feed.found);
    assert!(glassy != unlit, "what was built is seen");
    // Its shadow alone.
    let light = bench.harness.state().preview.image.as_ref().expect("a picture").lights[0].clone();
    bench.harness.state_mut().preview.look = crate::preview::Look::Output(crate::compile::Output::Visibility(light));
    bench.steps(2);
    let picture = bench.picture();

    bench.key(CTRL_SHIFT, Key::L);
    bench.steps(2);
    // Another shadow in its place keeps the links, and shows.
    let at = bench.place(&format!("Node {shadow}, shadow"));
    bench.click(at);
    assert_eq!(bench.harness.state().tab().expect("a tab").only(), Some(shadow.as_str()), "a click selects");
    bench.key(Modifiers::SHIFT, Key::S);
    bench.pick("hard shadow");
    assert_eq!(bench.kind_of(&shadow), "hard_shadow");
    assert!(bench.picture() != picture, "another shadow looks otherwise");
    let built = bench.document();

    bench.all_the_way(CTRL, |d| d.undo_label().is_none());
    assert_eq!(bench.document(), empty);
    bench.all_the_way(CTRL_SHIFT, |d| d.redo_label().is_none());
    assert_eq!(bench.document(), built);

    // Saved, and opened again: the same bytes.
    let path = bench.folder.path().join("mine.ron");
    bench.key(CTRL, Key::S);
    bench.key(CTRL, Key::A);
    bench.text(&path.display().to_string());
    bench.key(Modifiers::NONE, Key::Enter);
    bench.steps(3);
    assert_eq!(std::fs::read_to_string(&path).expect("saved"), built);
    assert!(!bench.harness.state().document().expect("a document").is_changed());
    bench.key(CTRL, Key::W);
    bench.key(CTRL, Key::O);
    bench.key(CTRL, Key::A);
    bench.text(&path.display().to_string());
    bench.key(Modifiers::NONE, Key::Enter);
    bench.steps(3);
    assert_eq!(bench.document(), built);
}

#[test]
fn a_value_changes_the_picture_and_builds_no_pipeline() {
    let mut bench = Bench::new(&["surfaces/lambert.ron"]);
    let before = bench.picture();
    let built = bench.harness.state().preview.image.as_ref().expect("a picture").pipelines_built;
    let editor = bench.harness.state_mut();
    let node = editor.document().expect("a document").graph().nodes.keys().next().expect("a node").clone();
    let value = Some(crate::semantic::Value::Numbers(vec![0.9, 0.1, 0.1]));
    assert!(editor.change("Set", crate::graph::Edit::SetParam { node, param: "albedo".into(), value }));
    bench.steps(2);
    assert!(bench.picture() != before);
    assert_eq!(bench.harness.state().preview.image.as_ref().expect("a picture").pipelines_built, built);
}

#[test]
fn copies_paste_as_text_and_deleting_heals() {
    let mut bench = Bench::new(&["surfaces/marble.ron"]);
    let before = bench.document();
    let count = |b: &Bench| b.harness.state().document().expect("a document").graph().nodes.len();
    let nodes = count(&bench);
    bench.key(CTRL, Key::A);
    bench.harness.event(Event::Copy);
    bench.steps(2);
    let text = bench.harness.state().clipboard.clone();
    assert!(text.starts_with("Graph("), "{text}");
    bench.harness.event(Event::Paste(text));
    bench.steps(2);
    assert_eq!(count(&bench), 2 * nodes);
    bench.key(Modifiers::NONE, Key::Delete);
    assert_eq!(count(&bench), nodes, "what was pasted was selected");
    bench.harness.event(Event::Paste("no graph".into()));
    bench.steps(2);
    assert_eq!(count(&bench), nodes);
    bench.key(CTRL, Key::Z);
    bench.key(CTRL, Key::Z);
    assert_eq!(bench.document(), before);
}

#[test]
fn muting_renaming_and_collapsing_are_in_the_document() {
    let mut bench = Bench::new(&["surfaces/marble.ron"]);
    let before = bench.document();
    let node =
        bench.harness.state().document().expect("a document").graph().nodes.keys().next().expect("a node").clone();
    bench.harness.state_mut().go_to(&node);
    bench.steps(2);
    bench.key(Modifiers::NONE, Key::M);
    bench.key(Modifiers::NONE, Key::H);
    let graph = bench.harness.state().document().expect("a document").graph().clone();
    assert!(graph.nodes[&node].muted && graph.collapsed.contains(&node));
    bench.key(Modifiers::NONE, Key::F2);
    bench.key(CTRL, Key::A);
    bench.text("renamed");
    bench.key(Modifiers::NONE, Key::Enter);
    bench.steps(2);
    assert!(bench.harness.state().document().expect("a document").graph().nodes.contains_key("renamed"));
    for _ in 0..3 {
        bench.key(CTRL, Key::Z);
    }
    assert_eq!(bench.document(), before);
}

#[test]
fn nodes_become_a_file_of_their_own_and_it_opens() {
    let mut bench = Bench::new(&["surfaces/marble.ron"]);
    let picture = bench.picture();
    let graph = bench.harness.state().document().expect("a document").graph().clone();
    let output = graph.nodes.keys().find(|n| !graph.links.iter().any(|l| l.from.node == **n)).expect("an end").clone();
    bench.key(CTRL, Key::A);
    let editor = bench.harness.state_mut();
    editor.tab_mut().expect("a tab").selection.remove(&output);
    bench.key(CTRL_SHIFT, Key::G);
    bench.key(CTRL, Key::A);
    let path = bench.folder.path().join("part.ron");
    bench.text(&path.display().to_string());
    bench.key(Modifiers::NONE, Key::Enter);
    bench.steps(3);
    assert!(path.exists());
    assert_eq!(bench.harness.state().document().expect("a document").graph().nodes.len(), 2);
    let part = bench.picture();
    assert!(bench.harness.state().feed.found.is_empty(), "{:?}", bench.harness.state().feed.found);
    assert!(part == picture, "a file of its own changes no pixel");
    bench.key(Modifiers::NONE, Key::Enter);
    bench.steps(3);
    assert_eq!(bench.harness.state().tab().expect("a tab").path.as_deref(), Some(path.as_path()));
    bench.key(Modifiers::ALT, Key::ArrowUp);
    assert!(bench.harness.state().tab().expect("a tab").path.as_deref().is_some_and(|p| p.ends_with("marble.ron")));
}

#[test]
fn a_crash_loses_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path().to_path_buf();
    let mut bench = Bench::within(folder, &["surfaces/lambert.ron"]);
    bench.key(CTRL, Key::A);
    bench.key(CTRL, Key::D);
    let text = bench.document();
    bench.harness.state_mut().keep_unsaved();
    // As if the process had been killed: nothing is tidied up, and the lock goes with it.
    let Bench { harness, folder } = bench;
    let saved = std::fs::read_to_string(root.join("lambert.ron")).expect("the file");
    drop(harness);
    let mut bench = Bench::within(folder, &[]);
    bench.harness.get_by_label("Open them").click();
    bench.steps(4);
    assert_eq!(bench.document(), text);
    assert!(bench.harness.state().document().expect("a document").is_changed());
    assert_eq!(std::fs::read_to_string(root.join("lambert.ron")).expect("the file"), saved, "the file is not touched");
}

#[test]
fn a_file_that_others_change_is_noticed() {
    let mut bench = Bench::new(&["surfaces/lambert.ron"]);
    let path = bench.folder.path().join("lambert.ron");
    let theirs = std::fs::read_to_string(&path).expect("the file").replace("Graph(", "Graph( ");
    std::fs::write(&path, theirs.replace("lambert", "oren_nayar")).expect("written");
    bench.harness.state_mut().notice_changes();
    bench.steps(2);
    bench.node_of_kind("oren_nayar");
    // Where both changed, both stay.
    bench.key(CTRL, Key::A);
    bench.key(CTRL, Key::D);
    let mine = bench.document();
    std::fs::write(&path, theirs).expect("written");
    bench.harness.state_mut().notice_changes();
    bench.steps(2);
    bench.harness.get_by_label("Take theirs").click();
    bench.steps(3);
    bench.node_of_kind("lambert");
    let texts: Vec<usize> = bench.harness.state().tabs.iter().map(|t| t.graph().nodes.len()).collect();
    assert!(texts.len() == 2 && mine.matches("kind:").count() == texts[1].max(texts[0]), "{texts:?}");
}

#[test]
fn what_is_not_known_is_shown_and_kept() {
    let mut bench = Bench::new(&[]);
    let path = bench.folder.path().join("odd.ron");
    let text = "Graph(\n    version: 1,\n    nodes: {\n        \"a\": (kind: \"no_such_kind\", params: {\"x\": 3}),\n        \"b\": (kind: \"lambert\"),\n    },\n    links: [\n        \"a.y -> b.albedo\",\n    ],\n    future: (1, 2),\n)\n";
    std::fs::write(&path, text).expect("written");
    bench.harness.state_mut().open(&path);
    bench.steps(4);
    bench.harness.get_by_label_contains("Node a");
    assert_eq!(bench.document(), text);
    bench.until("problems", |e| !e.feed.found.is_empty());
    bench.harness.state_mut().show_problems();
    bench.steps(2);
    bench.harness.get_by_label_contains("Problems (");
}

/// Looking at a node is no change: no widget rounds or clamps what it shows.
#[test]
fn looking_changes_nothing() {
    for file in ["lights/spot_vsm.ron", "lights/sun_splits.ron", "surfaces/car_paint.ron", "surfaces/brick_wall.ron"] {
        let mut bench = Bench::new(&[file]);
        let names: Vec<String> =
            bench.harness.state().document().expect("a document").graph().nodes.keys().cloned().collect();
        for name in names {
            bench.harness.state_mut().go_to(&name);
            bench.steps(3);
        }
        assert!(!bench.harness.state().document().expect("a document").is_changed(), "{file}");
    }
}

/// What a command can change, in words.
fn state(bench: &Bench) -> Vec<String> {
    let editor = bench.harness.state();
    let tab = editor.tab().expect("a tab");
    vec![
        tab.document.text(),
        format!("{:?} {:?} {:?} {:?}", tab.selection, tab.link, tab.frame, tab.camera),
        format!("{:?} {}", editor.tabs.iter().map(|t| t.key().to_path_buf()).collect::<Vec<_>>(), editor.active),
        format!("{:?} {} {} {}", editor.settings, editor.thumbnails, editor.costs, editor.quits),
        format!("{:?} {}", editor.preview.look, editor.preview.paused),
        format!("{} {}", editor.dialog.is_some(), editor.finder.is_some()),
        format!("{:?}", editor.toasts.iter().map(|(text, _)| text).collect::<Vec<_>>()),
        format!("{:?}", bench.harness.ctx.memory(eframe::egui::Memory::focused)),
    ]
}

/// Every key of every command changes something, and what it does to a document can be taken back.
#[test]
fn every_key_does_something_that_can_be_taken_back() {
    use super::command::Command as C;
    for command in C::ALL {
        for key in command.keys() {
            // Over the canvas alone; elsewhere it walks through the widgets.
            if key.logical_key == Key::Tab && key.modifiers.is_none() {
                continue;
            }
            let mut bench = Bench::started(tempfile::tempdir().expect("a folder"), &["lights/spot_vsm.ron"], true);
            match command {
                C::SelectAll | C::New => {}
                C::Undo => bench.key_sequence(&[(CTRL, Key::A), (CTRL, Key::D)]),
                C::Redo => bench.key_sequence(&[(CTRL, Key::A), (CTRL, Key::D), (CTRL, Key::Z)]),
                C::NextTab => bench.key(CTRL, Key::N),
                C::Pin | C::Bend => {
                    let tab = bench.harness.state_mut().tab_mut().expect("a tab");
                    tab.link = tab.graph().links.first().map(|l| (l.from.clone(), l.to.clone()));
                }
                C::Leave => {
                    let tab = bench.harness.state_mut().tab_mut().expect("a tab");
                    tab.outer = Some((tab.key().to_path_buf(), "spot".into()));
                }
                C::AlignLeft | C::AlignTop | C::AlignCenterX | C::AlignCenterY | C::DistributeX | C::DistributeY => {
                    bench.key(CTRL, Key::A);
                }
                _ => bench.harness.state_mut().go_to("shadow"),
            }
            bench.harness.state_mut().tab_mut().expect("a tab").camera.center += vec2(300.0, 0.0);
            bench.steps(2);
            let before = state(&bench);
            bench.key(key.modifiers, key.logical_key);
            bench.steps(2);
            let after = state(&bench);
            assert!(before != after, "{command:?} by {key:?} does nothing: {after:?}");
            if matches!(command, C::Redo | C::Undo | C::New | C::NextTab | C::Close) {
                continue;
            }
            if before[0] != after[0] {
                bench.key(CTRL, Key::Z);
                assert_eq!(state(&bench)[0], before[0], "{command:?} is taken back");
            }
        }
    }
}

#[test]
fn what_is_far_away_is_still_picked() {
    let mut bench = Bench::new(&["surfaces/bumpy_glass.ron"]);
    let tab = bench.harness.state_mut().tab_mut().expect("a tab");
    tab.camera.zoom = 0.1;
    let camera = tab.camera;
    let link = tab.graph().links[0].clone();
    let (from, to) = (tab.cards.rect(tab.graph(), &link.from.node), tab.cards.rect(tab.graph(), &link.to.node));
    bench.steps(2);
    let middle = bench.harness.state().canvas.center();
    let screen = |p: Pos2| middle + (p - camera.center) * camera.zoom;
    bench.click(screen(from.center()));
    assert_eq!(bench.harness.state().tab().expect("a tab").only(), Some(&*link.from.node));
    let (begin, end) = (from.right_top() + vec2(0.0, 13.0), to.left_top() + vec2(0.0, 13.0));
    bench.click(screen(begin + (end - begin) * 0.5));
    let tab = bench.harness.state().tab().expect("a tab");
    assert_eq!(tab.link, Some((link.from, link.to)));
    assert!(tab.selection.is_empty());
    // A box around all of them.
    let all = tab.cards.bounds(tab.graph()).expect("nodes").expand(200.0);
    let count = tab.graph().nodes.len();
    bench.drag(screen(all.min), screen(all.max));
    assert_eq!(bench.harness.state().tab().expect("a tab").selection.len(), count);
}

#[test]
fn the_fonts_have_every_sign_that_the_window_shows() {
    let ctx = eframe::egui::Context::default();
    ctx.run_ui(eframe::egui::RawInput::default(), |_| {}).textures_delta.clear();
    // Which sign stands for those that are missing is known by one that no font has.
    let shape = |sign: char| {
        let font = eframe::egui::FontId::proportional(12.0);
        let galley = ctx.fonts_mut(|f| f.layout_no_wrap(sign.into(), font, eframe::egui::Color32::WHITE));
        galley.rows[0].glyphs[0].uv_rect
    };
    let none = shape('\u{e000}');
    assert_ne!(shape('a'), none);
    let mut open = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src/gui")];
    let mut missing = Vec::new();
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(std::fs::read_dir(&path).expect("a folder").map(|f| f.expect("a file").path()));
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("a source");
        missing.extend(text.chars().filter(|c| !c.is_ascii() && shape(*c) == none).map(|c| (path.clone(), c)));
    }
    assert!(missing.is_empty(), "{missing:?}");
}
