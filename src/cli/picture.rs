//! One picture: geometry and surroundings of the scene, shaders, the job, the file.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::assets::{each_mesh, environment_image, picture};
use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use super::load::{Document, Loader, relative};
use super::output;
use super::render::{Aov, Render, Samples, adapter_options};
use super::settings::overrides;
use super::stage;
use super::weave::{Input, Shader, Weaver};
use crate::compile::{NamedGraph, Options, Output};
use crate::diagnostic::{Diagnostic, Place};
use crate::render::image_file::{Display, ToneCurve, encode_exr, encode_png};
use crate::render::{
    ColorFormat, Draw, Gpu, Job, PassTiming, Picture, RenderError, Surroundings, SurroundingsLevel, Texels,
};
use crate::scene::{Environment, Scene, environment};
use crate::weave::light_called;

pub(super) fn once(command: &Render, context: &Context, loader: &Loader, gpu: &mut Option<Gpu>) -> Outcome {
    let drawn = pixels(command, context, loader, gpu)?;
    for message in &drawn.messages {
        context.say(message);
    }
    let tone = match command.aov {
        Aov::Output(Output::Radiance) => ToneCurve::Filmic,
        _ => ToneCurve::None,
    };
    save(command, context, drawn.size, &drawn.pixels, tone, ("Adapter", &drawn.adapter))?;
    Ok(Exit::Done)
}

/// A picture before it is written.
pub(super) struct Drawn {
    pub(super) size: (u32, u32),
    /// Linear colour and coverage, rows from the top.
    pub(super) pixels: Vec<[f32; 4]>,
    pub(super) adapter: String,
    pub(super) messages: Vec<String>,
    /// What each pass took; none for maps.
    pub(super) timings: Vec<PassTiming>,
}

/// Renders what a command asks for.
pub(super) fn pixels(
    command: &Render,
    context: &Context,
    loader: &Loader,
    gpu: &mut Option<Gpu>,
) -> Result<Drawn, Failure> {
    let (catalog, found) = loader.catalog(&command.nodes)?;
    context.report(&found);
    let mut options = Options::default();
    if let Aov::Output(output) = &command.aov {
        options.output = output.clone();
    }
    let set = overrides(&command.kind, &command.set, &command.option);
    let weaver = Weaver { context, loader, catalog: &catalog, options, set: &set, images: true };
    let (scene, file, shaders) = shaders(command, &weaver)?;
    let mut meshes = Vec::new();
    each_mesh(&scene, &file, loader, |mesh| meshes.push(mesh))?;
    let surroundings = surroundings(&scene.environment, &file, loader)?;
    let mut draws = Vec::new();
    for (object, mesh) in scene.objects.iter().zip(&meshes) {
        let own = shaders.iter().find(|s| s.objects.is_empty() || s.objects.contains(&object.name));
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
    let images = |path: &str, base: &str| image(loader, path, base);
    let job = Job {
        draws,
        camera: scene.camera.camera(),
        surroundings: Some(&surroundings).filter(|_| command.aov == Aov::Output(Output::Radiance)),
        size: command.size,
        samples: if command.samples == Samples::Four { 4 } else { 1 },
        time: 0.0,
        images: &images,
        output: if is_exr(command) { ColorFormat::Float } else { ColorFormat::Half },
    };
    let progress = late(context, "rendering", None);
    let result = draw(command, context, &job, gpu);
    progress.finish_and_clear();
    // A lost device is opened anew on the next run of --watch.
    result.inspect_err(|_| *gpu = None).map_err(failure)
}

/// Writes a picture in the form that its name asks for, with a note on how it was made.
pub(super) fn save(
    command: &Render,
    context: &Context,
    size: (u32, u32),
    pixels: &[[f32; 4]],
    tone: ToneCurve,
    (keyword, note): (&str, &str),
) -> Result<(), Failure> {
    let software = format!("shadetree {}", env!("CARGO_PKG_VERSION"));
    let notes = [("Software".to_owned(), software), (keyword.to_owned(), note.to_owned())];
    let bytes = if is_exr(command) {
        encode_exr(size, pixels, &notes)
    } else {
        encode_png(size, pixels, &Display { tone, ..Display::default() }, &notes)
    };
    let bytes = bytes.map_err(unwritable)?;
    output::write(&command.output, &bytes)?;
    context.detail(&format!("wrote {}", command.output.display()));
    Ok(())
}

fn is_exr(command: &Render) -> bool {
    command.output.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr"))
}

fn draw(command: &Render, context: &Context, job: &Job<'_>, gpu: &mut Option<Gpu>) -> Result<Drawn, RenderError> {
    let gpu = match gpu {
        Some(gpu) => gpu,
        None => gpu.insert(Gpu::new(&adapter_options(command.adapter.as_deref()))?),
    };
    if let Aov::Map(light) = &command.aov {
        let map = gpu.map(job, &full_name(job, light), 0)?;
        let adapter = gpu.adapter().name.clone();
        return Ok(Drawn { size: map.size, pixels: map.pixels, adapter, messages: map.messages, timings: Vec::new() });
    }
    let frame = gpu.render(job)?;
    frame.timing_table().iter().for_each(|line| context.detail(line));
    Ok(Drawn {
        size: frame.size,
        pixels: frame.pixels,
        adapter: frame.adapter.name,
        messages: frame.messages,
        timings: frame.timings,
    })
}

/// The name that plans have for a light that a person calls by all of it, by its graph, or by its node.
fn full_name(job: &Job<'_>, light: &str) -> String {
    let lights: BTreeSet<&str> =
        job.draws.iter().flat_map(|d| &d.shader.plan.lights).map(|l| l.name.as_str()).collect();
    let found = light_called(lights.iter().copied(), light);
    found.unwrap_or(light).to_owned()
}

/// The scene, the file that its paths count from, and a shader for each of its objects.
fn shaders(command: &Render, weaver: &Weaver<'_>) -> Result<(Scene, PathBuf, Vec<Shader>), Failure> {
    match weaver.read(&command.files)? {
        Input::Scene(scene, file) => {
            if command.scene.is_some() {
                return Err(Failure::usage("--scene is for graphs, but a scene was given", "leave --scene out"));
            }
            let shaders = weaver.weave_scene(&scene, &file)?;
            Ok((*scene, file, shaders))
        }
        Input::Graphs(graphs) => {
            let Some(file) = &command.scene else {
                return on_stage(graphs, weaver);
            };
            let document = weaver.loader.document(file)?;
            weaver.context.report(&weaver.loader.take_found());
            let scene = match document {
                Some(Document::Scene(scene)) => *scene,
                Some(Document::Graph(_)) => {
                    return Err(Failure::usage("--scene names a graph, not a scene", "name a `Scene(...)` file"));
                }
                None => return Err(Vec::new().into()),
            };
            let mut all = graphs;
            super::settings::apply(weaver.set, &mut all, weaver.catalog)?;
            // Graphs that are a whole shader bring their own light; others take those of the scene.
            let alone = weaver.try_weave(&all, Vec::new()).0;
            let shader = match alone {
                Some(shader) if !shader.compiled.plan.lights.is_empty() || scene.lights.is_empty() => shader,
                _ => {
                    let mut with_lights = weaver.lights(&scene, file)?;
                    with_lights.append(&mut all);
                    weaver.weave(&with_lights, Vec::new())?
                }
            };
            Ok((scene, file.clone(), vec![shader]))
        }
    }
}

/// Graphs on the stage. Those that bring no light get the stage's; then its other objects are seen by it, too.
fn on_stage(mut graphs: Vec<NamedGraph>, weaver: &Weaver<'_>) -> Result<(Scene, PathBuf, Vec<Shader>), Failure> {
    let (stage, found) = stage::read();
    weaver.context.report(&found);
    let stage = stage.ok_or_else(|| Failure::from(Vec::new()))?;
    super::settings::apply(weaver.set, &mut graphs, weaver.catalog)?;
    let (alone, found) = weaver.try_weave(&graphs, Vec::new());
    let shaders = match alone {
        Some(shader) if !shader.compiled.plan.lights.is_empty() => {
            weaver.context.report(&found);
            vec![shader]
        }
        _ => {
            let lit = |surface: Vec<NamedGraph>| stage.lights.iter().cloned().chain(surface).collect::<Vec<_>>();
            let (shown, mut found) = weaver.try_weave(&lit(graphs), vec![stage::SHOWN.to_owned()]);
            // A surface that takes no light has no use for the stage's, which nobody asked for.
            found.retain(|d| d.code != "ST0210");
            weaver.context.report(&found);
            let mut shaders = vec![shown.ok_or_else(|| Failure::from(Vec::new()))?];
            for (object, surface) in &stage.others {
                shaders.push(weaver.weave(&lit(vec![surface.clone()]), vec![object.clone()])?);
            }
            shaders
        }
    };
    Ok((stage.scene, "stage.ron".into(), shaders))
}

fn surroundings(of: &Environment, file: &Path, loader: &Loader) -> Result<Surroundings, Failure> {
    let image = environment_image(of, file, loader)?;
    let map = environment::Map::new(of, image.as_ref());
    let level = |l: environment::Level| SurroundingsLevel { width: l.width, height: l.height, pixels: l.pixels };
    let levels = map.levels.into_iter().map(level).collect();
    Ok(Surroundings { levels, irradiance: map.irradiance, background: true })
}

/// Decodes the image of a texture: a path as the graph gives it, relative to the file that mentions it.
fn image(loader: &Loader, path: &str, base: &str) -> Result<Picture, String> {
    let first = |f: Failure| f.diagnostics.first().map_or_else(String::new, |d| d.message.clone());
    let bytes = loader.bytes(&relative(path, base)).map_err(first)?;
    let decoded = picture(bytes)?.decode().map_err(|e| e.to_string())?;
    let (width, height) = (decoded.width(), decoded.height());
    let texels = match decoded {
        image::DynamicImage::ImageRgb32F(_) | image::DynamicImage::ImageRgba32F(_) => {
            Texels::Floats(decoded.into_rgba32f().pixels().map(|p| p.0).collect())
        }
        _ => Texels::Bytes(decoded.into_rgba8().pixels().map(|p| p.0).collect()),
    };
    Ok(Picture { width, height, texels })
}

/// A bar, or a spinner where it is not known how much there is to do, that appears when that takes longer than two
/// seconds.
pub(super) fn late(context: &Context, message: &'static str, steps: Option<u64>) -> ProgressBar {
    if !context.draws_progress() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(steps, ProgressDrawTarget::hidden()).with_message(message);
    // A template that cannot be read leaves the usual style.
    if steps.is_some()
        && let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {percent:>3}% {eta}")
    {
        bar.set_style(style);
    }
    let late = bar.downgrade();
    std::thread::spawn(move || {
        std::thread::sleep(Duration::from_secs(2));
        if let Some(bar) = late.upgrade().filter(|b| !b.is_finished()) {
            bar.set_draw_target(ProgressDrawTarget::stderr());
            bar.enable_steady_tick(Duration::from_millis(120));
        }
    });
    bar
}

/// A picture that cannot be written in the form that was asked for.
#[allow(clippy::needless_pass_by_value, reason = "for `map_err`")]
pub(super) fn unwritable(error: impl ToString) -> Failure {
    failure(RenderError::Job(error.to_string()))
}

pub(super) fn failure(error: RenderError) -> Failure {
    let (code, exit) = match &error {
        RenderError::NoAdapter { .. } | RenderError::NoDevice { .. } | RenderError::Unsupported(_) => {
            ("ST0513", Exit::NoAdapter)
        }
        RenderError::UnknownBackend(_) => ("ST0513", Exit::Usage),
        RenderError::DeviceLost(_) => ("ST0514", Exit::NoAdapter),
        RenderError::Job(message) if message.contains("has no map") => ("ST0512", Exit::Input),
        _ => ("ST0514", Exit::Input),
    };
    let diagnostic = Diagnostic::error(code, error.to_string(), Place::default());
    let help = error.help();
    Failure::new(exit, help.into_iter().fold(diagnostic, |d, h| d.help(h)))
}
