//! `--reference`: the visibility of a light as it ought to be, in float64, without an adapter and without a shader.

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use super::assets::each_mesh;
use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use super::load::{Document, Loader, relative};
use super::picture::{late, save};
use super::render::{Aov, Reference, Render};
use super::settings::{self, overrides};
use super::stage;
use super::truth_light::{cut, filter, light};
use super::weave::{Input, Weaver};
use crate::compile::{NamedGraph, Options, Output};
use crate::diagnostic::{Diagnostic, Place, SourceText};
use crate::graph;
use crate::reference::picture::{Method, Watch, points, visibility};
use crate::reference::{Body, Estimate, Filter, Point, World, rays};
use crate::render::image_file::ToneCurve;
use crate::scene::{FileReference, Scene};
use crate::weave::{is_light, weave};

/// Most pixels that the filter is tried on with half the fineness.
const MOST_TRIED: usize = 4096;

pub(super) fn once(command: &Render, context: &Context, loader: &Loader) -> Outcome {
    let (picture, note) = pixels(command, context, loader)?;
    context.say(&note);
    save(command, context, command.size, &picture, ToneCurve::None, ("Reference", &note))?;
    Ok(Exit::Done)
}

/// Visibility (three times) and coverage of every pixel, and how exact it is, in words.
pub(super) fn pixels(command: &Render, context: &Context, loader: &Loader) -> Result<(Vec<[f32; 4]>, String), Failure> {
    let Aov::Output(output @ Output::Visibility(_)) = &command.aov else {
        let message = "--reference knows visibility alone";
        return Err(Failure::usage(message, "add --aov visibility:LIGHT with the name of a light"));
    };
    let (catalog, found) = loader.catalog(&command.nodes)?;
    context.report(&found);
    let set = overrides(&command.kind, &command.set, &command.option);
    let options = Options { output: output.clone(), ..Options::default() };
    let weaver = Weaver { context, loader, catalog: &catalog, options, set: &set, images: false };
    let (scene, file, graphs) = read(command, &weaver)?;
    let (woven, found) = weave(&graphs, &catalog, output);
    context.report(&found);
    let woven = woven.ok_or_else(|| Failure::from(Vec::new()))?;
    let mut meshes = Vec::new();
    each_mesh(&scene, &file, loader, |mesh| meshes.push(mesh))?;
    let bodies = scene.objects.iter().zip(&meshes).map(|(object, mesh)| Body {
        mesh,
        object_to_world: object.transform.matrix(),
        casts: object.casts,
        receives: object.receives,
    });
    let world = World::new(&bodies.collect::<Vec<_>>());
    let camera = scene.camera.camera();
    let mut light = light(&woven, &world)?;
    let filter = match command.reference {
        Some(Reference::Pcf) => Some(filter(&woven, command, context)?),
        _ => None,
    };
    if let Some(filter) = &filter
        && let Some(cut) = cut(&woven, filter.size)?
    {
        light = light.cut(&cut, &camera, command.size, &world);
    }
    let samples = command.reference_samples.unwrap_or(256).next_multiple_of(rays::GROUPS);
    let method = filter.as_ref().map_or(Method::Rays(samples), Method::Filter);

    let pixels = command.size.0 as usize * command.size.1 as usize;
    let progress = late(context, "computing the truth", Some(2 * pixels as u64));
    let cancel = AtomicBool::new(false);
    let watch = Watch { cancel: &cancel, done: &|count| progress.inc(count as u64) };
    let cancelled = || Failure::from(Vec::new());
    let seen: Vec<(usize, Point)> = points(&world, &camera, command.size, watch)
        .ok_or_else(cancelled)?
        .into_iter()
        .enumerate()
        .filter_map(|(pixel, point)| Some((pixel, point?)))
        .collect();
    progress.inc((pixels - seen.len()) as u64);
    let found = visibility(&world, &light, method, &seen, command.size.0, watch).ok_or_else(cancelled)?;
    let note = match &filter {
        Some(filter) => {
            let step = seen.len().div_ceil(MOST_TRIED).max(1);
            let tried: Vec<(usize, Point)> = seen.iter().step_by(step).copied().collect();
            progress.inc_length(tried.len() as u64);
            let half = Filter { factor: filter.factor / 2, ..filter.clone() };
            let coarse = visibility(&world, &light, Method::Filter(&half), &tried, command.size.0, watch)
                .ok_or_else(cancelled)?;
            let fine = found.iter().step_by(step);
            convergence(filter, &fine.zip(&coarse).map(|(a, b)| a.mean - b.mean).collect::<Vec<_>>())
        }
        None => error_of_rays(if light.source.is_sharp() { 1 } else { samples }, &found),
    };
    progress.finish_and_clear();
    let mut picture = vec![[0.0; 4]; pixels];
    for ((pixel, _), Estimate { mean, .. }) in seen.iter().zip(&found) {
        #[allow(clippy::cast_possible_truncation, reason = "pictures hold f32")]
        let value = *mean as f32;
        picture[*pixel] = [value, value, value, 1.0];
    }
    Ok((picture, note))
}

/// What the standard errors of so many rays a pixel say.
fn error_of_rays(samples: u32, found: &[Estimate]) -> String {
    let mean = found.iter().map(|e| e.error).sum::<f64>() / found.len().max(1) as f64;
    let most = found.iter().map(|e| e.error).fold(0.0, f64::max);
    let pixels = found.len();
    let rays = if samples == 1 {
        "one ray a pixel, as the light is a point".into()
    } else {
        format!("{samples} rays a pixel")
    };
    format!("{rays}: standard error {mean:.6} on average, {most:.6} at most, over {pixels} pixels")
}

/// What the difference to half the fineness says.
fn convergence(filter: &Filter, differences: &[f64]) -> String {
    let Filter { kernel, taps, size, factor } = filter;
    let rms = (differences.iter().map(|d| d * d).sum::<f64>() / differences.len().max(1) as f64).sqrt();
    let most = differences.iter().map(|d| d.abs()).fold(0.0, f64::max);
    format!(
        "{} texels of {size}, {} taps, each texel as {factor} x {factor}: half as fine differs by {rms:.6} (root of the \
         mean square), {most:.6} at most, over {} pixels",
        kernel.len(),
        format!("{taps:?}").to_lowercase(),
        differences.len()
    )
}

/// The scene, the file that its paths count from, and the graphs that its light is looked for in. Surfaces of scenes are
/// not read: they have no say in who stands in whose light.
fn read(command: &Render, weaver: &Weaver<'_>) -> Result<(Scene, PathBuf, Vec<NamedGraph>), Failure> {
    let mut graphs = match weaver.read(&command.files)? {
        Input::Scene(scene, file) => {
            if command.scene.is_some() {
                return Err(Failure::usage("--scene is for graphs, but a scene was given", "leave --scene out"));
            }
            let mut lights = weaver.lights(&scene, &file)?;
            let (own, others) = weaver.set.iter().cloned().partition::<Vec<_>, _>(|assignment| {
                let found = settings::apply(std::slice::from_ref(assignment), &mut lights, weaver.catalog);
                found.err().is_none_or(|failure| failure.diagnostics.iter().any(|d| d.code != "ST0511"))
            });
            settings::apply(&own, &mut lights, weaver.catalog)?;
            if !others.is_empty() {
                // Surfaces have no part in it, but a name that nothing has is a mistake.
                let path = |surface: &FileReference| relative(&surface.path, &file.display().to_string());
                let surfaces = scene.objects.iter().map(|o| (path(&o.surface), o.surface.span.as_ref()));
                let read = surfaces.map(|(path, span)| weaver.loader.named_graph(&path, "surface", span));
                let mut surfaces: Vec<NamedGraph> = read.flatten().collect();
                weaver.context.report(&weaver.loader.take_found());
                settings::apply(&others, &mut surfaces, weaver.catalog)?;
            }
            lights.push(plain_surface());
            return Ok((*scene, file, lights));
        }
        Input::Graphs(graphs) => graphs,
    };
    settings::apply(weaver.set, &mut graphs, weaver.catalog)?;
    // Graphs that have a light bring their own; others take those of the scene.
    let alone = weave(&graphs, weaver.catalog, &Output::Depth).0;
    let lit = alone.is_some_and(|w| w.nodes.iter().any(|n| is_light(&n.definition)));
    let Some(file) = &command.scene else {
        let (stage, found) = stage::read();
        weaver.context.report(&found);
        let stage = stage.ok_or_else(|| Failure::from(Vec::new()))?;
        let lights = stage.lights.into_iter().filter(|_| !lit);
        return Ok((stage.scene, "stage.ron".into(), lights.chain(graphs).collect()));
    };
    let document = weaver.loader.document(file)?;
    weaver.context.report(&weaver.loader.take_found());
    match document {
        Some(Document::Scene(scene)) => {
            let mut all = if lit { Vec::new() } else { weaver.lights(&scene, file)? };
            all.append(&mut graphs);
            Ok((*scene, file.clone(), all))
        }
        Some(Document::Graph(_)) => {
            Err(Failure::usage("--scene names a graph, not a scene", "name a `Scene(...)` file"))
        }
        None => Err(Vec::new().into()),
    }
}

/// Something for lights to shine on: without it they would be told that there is nothing.
fn plain_surface() -> NamedGraph {
    let text = "Graph(version: 1, nodes: {\"surface\": (kind: \"lambert\")})";
    let (graph, _) = graph::read(&SourceText::new("surface.ron", text));
    NamedGraph { name: "any surface".into(), graph: graph.unwrap_or_default(), ..NamedGraph::default() }
}

/// A light of which there is no truth to be had.
pub(super) fn no_truth(message: String, help: &str, place: Place) -> Failure {
    vec![Diagnostic::error("ST0520", message, place).help(help)].into()
}
