//! What the engine is asked, and what came of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use eframe::egui;

use super::preview::Preview;
use super::tab::Tab;
use crate::diagnostic::Diagnostic;
use crate::preview::{Answer, Cost, Engine, Look, Point, Request, Resolved, ShaderText, Show};

/// What links came to, by the nodes at their ends.
pub(super) type Wiring = BTreeMap<(String, String), Vec<Resolved>>;

/// What the engine said last.
pub(super) struct Feed {
    pub(super) engine: Engine,
    asked: Option<String>,
    /// What the graph that is shown goes by in source maps.
    stem: String,
    revision: u64,
    pub(super) shaders: Vec<ShaderText>,
    pub(super) found: Vec<Diagnostic>,
    /// By the graph's name, then by the nodes at the ends of links.
    wiring: BTreeMap<String, Wiring>,
    pub(super) costs: BTreeMap<String, (f32, String)>,
    /// Time from a change to its shaders, milliseconds.
    pub(super) compile_ms: f64,
    pub(super) points: Vec<Point>,
    pub(super) measuring: bool,
    pub(super) thumbnails: BTreeMap<String, egui::TextureHandle>,
    thumbnails_for: BTreeMap<String, String>,
    asked_at: Option<Instant>,
    /// Time from a change to its picture, milliseconds.
    pub(super) latency_ms: f64,
    /// Pictures taken so far.
    pub(super) pictures: u64,
}

/// Side of a picture on a node, pixels.
const SMALL: u32 = 112;

impl Feed {
    pub(super) fn new(engine: Engine) -> Self {
        Self {
            engine,
            asked: None,
            stem: String::new(),
            revision: 0,
            shaders: Vec::new(),
            found: Vec::new(),
            wiring: BTreeMap::new(),
            costs: BTreeMap::new(),
            compile_ms: 0.0,
            points: Vec::new(),
            measuring: false,
            thumbnails: BTreeMap::new(),
            thumbnails_for: BTreeMap::new(),
            asked_at: None,
            latency_ms: 0.0,
            pictures: 0,
        }
    }

    /// Takes the answers that are there. Answers what is to be said to the person.
    pub(super) fn poll(&mut self, ctx: &egui::Context, preview: &mut Preview) -> Vec<String> {
        let mut said = Vec::new();
        for answer in self.engine.answers() {
            match answer {
                Answer::Shaders(shaders) if shaders.revision == self.revision => {
                    self.found = shaders.diagnostics;
                    self.compile_ms = shaders.milliseconds;
                    // A broken graph leaves the last good text and wiring.
                    if !shaders.shaders.is_empty() {
                        self.shaders = shaders.shaders;
                        self.wiring = by_graph(shaders.wiring);
                        self.costs = costs(&shaders.cost, &self.stem);
                    }
                }
                Answer::Shaders(_) => {}
                Answer::Image(image) => {
                    if image.revision == self.revision
                        && let Some(asked) = self.asked_at.take()
                    {
                        self.latency_ms = asked.elapsed().as_secs_f64() * 1e3;
                    }
                    said.extend(image.messages.iter().cloned());
                    self.pictures += 1;
                    preview.take(ctx, image);
                }
                Answer::Failed { message, help, .. } => preview.failure = Some((message, help)),
                Answer::Thumbnail { node, image } => {
                    let size = [image.size.0 as usize, image.size.1 as usize];
                    if image.rgba.len() == size[0] * size[1] * 4 {
                        let pixels = egui::ColorImage::from_rgba_unmultiplied(size, &image.rgba);
                        let texture =
                            ctx.load_texture(format!("thumbnail {node}"), pixels, egui::TextureOptions::LINEAR);
                        self.thumbnails.insert(node, texture);
                    }
                }
                Answer::Point(point) => self.points.push(point),
                Answer::Figure { path, failure: None } => said.push(format!("wrote {}", path.display())),
                Answer::Figure { path, failure: Some(why) } => {
                    said.push(format!("{} not written: {why}", path.display()))
                }
                Answer::Measured => self.measuring = false,
            }
        }
        said
    }

    /// Asks for a picture if anything is not as it was when the last one was asked for.
    pub(super) fn ask(&mut self, tabs: &[Tab], shown: Option<&Tab>, preview: &Preview, nodes: &[PathBuf]) {
        let Some(shown) = shown else { return };
        let state: Vec<String> = tabs
            .iter()
            .map(|t| {
                format!("{} {} {}", t.key().display(), t.document.structure_revision(), t.document.value_revision())
            })
            .collect();
        let show = preview.show_what(shown.key().to_path_buf());
        let key = format!(
            "{state:?} {show:?} {:?} {:?} {:?} {:?} {} {}",
            preview.look, preview.around, preview.camera, preview.size, preview.samples, preview.time
        );
        if self.asked.as_ref() == Some(&key) {
            return;
        }
        self.asked = Some(key);
        self.stem = stem(shown.key());
        self.revision += 1;
        self.asked_at = Some(Instant::now());
        self.engine.ask(self.request(tabs, show, preview.look.clone(), preview, nodes));
    }

    /// Whether the newest picture that was asked for is there, or cannot be.
    #[cfg(test)]
    pub(super) fn is_settled(&self, preview: &Preview) -> bool {
        self.asked.is_some()
            && self.engine.busy().is_none()
            && (preview.failure.is_some() || preview.image.as_ref().is_some_and(|i| i.revision == self.revision))
    }

    /// Asks again for what was asked last.
    pub(super) fn again(&mut self) {
        self.asked = None;
    }

    fn request(&self, tabs: &[Tab], show: Show, look: Look, preview: &Preview, nodes: &[PathBuf]) -> Request {
        let overlay = tabs.iter().map(|t| (t.key().to_path_buf(), Arc::from(t.document.text()))).collect();
        Request {
            revision: self.revision,
            overlay,
            show,
            look,
            camera: preview.camera,
            environment: preview.around.clone().map(|(_, environment)| environment),
            size: preview.size,
            samples: preview.samples,
            time: preview.time,
            nodes: nodes.to_vec(),
        }
    }

    /// Asks for pictures of nodes that have none as they are now. A few at a time, so that newer wishes are not far behind.
    pub(super) fn ask_thumbnails(
        &mut self,
        tab: &Tab,
        tabs: &[Tab],
        preview: &Preview,
        nodes: &[PathBuf],
        seen: &[String],
    ) {
        let state =
            format!("{} {} {}", tab.key().display(), tab.document.structure_revision(), tab.document.value_revision());
        let stale: Vec<String> =
            seen.iter().filter(|n| self.thumbnails_for.get(*n) != Some(&state)).take(4).cloned().collect();
        for node in stale {
            self.thumbnails_for.insert(node.clone(), state.clone());
            let look = Look::Node { graph: tab.key().to_path_buf(), node, port: None };
            let mut request = self.request(
                tabs,
                Show::Stage { shape: crate::studio::Shown::Sphere, graphs: vec![tab.key().to_path_buf()] },
                look,
                preview,
                nodes,
            );
            (request.size, request.camera, request.samples) = ((SMALL, SMALL), None, 1);
            self.engine.thumbnail(request);
        }
    }

    /// Measures every kind of shadow on a light.
    pub(super) fn measure(&mut self, tabs: &[Tab], shown: &Tab, preview: &Preview, nodes: &[PathBuf], light: String) {
        self.points.clear();
        self.measuring = true;
        let show = preview.show_what(shown.key().to_path_buf());
        let mut request = self.request(tabs, show, Look::Output(crate::compile::Output::Radiance), preview, nodes);
        request.size = (256, 160);
        self.engine.measure(request, light);
    }

    /// What links of a graph came to.
    pub(super) fn wiring_of(&self, key: &Path) -> &Wiring {
        static NONE: Wiring = BTreeMap::new();
        self.wiring.get(&*key.to_string_lossy()).unwrap_or(&NONE)
    }

    /// What is wrong with a graph, by node.
    pub(super) fn problems_of(&self, key: &Path) -> BTreeMap<String, Vec<Diagnostic>> {
        let name = key.display().to_string();
        let mut all: BTreeMap<String, Vec<Diagnostic>> = BTreeMap::new();
        for diagnostic in &self.found {
            let place = &diagnostic.place;
            let file = place.span.as_ref().map(|s| s.source.name.as_str()).or(place.file.as_deref());
            if let Some(node) = place.node.as_ref().filter(|_| file.is_none_or(|f| Path::new(f) == key || f == name)) {
                all.entry(node.clone()).or_default().push(diagnostic.clone());
            }
        }
        all
    }
}

fn by_graph(wires: Vec<Resolved>) -> BTreeMap<String, Wiring> {
    let mut all: BTreeMap<String, Wiring> = BTreeMap::new();
    // Between graphs there are no links to draw.
    for wire in wires.into_iter().filter(|w| w.graph == w.from_graph) {
        let ends = (wire.from.0.clone(), wire.to.0.clone());
        all.entry(wire.graph.clone()).or_default().entry(ends).or_default().push(wire);
    }
    all
}

fn stem(key: &Path) -> String {
    key.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned())
}

/// What the nodes of a graph cost: a share of the dearest, and in words. What lies in a subgraph counts for its node.
fn costs(all: &BTreeMap<String, Cost>, stem: &str) -> BTreeMap<String, (f32, String)> {
    let named = format!("{stem}/");
    // A graph that is woven alone has no name in source maps.
    let alone = !all.keys().any(|id| id.starts_with(&named));
    let mut nodes: BTreeMap<&str, (u32, u32)> = BTreeMap::new();
    for (id, cost) in all {
        let Some(own) = (if alone { Some(id.as_str()) } else { id.strip_prefix(&named) }) else { continue };
        let (operations, reads) = nodes.entry(own.split('/').next().unwrap_or(own)).or_default();
        *operations = operations.saturating_add(cost.operations);
        *reads = reads.saturating_add(cost.texture_reads);
    }
    let weight = |(operations, reads): (u32, u32)| operations as f32 + 16.0 * reads as f32;
    let most = nodes.values().map(|c| weight(*c)).fold(1.0, f32::max);
    let count = |n: u32, one: &str| if n == 1 { format!("1 {one}") } else { format!("{n} {one}s") };
    let words = |(operations, reads): (u32, u32)| match reads {
        0 => count(operations, "op"),
        _ => format!("{}, {}", count(operations, "op"), count(reads, "read")),
    };
    nodes.into_iter().map(|(node, cost)| (node.to_owned(), (weight(cost) / most, words(cost)))).collect()
}
