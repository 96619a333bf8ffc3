//! From a shot to a picture, on a device that is opened again when it is lost.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use super::compiler::{loader, with_subject};
use super::messages::{Image, Look, Request};
use super::{PassTiming, Point};
use crate::compile::{Options, Output};
use crate::diagnostic::{Diagnostic, Place};
use crate::node::Catalog;
use crate::reference::picture::Watch;
use crate::render::image_file::{Display, ToneCurve};
use crate::render::{AdapterOptions, ColorFormat, Frame, Gpu, RenderError};
use crate::studio::load::Loader;
use crate::studio::measure::{Comparison, compare, error_map, measure, shadow_kinds, shadow_of};
use crate::studio::picture::{Aov, Exposure, draw};
use crate::studio::stock::{Assets, Stock};
use crate::studio::truth::{Reference, Wanted, find};
use crate::studio::weave::{Known, Weaver};
use crate::studio::{Collected, Failure, FailureKind, Shot, figure, write};

/// Rays a pixel for the error of a light as it is edited: their standard error is below what can be seen.
const RAYS: u32 = 64;

/// A picture to make.
#[derive(Clone)]
pub(super) struct Work {
    pub(super) request: Request,
    pub(super) shot: Arc<Shot>,
    pub(super) catalog: Arc<Catalog>,
    /// Set when nobody wants it any more.
    pub(super) cancel: Arc<AtomicBool>,
}

/// A truth that was computed: of what, as it was wanted, and its picture.
type Truth = (Arc<Shot>, Wanted, Arc<Vec<[f32; 4]>>);

/// Makes pictures.
pub(super) struct Renderer {
    options: AdapterOptions,
    gpu: Option<Gpu>,
    stock: Stock,
    truth: Option<Truth>,
}

impl Renderer {
    pub(super) fn new(options: AdapterOptions) -> Self {
        Self { options, gpu: None, stock: Stock::default(), truth: None }
    }

    /// Makes a picture. `drawing` is told when the device begins to work and when it is done.
    pub(super) fn picture(&mut self, work: &Work, drawing: &dyn Fn(bool)) -> Result<Image, Failure> {
        let begun = Instant::now();
        let (request, shot) = (&work.request, &*work.shot);
        let loader = loader(request);
        let assets = self.stock.assets_in(shot, request.environment.as_ref(), &loader)?;
        let camera = request.camera.unwrap_or_else(|| assets.scene.camera.camera());
        let is_error = matches!(request.look, Look::Error { .. });
        let exposure = Exposure {
            aov: match &request.look {
                Look::Map { light, index } => Aov::Map(light.clone(), *index),
                Look::Output(output) => Aov::Output(output.clone()),
                Look::Error { light } => Aov::Output(Output::Visibility(light.clone())),
                Look::Node { .. } if shot.is_radiance() => Aov::Output(Output::Radiance),
                // A value has nothing behind it, as other outputs have not.
                Look::Node { .. } => Aov::Output(Output::Normal),
            },
            camera: Some(camera),
            size: request.size,
            samples: if is_error { 1 } else { request.samples },
            time: request.time,
            format: if is_error { ColorFormat::Float } else { ColorFormat::Half },
        };
        drawing(true);
        let frame = self.frame(shot, &assets, &loader, &exposure);
        drawing(false);
        let frame = frame?;
        let mut number = None;
        let rgba = match &request.look {
            Look::Error { .. } => {
                let wanted = Wanted {
                    reference: Reference::Rays,
                    camera: Some(camera),
                    size: frame.size,
                    samples: Some(RAYS),
                    kernel: None,
                };
                let truth = self.truth(work, &loader, &wanted)?;
                number = Some(("RMSE".to_owned(), compare(&frame.pixels, &truth).rms));
                error_map(&frame.pixels, &truth).into_flattened()
            }
            Look::Map { .. } => shown(&grey(&frame), ToneCurve::None),
            _ if exposure.aov == Aov::Output(Output::Radiance) => shown(&frame.pixels, ToneCurve::Filmic),
            _ => shown(&frame.pixels, ToneCurve::None),
        };
        let timings: Vec<PassTiming> = frame.timings;
        Ok(Image {
            revision: request.revision,
            size: frame.size,
            rgba,
            timings,
            milliseconds: begun.elapsed().as_secs_f64() * 1e3,
            adapter: frame.adapter.name,
            software: frame.adapter.software,
            messages: frame.messages,
            number,
            camera,
            pipelines_built: self.gpu.as_ref().map_or(0, Gpu::pipelines_built),
            lights: shot.lights(),
        })
    }

    /// Draws; where the device is lost, once more on a new one.
    fn frame(
        &mut self,
        shot: &Shot,
        assets: &Assets,
        loader: &Loader,
        exposure: &Exposure,
    ) -> Result<Frame, RenderError> {
        for again in [true, false] {
            let gpu = match &mut self.gpu {
                Some(gpu) => gpu,
                None => self.gpu.insert(Gpu::new(&self.options)?),
            };
            match draw(shot, assets, &self.stock, loader, exposure, gpu) {
                Err(RenderError::DeviceLost(_)) if again => self.gpu = None,
                Err(error) => {
                    if matches!(error, RenderError::DeviceLost(_) | RenderError::OutOfMemory(_)) {
                        self.gpu = None;
                    }
                    return Err(error);
                }
                frame => return frame,
            }
        }
        Err(RenderError::DeviceLost("twice".into()))
    }

    /// The true visibility of the light of a request.
    fn truth(&mut self, work: &Work, loader: &Loader, wanted: &Wanted) -> Result<Arc<Vec<[f32; 4]>>, Failure> {
        if let Some((shot, known, truth)) = &self.truth
            && Arc::ptr_eq(shot, &work.shot)
            && known == wanted
        {
            return Ok(truth.clone());
        }
        let Look::Error { light } = &work.request.look else { return Err(Failure::told()) };
        let (listener, known) = (Collected::default(), Known::default());
        let options = Options { output: Output::Visibility(light.clone()), ..Options::default() };
        let weaver = Weaver { options, ..Weaver::new(&listener, loader, &work.catalog, &known) };
        let watch = Watch { cancel: &work.cancel, done: &|_| {} };
        let found = with_subject(&work.request.show, |subject| find(subject, wanted, &weaver, watch, &|_| {}));
        let truth = Arc::new(found.map_err(|failure| with(failure, &listener))?.pixels);
        self.truth = Some((work.shot.clone(), *wanted, truth.clone()));
        Ok(truth)
    }

    /// Destroys the device, as a driver reset would.
    #[cfg(test)]
    pub(super) fn lose(&self) {
        if let Some(gpu) = &self.gpu {
            gpu.lose();
        }
    }
}

/// Measures every kind of shadow on a light, on a device of its own, so that no time or map is shared with pictures.
pub(super) fn points(
    options: &AdapterOptions,
    request: &Request,
    light: &str,
    catalog: &Catalog,
    cancel: &AtomicBool,
    mut each: impl FnMut(Point),
) -> Result<(), Failure> {
    let (listener, known) = (Collected::default(), Known::default());
    let loader = Loader::with_overlay(request.overlay.clone());
    let weaver = Weaver::new(&listener, &loader, catalog, &known);
    let measured = with_subject(&request.show, |subject| {
        let shadow = shadow_of(subject, light, &weaver)?;
        let comparison = Comparison {
            light,
            shadow: &shadow,
            kinds: &shadow_kinds(catalog),
            reference: None,
            samples: None,
            camera: request.camera,
            size: request.size,
            pictures: false,
        };
        let mut gpu = Gpu::new(options)?;
        gpu.keep_maps(0);
        measure(subject, &comparison, &weaver, &mut gpu, cancel, |m| each(m.point))
    });
    measured.map_err(|failure| with(failure, &listener))
}

/// Makes a figure, with texts in place of files, and writes it. A device of its own is opened for it.
pub(super) fn figure(
    options: &AdapterOptions,
    wanted: &figure::Request,
    overlay: BTreeMap<PathBuf, Arc<str>>,
    nodes: &[PathBuf],
    path: &Path,
) -> Result<(), Failure> {
    let (listener, known) = (Collected::default(), Known::default());
    let loader = Loader::with_overlay(overlay);
    let (catalog, _) = loader.catalog(nodes)?;
    let weaver = Weaver::new(&listener, &loader, &catalog, &known);
    let made = figure::make(wanted, &weaver, || Gpu::new(options)).map_err(|failure| with(failure, &listener))?;
    write(path, &made).map_err(|error| {
        let place = Place::file(path.display().to_string());
        Failure::new(FailureKind::Unreadable, Diagnostic::error("ST0505", error.to_string(), place))
    })
}

/// A failure with what was told before it: here nobody listened.
fn with(mut failure: Failure, listener: &Collected) -> Failure {
    let errors = listener.take().into_iter().filter(|d| d.severity == crate::diagnostic::Severity::Error);
    failure.diagnostics.extend(errors);
    failure
}

/// As a screen shows it, not multiplied by coverage.
fn shown(pixels: &[[f32; 4]], tone: ToneCurve) -> Vec<u8> {
    let display = Display { tone, ..Display::default() };
    pixels.iter().flat_map(|p| display.apply(*p)).collect()
}

/// Maps of one channel are grey rather than red.
fn grey(frame: &Frame) -> Vec<[f32; 4]> {
    let single = frame.pixels.iter().all(|p| p[1] == 0.0 && p[2] == 0.0);
    let all = frame.pixels.iter();
    all.map(|p| if single { [p[0], p[0], p[0], 1.0] } else { [p[0], p[1], p[2], 1.0] }).collect()
}
