//! Meshes, surroundings and images, kept as long as what they were made from stays the same.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::assets::{environment_image, mesh_of, picture};
use super::failure::{Failure, FailureKind};
use super::load::{Loader, Stamp, relative};
use super::shot::Shot;
use super::stage;
use crate::diagnostic::Diagnostic;
use crate::render::{Picture, Surroundings, SurroundingsLevel, Texels};
use crate::scene::{Environment, Mesh, Scene, Shape, environment};

/// Most things of each sort that are kept; then all are forgotten.
const MOST: usize = 1024;
/// Most bytes of decoded images that are kept.
const MOST_BYTES: usize = 512 << 20;

/// What was made so far.
#[derive(Default)]
pub struct Stock {
    meshes: Vec<(Shape, Version, Arc<Mesh>)>,
    surroundings: Option<(Environment, Version, Arc<Surroundings>)>,
    images: RefCell<BTreeMap<PathBuf, (Version, Arc<Picture>)>>,
}

/// The state of the file that a thing was made from; none where there is no file.
type Version = Option<(PathBuf, Option<Stamp>)>;

/// What a shot needs besides its shaders.
pub struct Assets {
    /// The scene with its objects where they are drawn.
    pub scene: Scene,
    /// The mesh of each object, in their order.
    pub meshes: Vec<Arc<Mesh>>,
    /// What surrounds it.
    pub surroundings: Arc<Surroundings>,
}

impl Stock {
    /// Everything that a shot needs. All that is wrong with any of it is told together.
    pub fn assets(&mut self, shot: &Shot, loader: &Loader) -> Result<Assets, Failure> {
        self.assets_in(shot, None, loader)
    }

    /// The same with other surroundings than the shot's own.
    pub fn assets_in(
        &mut self,
        shot: &Shot,
        environment: Option<&Environment>,
        loader: &Loader,
    ) -> Result<Assets, Failure> {
        let mut scene = shot.scene.clone();
        if let Some(environment) = environment {
            scene.environment = environment.clone();
        }
        let mut found: Vec<Diagnostic> = Vec::new();
        let mut kind = FailureKind::Input;
        let mut meshes = Vec::new();
        for object in &scene.objects {
            match self.mesh(&object.shape, &shot.file, loader) {
                Ok(mesh) => meshes.push(mesh),
                Err(failure) => {
                    if failure.kind != FailureKind::Input {
                        kind = failure.kind;
                    }
                    // Several objects may have one model, and its mistakes are told once.
                    let new = failure.diagnostics.into_iter().filter(|e| !found.contains(e)).collect::<Vec<_>>();
                    found.extend(new);
                }
            }
        }
        if !found.is_empty() {
            return Err(Failure { kind, diagnostics: found });
        }
        if shot.stands {
            let shown = scene.objects.iter_mut().zip(&meshes).filter(|(o, _)| o.name == stage::SHOWN);
            shown.for_each(|(object, mesh)| stage::stand(object, mesh));
        }
        let surroundings = self.surroundings(&scene.environment, &shot.file, loader)?;
        Ok(Assets { scene, meshes, surroundings })
    }

    fn mesh(&mut self, shape: &Shape, file: &Path, loader: &Loader) -> Result<Arc<Mesh>, Failure> {
        let version = match shape {
            Shape::Obj(reference) => version(&reference.path, file),
            _ => None,
        };
        let known = self.meshes.iter().find(|(s, v, _)| *v == version && (version.is_some() || s == shape));
        if let Some((.., mesh)) = known {
            return Ok(mesh.clone());
        }
        let mesh = Arc::new(mesh_of(shape, file, loader)?);
        if self.meshes.len() >= MOST {
            self.meshes.clear();
        }
        self.meshes.push((shape.clone(), version, mesh.clone()));
        Ok(mesh)
    }

    fn surroundings(&mut self, of: &Environment, file: &Path, loader: &Loader) -> Result<Arc<Surroundings>, Failure> {
        let version = match of {
            Environment::Image { image, .. } => version(&image.path, file),
            _ => None,
        };
        if let Some((known, v, made)) = &self.surroundings
            && *v == version
            && same(known, of)
        {
            return Ok(made.clone());
        }
        let image = environment_image(of, file, loader)?;
        let map = environment::Map::new(of, image.as_ref());
        let level = |l: environment::Level| SurroundingsLevel { width: l.width, height: l.height, pixels: l.pixels };
        let levels = map.levels.into_iter().map(level).collect();
        let made = Arc::new(Surroundings { levels, irradiance: map.irradiance, background: true });
        self.surroundings = Some((of.clone(), version, made.clone()));
        Ok(made)
    }

    /// Decodes the image of a texture: a path as the graph gives it, relative to the file that mentions it.
    pub fn image(&self, loader: &Loader, path: &str, base: &str) -> Result<Picture, String> {
        let full = relative(path, base);
        let version = Some((full.clone(), Stamp::of(&full)));
        if let Some((v, picture)) = self.images.borrow().get(&full)
            && *v == version
        {
            return Ok(Picture::clone(picture));
        }
        let first = |f: Failure| f.diagnostics.first().map_or_else(String::new, |d| d.message.clone());
        let bytes = loader.bytes(&full).map_err(first)?;
        let decoded = picture(bytes)?.decode().map_err(|e| e.to_string())?;
        let (width, height) = (decoded.width(), decoded.height());
        let texels = match decoded {
            image::DynamicImage::ImageRgb32F(_) | image::DynamicImage::ImageRgba32F(_) => {
                Texels::Floats(decoded.into_rgba32f().pixels().map(|p| p.0).collect())
            }
            _ => Texels::Bytes(decoded.into_rgba8().pixels().map(|p| p.0).collect()),
        };
        let picture = Picture { width, height, texels };
        let mut images = self.images.borrow_mut();
        let kept: usize = images.values().map(|(_, p)| bytes_of(p)).sum();
        if images.len() >= MOST || kept + bytes_of(&picture) > MOST_BYTES {
            images.clear();
        }
        images.insert(full, (version, Arc::new(picture.clone())));
        Ok(picture)
    }
}

fn bytes_of(picture: &Picture) -> usize {
    match &picture.texels {
        Texels::Bytes(t) => t.len() * 4,
        Texels::Floats(t) => t.len() * 16,
    }
}

fn version(path: &str, file: &Path) -> Version {
    let full = relative(path, &file.display().to_string());
    let stamp = Stamp::of(&full);
    Some((full, stamp))
}

/// Whether two surroundings are the same, wherever they are written.
fn same(a: &Environment, b: &Environment) -> bool {
    match (a, b) {
        (
            Environment::Image { rotation: r, intensity: i, image: p },
            Environment::Image { rotation, intensity, image },
        ) => r == rotation && i == intensity && p.path == image.path,
        _ => a == b,
    }
}
