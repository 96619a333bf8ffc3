//! From text to scene, with everything that is wrong on the way.

use std::ops::Range;
use std::sync::Arc;

use super::{CameraSettings, LightInstance, MAX_ITEMS, Object, Scene, Transform, Unknown, VERSION, read_parts};
use crate::diagnostic::{Diagnostic, Place, SourceText, Span};
use crate::ron::{self, Comment, Field, Node, Tree, expect_fields, field, unknown_fields};

/// Most mistakes that one scene is told of.
const MAX_REPORTED: usize = 100;

/// What was found wrong so far.
pub(super) struct Report {
    pub(super) source: Arc<SourceText>,
    found: Vec<Diagnostic>,
}

impl Report {
    /// One more; beyond the limit only the fact that there are more is kept.
    pub(super) fn push(&mut self, diagnostic: Diagnostic) {
        if self.found.len() < MAX_REPORTED {
            self.found.push(diagnostic);
        } else if self.found.len() == MAX_REPORTED {
            let place = Place::file(self.source.name.clone());
            self.found.push(
                Diagnostic::error("ST0415", "there are more mistakes than are listed here", place)
                    .help("correct these first"),
            );
        }
    }

    /// An error at a value.
    pub(super) fn error(&mut self, code: &'static str, message: impl Into<String>, node: &Node, help: &str) {
        let diagnostic = Diagnostic::error(code, message, node.place(&self.source));
        self.push(if help.is_empty() { diagnostic } else { diagnostic.help(help) });
    }

    /// The value of a reading, or nothing and its complaint reported.
    pub(super) fn take<T>(&mut self, reading: ron::Reading<T>) -> Option<T> {
        reading.map_err(|diagnostic| self.push(*diagnostic)).ok()
    }

    /// The field `name` read by `read`, or `default`.
    pub(super) fn get<T>(
        &mut self,
        fields: &[Field],
        name: &str,
        default: T,
        read: impl Fn(&Node, &Arc<SourceText>) -> ron::Reading<T>,
    ) -> T {
        let source = self.source.clone();
        field(fields, name).and_then(|node| self.take(read(node, &source))).unwrap_or(default)
    }

    /// A text field; empty where it is not given.
    pub(super) fn text(&mut self, fields: &[Field], name: &str) -> String {
        self.get(fields, name, String::new(), |node, source| node.as_str(source).map(str::to_string))
    }

    /// Warns of fields that are not known, and gives them out to be kept.
    fn unknown(&mut self, fields: &[Field], known: &[&str]) -> Unknown {
        for warning in unknown_fields(fields, known, &self.source.clone()) {
            self.push(warning);
        }
        let unknown = fields.iter().filter(|f| !known.contains(&f.name.as_str()));
        unknown.map(|f| (f.name.clone(), f.value.clone())).collect()
    }

    /// An error about the file as a whole, at the name of its root.
    fn at_root(&mut self, code: &'static str, message: impl Into<String>, root: &Node, help: &str) {
        let name = root.span.start..root.span.start + "Scene".len().min(root.span.len());
        let place = Place::span(Span::new(&self.source, name));
        self.push(Diagnostic::error(code, message, place).help(help));
    }

    pub(super) fn span(&self, node: &Node) -> Span {
        Span::new(&self.source, node.span.clone())
    }
}

/// Reads a scene. With errors, the scene is what could be made out; writing it could lose something.
///
/// Comments become part of the `note` of the light or object that they stand in, or of the scene's.
pub fn read(source: &Arc<SourceText>) -> (Option<Scene>, Vec<Diagnostic>) {
    let (document, found) = ron::read(source);
    let mut report = Report { source: source.clone(), found: Vec::new() };
    found.into_iter().for_each(|d| report.push(d));
    let scene = document.and_then(|document| scene(&document, &mut report));
    (scene, report.found)
}

fn scene(document: &ron::Document, report: &mut Report) -> Option<Scene> {
    let root = &document.root;
    let fields: &[Field] = match &root.value {
        Tree::Struct(Some(name), fields) if name == "Scene" => fields,
        Tree::Tuple(Some(name), items) if name == "Scene" && items.is_empty() => &[],
        other => {
            let help = match other {
                Tree::Struct(Some(name), _) if name == "Graph" => "this is a graph file; a scene file is needed here",
                _ => "a scene file is written `Scene(version: 1, camera: (...), lights: {...}, objects: {...})`",
            };
            report.at_root("ST0400", format!("expected `Scene(...)`, found {}", other.describe()), root, help);
            return None;
        }
    };
    if !version(fields, root, report) {
        return None;
    }
    let mut scene = Scene { version: VERSION, ..Scene::default() };
    scene.name = report.text(fields, "name");
    scene.note = report.text(fields, "note");
    match field(fields, "camera") {
        Some(node) => scene.camera = camera(node, report),
        None => {
            let help = "add `camera: (position: (3, 2, 5), target: (0, 0.5, 0), fov: 40)`";
            report.at_root("ST0403", "the scene has no camera", root, help);
        }
    }
    if let Some(node) = field(fields, "environment") {
        scene.environment = read_parts::environment(node, report).unwrap_or_default();
    }
    for (name, span, node) in entries(fields, "lights", report) {
        scene.lights.push(light(name, span, node, report));
    }
    for (name, span, node) in entries(fields, "objects", report) {
        scene.objects.extend(object(name, span, node, report));
    }
    if field(fields, "objects").is_none_or(|n| matches!(&n.value, Tree::Map(m) if m.is_empty())) {
        let help = "add `objects: {\"ground\": (shape: Plane(size: (10, 10)), surface: \"surface.ron\")}`";
        let place = Place::span(Span::new(&report.source, root.span.start..root.span.start + "Scene".len()));
        report.push(Diagnostic::warning("ST0410", "the scene has no objects", place).help(help));
    }
    let known = ["version", "name", "note", "camera", "environment", "lights", "objects"];
    scene.unknown = report.unknown(fields, &known);
    keep_comments(&document.comments, &report.source.text, &mut scene);
    scene.lights.sort_by(|a, b| a.name.cmp(&b.name));
    scene.objects.sort_by(|a, b| a.name.cmp(&b.name));
    Some(scene)
}

/// Whether the version is one that is read.
fn version(fields: &[Field], root: &Node, report: &mut Report) -> bool {
    let Some(node) = field(fields, "version") else {
        report.at_root("ST0401", "the scene does not say its version", root, "add `version: 1` as its first field");
        // It can still be looked at: a forgotten version is no reason to hide other mistakes.
        return true;
    };
    let source = report.source.clone();
    match node.as_u64(&source, u64::from(u32::MAX)) {
        Ok(1) => true,
        Ok(0) => {
            report.error("ST0401", "version 0 of scene files has never existed", node, "write `version: 1`");
            true
        }
        Ok(newer) => {
            let message = format!("the scene has version {newer}; this program reads up to {VERSION}");
            report.error("ST0402", message, node, "use a newer shadetree");
            false
        }
        Err(diagnostic) => {
            report.push(Diagnostic { code: "ST0401", ..*diagnostic }.help("write `version: 1`"));
            true
        }
    }
}

/// Named values of a map field, with the span of the name.
fn entries<'a>(fields: &'a [Field], name: &str, report: &mut Report) -> Vec<(String, Span, &'a Node)> {
    let source = report.source.clone();
    let Some(map) = field(fields, name).and_then(|node| report.take(node.as_map(&source))) else {
        return Vec::new();
    };
    if map.len() > MAX_ITEMS {
        let message = format!("the scene has {} {name}; at most {MAX_ITEMS} are handled", map.len());
        report.error("ST0414", message, &map[MAX_ITEMS].0, "put objects that have one surface into one OBJ file");
        return Vec::new();
    }
    let mut entries = Vec::new();
    for (key, value) in map {
        if let Some(text) = report.take(key.as_str(&source)) {
            if text.trim().is_empty() {
                report.error("ST0411", "a name is empty", key, "give it a name");
            }
            entries.push((text.to_string(), report.span(key), value));
        }
    }
    entries
}

fn camera(node: &Node, report: &mut Report) -> CameraSettings {
    let source = report.source.clone();
    let Some(fields) = report.take(expect_fields(node, &source, "a camera `(position: ..., target: ..., fov: ...)`"))
    else {
        return CameraSettings::default();
    };
    let d = CameraSettings::default();
    let camera = CameraSettings {
        position: report.get(fields, "position", d.position, Node::as_array),
        target: report.get(fields, "target", d.target, Node::as_array),
        up: report.get(fields, "up", d.up, Node::as_array),
        fov: report.get(fields, "fov", d.fov, Node::as_f64),
        near: report.get(fields, "near", d.near, Node::as_f64),
        far: report.get(fields, "far", d.far, Node::as_f64),
        unknown: report.unknown(fields, &["position", "target", "up", "fov", "near", "far"]),
    };
    read_parts::check_camera(&camera, node, fields, report);
    camera
}

fn light(name: String, span: Span, node: &Node, report: &mut Report) -> LightInstance {
    let source = report.source.clone();
    let fields = report.take(expect_fields(node, &source, "a light `(graph: \"light.ron\")`")).unwrap_or_default();
    LightInstance {
        name,
        span: Some(span),
        note: report.text(fields, "note"),
        graph: read_parts::path(fields, "graph", node, report),
        set: read_parts::settings(fields, report),
        unknown: report.unknown(fields, &["note", "graph", "set"]),
    }
}

fn object(name: String, span: Span, node: &Node, report: &mut Report) -> Option<Object> {
    let source = report.source.clone();
    let what = "an object `(shape: ..., surface: \"surface.ron\")`";
    let fields = report.take(expect_fields(node, &source, what))?;
    let shape = match field(fields, "shape") {
        Some(shape) => read_parts::shape(shape, report),
        None => {
            report.error("ST0011", format!("the object `{name}` has no shape"), node, "add `shape: Sphere(radius: 1)`");
            None
        }
    };
    let d = Transform::default();
    let transform = Transform {
        translate: report.get(fields, "translate", d.translate, Node::as_array),
        rotate: report.get(fields, "rotate", d.rotate, Node::as_array),
        scale: report.get(fields, "scale", d.scale, |node, source| {
            // One number scales all axes alike.
            node.as_f64(source).map(|x| [x; 3]).or_else(|_| node.as_array(source))
        }),
    };
    if transform.scale.iter().any(|x| *x <= 0.0) {
        let help = "scale by factors greater than 0";
        report.error(
            "ST0407",
            format!("the object `{name}` is scaled to nothing or turned inside out"),
            field(fields, "scale").unwrap_or(node),
            help,
        );
    }
    let known = ["note", "shape", "surface", "set", "translate", "rotate", "scale", "casts", "receives"];
    let object = Object {
        span: Some(span),
        note: report.text(fields, "note"),
        shape: shape.clone().unwrap_or(super::Shape::Obj(Default::default())),
        surface: read_parts::path(fields, "surface", node, report),
        set: read_parts::settings(fields, report),
        transform,
        casts: report.get(fields, "casts", true, Node::as_bool),
        receives: report.get(fields, "receives", true, Node::as_bool),
        unknown: report.unknown(fields, &known),
        name,
    };
    shape.map(|_| object)
}

/// Comments become notes: the writer has no other place for them.
fn keep_comments(comments: &[Comment], text: &str, scene: &mut Scene) {
    // What is within an item follows its name; items do not nest, so the last name before a comment is the one.
    let start = |span: &Option<Span>| span.as_ref().map_or(usize::MAX, |s| s.range.start);
    let mut items: Vec<(Range<usize>, &mut String)> = Vec::new();
    for light in &mut scene.lights {
        items.push((start(&light.span)..0, &mut light.note));
    }
    for object in &mut scene.objects {
        items.push((start(&object.span)..0, &mut object.note));
    }
    items.sort_by_key(|(range, _)| range.start);
    for comment in comments {
        let Some(marked) = text.get(comment.span.clone()) else {
            continue;
        };
        let bare = if comment.block {
            marked.trim_start_matches("/*").trim_end_matches("*/").trim()
        } else {
            marked.trim_start_matches('/').trim()
        };
        let next = items.partition_point(|(range, _)| range.start < comment.span.start);
        let note = match next.checked_sub(1) {
            Some(index) => &mut *items[index].1,
            None => &mut scene.note,
        };
        if !bare.is_empty() {
            if !note.is_empty() {
                note.push('\n');
            }
            note.push_str(bare);
        }
    }
}
