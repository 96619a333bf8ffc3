//! The visibility of a light as it ought to be, in float64, without an adapter and without a shader.

use std::path::PathBuf;

use super::assets::each_mesh;
use super::failure::Failure;
use super::load::relative;
use super::settings;
use super::shot::{Subject, scene_of};
use super::stage;
use super::truth_light::{cut, filter, light};
use super::weave::{Input, Weaver};
use crate::compile::{NamedGraph, Output};
use crate::diagnostic::{Diagnostic, Place, SourceText};
use crate::graph;
use crate::reference::picture::{Method, Watch, points, visibility};
use crate::reference::{Body, Estimate, Filter, Point, World, rays};
use crate::scene::{Camera, FileReference, Scene};
use crate::weave::{is_light, weave};

/// Most pixels that the filter is tried on with half the fineness.
const MOST_TRIED: usize = 4096;

/// How the truth is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// Percentage-closer filtering of every texel of a finer map.
    Pcf,
    /// Rays to all parts of the light.
    Rays,
}

/// What is wanted of the truth. The light is that of the weaver's output, which must be its visibility.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// How it is found.
    pub reference: Reference,
    /// From where; none for the scene's own camera.
    pub camera: Option<Camera>,
    /// Columns and rows.
    pub size: (u32, u32),
    /// Rays a pixel (256 unless said, rounded up to whole groups), or fine texels along a texel of the map.
    pub samples: Option<u32>,
    /// Texels across the filter, rather than what the shadow says.
    pub kernel: Option<u32>,
}

/// The truth, pixel by pixel.
#[derive(Clone, Debug)]
pub struct Truth {
    /// Visibility (three times) and coverage, rows from the top.
    pub pixels: Vec<[f32; 4]>,
    /// How exact it is, in words.
    pub note: String,
}

/// Finds the truth. `watch` is told of two steps a pixel, and `more` of further ones.
pub fn find(
    subject: &Subject<'_>,
    wanted: &Wanted,
    weaver: &Weaver<'_>,
    watch: Watch<'_>,
    more: &dyn Fn(usize),
) -> Result<Truth, Failure> {
    let output = &weaver.options.output;
    if !matches!(output, Output::Visibility(_)) {
        return Err(Failure::usage("only of visibility the truth is known", "name a light"));
    }
    let (mut scene, file, graphs, stands) = read(subject, weaver)?;
    let (woven, found) = weave(&graphs, weaver.catalog, output);
    weaver.listener.found(&found);
    let woven = woven.ok_or_else(Failure::told)?;
    let mut meshes = Vec::new();
    each_mesh(&scene, &file, weaver.loader, |mesh| meshes.push(mesh))?;
    if stands {
        let shown = scene.objects.iter_mut().zip(&meshes).filter(|(o, _)| o.name == stage::SHOWN);
        shown.for_each(|(object, mesh)| stage::stand(object, mesh));
    }
    let bodies = scene.objects.iter().zip(&meshes).map(|(object, mesh)| Body {
        mesh,
        object_to_world: object.transform.matrix(),
        casts: object.casts,
        receives: object.receives,
    });
    let world = World::new(&bodies.collect::<Vec<_>>());
    let camera = wanted.camera.unwrap_or_else(|| scene.camera.camera());
    let mut light = light(&woven, &world)?;
    let filter = match wanted.reference {
        Reference::Pcf => Some(filter(&woven, wanted, weaver.listener)?),
        Reference::Rays => None,
    };
    if let Some(filter) = &filter
        && let Some(cut) = cut(&woven, filter.size)?
    {
        light = light.cut(&cut, &camera, wanted.size, &world);
    }
    let samples = wanted.samples.unwrap_or(256).next_multiple_of(rays::GROUPS);
    let method = filter.as_ref().map_or(Method::Rays(samples), Method::Filter);

    let pixels = wanted.size.0 as usize * wanted.size.1 as usize;
    let seen: Vec<(usize, Point)> = points(&world, &camera, wanted.size, watch)
        .ok_or_else(Failure::cancelled)?
        .into_iter()
        .enumerate()
        .filter_map(|(pixel, point)| Some((pixel, point?)))
        .collect();
    (watch.done)(pixels - seen.len());
    let of = |method, points: &[(usize, Point)]| {
        visibility(&world, &light, method, points, wanted.size.0, watch).ok_or_else(Failure::cancelled)
    };
    let found = of(method, &seen)?;
    let note = match &filter {
        Some(filter) => {
            let step = seen.len().div_ceil(MOST_TRIED).max(1);
            let tried: Vec<(usize, Point)> = seen.iter().step_by(step).copied().collect();
            more(tried.len());
            let half = Filter { factor: filter.factor / 2, ..filter.clone() };
            let coarse = of(Method::Filter(&half), &tried)?;
            let fine = found.iter().step_by(step);
            convergence(filter, &fine.zip(&coarse).map(|(a, b)| a.mean - b.mean).collect::<Vec<_>>())
        }
        None => error_of_rays(if light.source.is_sharp() { 1 } else { samples }, &found),
    };
    let mut picture = vec![[0.0; 4]; pixels];
    for ((pixel, _), Estimate { mean, .. }) in seen.iter().zip(&found) {
        #[allow(clippy::cast_possible_truncation, reason = "pictures hold f32")]
        let value = *mean as f32;
        picture[*pixel] = [value, value, value, 1.0];
    }
    Ok(Truth { pixels: picture, note })
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

/// The scene, the file that its paths count from, the graphs that its light is looked for in, and whether what is shown is
/// brought to the size of the stage. Surfaces of scenes are not read: they have no say in who stands in whose light.
fn read(subject: &Subject<'_>, weaver: &Weaver<'_>) -> Result<(Scene, PathBuf, Vec<NamedGraph>, bool), Failure> {
    let mut graphs = match weaver.read(subject.files)? {
        Input::Scene(scene, file) => {
            if subject.scene.is_some() {
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
                weaver.tell_found();
                settings::apply(&others, &mut surfaces, weaver.catalog)?;
            }
            lights.push(plain_surface());
            return Ok((*scene, file, lights, false));
        }
        Input::Graphs(graphs) => graphs,
    };
    let mut stage = None;
    if subject.scene.is_none() {
        let (read, found) = stage::read(subject.shape);
        weaver.listener.found(&found);
        stage = Some(read.ok_or_else(Failure::told)?);
    }
    let lights = stage.as_mut().map(|s| s.lights.as_mut_slice()).unwrap_or_default();
    settings::apply_on_stage(weaver.set, &mut graphs, lights, weaver.catalog)?;
    // Graphs that have a light bring their own; others take those of the scene.
    let alone = weave(&graphs, weaver.catalog, &Output::Depth).0;
    let lit = alone.is_some_and(|w| w.nodes.iter().any(|n| is_light(&n.definition)));
    if let Some(stage) = stage {
        let lights = stage.lights.into_iter().filter(|_| !lit);
        let stands = matches!(subject.shape, stage::Shown::Obj(_));
        return Ok((stage.scene, "stage.ron".into(), lights.chain(graphs).collect(), stands));
    }
    let Some(file) = subject.scene else { return Err(Failure::told()) };
    let scene = scene_of(file, weaver)?;
    let mut all = if lit { Vec::new() } else { weaver.lights(&scene, file)? };
    all.append(&mut graphs);
    Ok((scene, file.to_path_buf(), all, false))
}

/// Something for lights to shine on: without it they would be told that there is nothing.
pub(super) fn plain_surface() -> NamedGraph {
    let text = "Graph(version: 1, nodes: {\"surface\": (kind: \"lambert\")})";
    let (graph, _) = graph::read(&SourceText::new("surface.ron", text));
    NamedGraph { name: "any surface".into(), graph: graph.unwrap_or_default(), ..NamedGraph::default() }
}

/// A light of which there is no truth to be had.
pub(super) fn no_truth(message: String, help: &str, place: Place) -> Failure {
    vec![Diagnostic::error("ST0520", message, place).help(help)].into()
}
