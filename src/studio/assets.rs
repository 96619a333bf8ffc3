//! What shaders and scenes need besides text: models, pictures, surroundings.

use std::io::Cursor;
use std::path::Path;

use super::failure::{Failure, FailureKind};
use super::load::{Loader, relative};
use crate::compile::NamedGraph;
use crate::diagnostic::{Diagnostic, Place};
use crate::module::{Module, Resource};
use crate::scene::{self, Environment, Mesh, Scene, Shape, environment};
use crate::semantic::Value;

/// Largest side of a picture, in pixels.
const MAX_SIDE: u32 = 16_384;
/// Most bytes that a decoded picture may take.
const MAX_PICTURE: u64 = 1 << 30;

/// Hands over the mesh of each object of a scene, in their order; tells everything that is wrong with any of them.
pub fn each_mesh(scene: &Scene, file: &Path, loader: &Loader, mut take: impl FnMut(Mesh)) -> Result<(), Failure> {
    let mut found: Vec<Diagnostic> = Vec::new();
    let mut kind = FailureKind::Input;
    for object in &scene.objects {
        match mesh_of(&object.shape, file, loader) {
            Ok(mesh) => take(mesh),
            Err(failure) => {
                if failure.kind != FailureKind::Input {
                    kind = failure.kind;
                }
                // Several objects may have one model, and its mistakes are told once.
                found.extend(failure.diagnostics.into_iter().filter(|e| !found.contains(e)).collect::<Vec<_>>());
            }
        }
    }
    if found.is_empty() { Ok(()) } else { Err(Failure { kind, diagnostics: found }) }
}

/// The mesh of a shape; what is wrong with its file is told where the file is mentioned.
pub fn mesh_of(shape: &Shape, file: &Path, loader: &Loader) -> Result<Mesh, Failure> {
    let Shape::Obj(reference) = shape else { return Ok(shape.mesh().unwrap_or_default()) };
    match loader.text(&relative(&reference.path, &file.display().to_string())) {
        Ok(source) => scene::from_obj(&source).map_err(Failure::from),
        Err(failure) => Err(Failure {
            diagnostics: failure.diagnostics.into_iter().map(|d| mentioned(d, reference.span.clone())).collect(),
            ..failure
        }),
    }
}

/// The picture of the surroundings, where the scene names one.
pub fn environment_image(
    of: &Environment,
    file: &Path,
    loader: &Loader,
) -> Result<Option<environment::Image>, Failure> {
    let Environment::Image { image, .. } = of else { return Ok(None) };
    let bytes = loader.bytes(&relative(&image.path, &file.display().to_string())).map_err(|failure| Failure {
        diagnostics: failure.diagnostics.into_iter().map(|d| mentioned(d, image.span.clone())).collect(),
        ..failure
    })?;
    let place = image.span.clone().map_or_else(|| Place::file(&*image.path), Place::span);
    let named = |d: Diagnostic| Diagnostic { message: format!("{}: {}", image.path, d.message), ..d };
    Ok(Some(environment::decode(&bytes, &place).map_err(|d| vec![named(*d)])?))
}

/// The complaint about a file, at the place that mentions it.
fn mentioned(diagnostic: Diagnostic, span: Option<crate::diagnostic::Span>) -> Diagnostic {
    let Some(span) = span.filter(|_| diagnostic.place.span.is_none()) else { return diagnostic };
    let file = diagnostic.place.file.as_deref().unwrap_or_default();
    Diagnostic { message: format!("{file}: {}", diagnostic.message), place: Place::span(span), ..diagnostic }
}

/// A reader for the bytes of a picture, with limits on what it may promise.
pub fn picture(bytes: Vec<u8>) -> Result<image::ImageReader<Cursor<Vec<u8>>>, String> {
    let mut reader = image::ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|e| e.to_string())?;
    let mut limits = image::Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_PICTURE);
    reader.limits(limits);
    Ok(reader)
}

/// What is wrong with the pictures that a shader reads, at the parameters that name them.
pub fn check_images(module: &Module, graphs: &[NamedGraph], loader: &Loader) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for binding in &module.bindings {
        let Resource::Image { path, base, .. } = &binding.resource else { continue };
        let full = relative(path, base);
        let trouble = match loader.bytes(&full) {
            Err(failure) => failure.diagnostics.into_iter().next().map(|d| (d.code, d.message)),
            Ok(bytes) => size(bytes).err().map(|message| ("ST0514", message)),
        };
        if let Some((code, message)) = trouble {
            // What cannot be read has its name in the message already.
            let name = full.display().to_string();
            let message = if message.contains(&name) { message } else { format!("the picture {name}: {message}") };
            let place = naming(graphs, path, base);
            found.push(Diagnostic::error(code, message, place).help("name a PNG, JPEG or HDR file"));
        }
    }
    found
}

/// Width and height as the picture's first bytes promise them.
fn size(bytes: Vec<u8>) -> Result<(), String> {
    let (width, height) = picture(bytes)?.into_dimensions().map_err(|e| e.to_string())?;
    if width == 0 || height == 0 || width > MAX_SIDE || height > MAX_SIDE {
        return Err(format!("it has {width} x {height} pixels; each side must have 1 to {MAX_SIDE}"));
    }
    Ok(())
}

/// Where a parameter names a picture.
fn naming(graphs: &[NamedGraph], path: &str, base: &str) -> Place {
    for named in graphs {
        for (name, node) in &named.graph.nodes {
            let from = node.spans.whole.as_ref().map(|s| s.source.name.as_str());
            let port = node.params.iter().find(|(_, v)| matches!(v, Value::Text(text) if text == path));
            if let Some((port, _)) = port.filter(|_| from.is_none_or(|f| f == base)) {
                return named.graph.param_place(name, port);
            }
        }
    }
    Place::file(base)
}
