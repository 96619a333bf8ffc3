//! Files that are only read when something is rendered: pictures and models. `check` looks at them as well.

use std::io::Cursor;
use std::path::Path;

use super::load::{Loader, relative};
use crate::compile::NamedGraph;
use crate::diagnostic::{Diagnostic, Place};
use crate::scene::{Environment, FileReference, Scene, Shape, environment, from_obj};
use crate::semantic::Value;

/// What is wrong with the pictures that nodes name.
pub(super) fn of_graphs(loader: &Loader, graphs: &[NamedGraph]) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for graph in graphs.iter().map(|g| &g.graph) {
        for (name, node) in graph.nodes.iter().filter(|(_, n)| !n.muted) {
            for (port, value) in &node.params {
                // Weaving lets a text stand at a texture only.
                let Value::Text(path) = value else { continue };
                let place = graph.param_place(name, port);
                let base = place.span.as_ref().map_or("", |s| s.source.name.as_str());
                match loader.bytes(&relative(path, base)) {
                    Ok(bytes) => found.extend(not_a_picture(path, &bytes, place)),
                    Err(failure) => found.extend(failure.diagnostics.into_iter().map(|d| at(d, &place))),
                }
            }
        }
    }
    found
}

/// What is wrong with the models and the surroundings of a scene.
pub(super) fn of_scene(loader: &Loader, scene: &Scene, file: &Path) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let file = file.display().to_string();
    let place = |reference: &FileReference| reference.span.clone().map_or_else(Place::default, Place::span);
    let mut seen: Vec<&str> = Vec::new();
    for object in &scene.objects {
        let Shape::Obj(model) = &object.shape else { continue };
        if seen.contains(&model.path.as_str()) {
            continue;
        }
        seen.push(&model.path);
        match loader.text(&relative(&model.path, &file)) {
            Ok(text) => {
                let wrong = from_obj(&text).err().unwrap_or_default();
                found.extend(wrong.into_iter().map(|d| at(d, &place(model))));
            }
            Err(failure) => found.extend(failure.diagnostics.into_iter().map(|d| at(d, &place(model)))),
        }
    }
    if let Environment::Image { image, .. } = &scene.environment {
        match loader.bytes(&relative(&image.path, &file)) {
            Ok(bytes) => found.extend(environment::decode(&bytes, &place(image)).err().map(|d| *d)),
            Err(failure) => found.extend(failure.diagnostics.into_iter().map(|d| at(d, &place(image)))),
        }
    }
    found
}

/// The diagnostic where the file is mentioned, unless it has a line of its own.
fn at(mut diagnostic: Diagnostic, place: &Place) -> Diagnostic {
    if diagnostic.place.span.is_none() {
        diagnostic.place = place.clone();
    }
    diagnostic
}

/// Whether a picture has a header that can be read; its pixels are left to rendering.
fn not_a_picture(path: &str, bytes: &[u8], place: Place) -> Option<Diagnostic> {
    let reader = image::ImageReader::new(Cursor::new(bytes)).with_guessed_format().ok()?;
    let error = reader.into_dimensions().err()?;
    let message = format!("`{path}` is not a picture that can be read: {error}");
    Some(Diagnostic::error("ST0520", message, place).help("give a PNG, JPEG or HDR file"))
}
