//! One picture of a shot on a device.

use std::collections::BTreeMap;

use super::failure::{Failure, FailureKind};
use super::load::Loader;
use super::shot::Shot;
use super::stock::{Assets, Stock};
use crate::compile::Output;
use crate::diagnostic::{Diagnostic, Place};
use crate::render::{ColorFormat, Draw, Frame, Gpu, Job, RenderError};
use crate::scene::Camera;
use crate::weave::light_called;

/// What is shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Aov {
    /// Something that the fragment shader writes.
    Output(Output),
    /// One of the distinct maps of a light.
    Map(String, usize),
}

/// How a picture is taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Exposure {
    /// What is shown.
    pub aov: Aov,
    /// From where; none for the scene's own camera.
    pub camera: Option<Camera>,
    /// Columns and rows.
    pub size: (u32, u32),
    /// Samples per pixel: 1 or 4.
    pub samples: u32,
    /// Time that animated nodes see, seconds.
    pub time: f32,
    /// Precision.
    pub format: ColorFormat,
}

/// Takes the picture. That of a map has no timings.
pub fn draw(
    shot: &Shot,
    assets: &Assets,
    stock: &Stock,
    loader: &Loader,
    exposure: &Exposure,
    gpu: &mut Gpu,
) -> Result<Frame, RenderError> {
    with_job(shot, assets, stock, loader, exposure, |job| {
        let Aov::Map(light, index) = &exposure.aov else { return gpu.render(job) };
        let lights = shot.lights();
        let name = light_called(lights.iter().map(String::as_str), light).unwrap_or(light);
        let map = gpu.map(job, name, *index)?;
        Ok(Frame {
            size: map.size,
            pixels: map.pixels,
            adapter: gpu.adapter().clone(),
            messages: map.messages,
            timings: Vec::new(),
        })
    })
}

/// Hands over the job that takes the picture.
pub fn with_job<T>(
    shot: &Shot,
    assets: &Assets,
    stock: &Stock,
    loader: &Loader,
    exposure: &Exposure,
    work: impl FnOnce(&Job<'_>) -> T,
) -> T {
    let mut draws = Vec::new();
    for (object, mesh) in assets.scene.objects.iter().zip(&assets.meshes) {
        let own = shot.shaders.iter().find(|s| s.objects.is_empty() || s.objects.contains(&object.name));
        if let Some(shader) = own {
            draws.push(Draw {
                mesh,
                object_to_world: object.transform.matrix(),
                casts: object.casts,
                receives: object.receives,
                shader: &shader.compiled,
                values: BTreeMap::new(),
            });
        }
    }
    let images = |path: &str, base: &str| stock.image(loader, path, base);
    work(&Job {
        draws,
        camera: exposure.camera.unwrap_or_else(|| assets.scene.camera.camera()),
        surroundings: Some(&*assets.surroundings).filter(|_| exposure.aov == Aov::Output(Output::Radiance)),
        size: exposure.size,
        samples: exposure.samples,
        time: exposure.time,
        images: &images,
        output: exposure.format,
    })
}

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Self {
        let (code, kind) = match &error {
            RenderError::NoAdapter { .. } | RenderError::NoDevice { .. } | RenderError::Unsupported(_) => {
                ("ST0513", FailureKind::NoAdapter)
            }
            RenderError::UnknownBackend(_) => ("ST0513", FailureKind::Usage),
            RenderError::DeviceLost(_) => ("ST0514", FailureKind::NoAdapter),
            RenderError::Job(message) if message.contains("has no map") => ("ST0512", FailureKind::Input),
            _ => ("ST0514", FailureKind::Input),
        };
        let diagnostic = Diagnostic::error(code, error.to_string(), Place::default());
        let help = error.help();
        Self::new(kind, help.into_iter().fold(diagnostic, |d, h| d.help(h)))
    }
}
