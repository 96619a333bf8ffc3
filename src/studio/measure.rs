//! Every kind of shadow on one light, each measured against the truth.

use std::sync::atomic::{AtomicBool, Ordering};

use super::failure::Failure;
use super::load::{Document, relative};
use super::picture::{Aov, Exposure, draw};
use super::settings::{Assignment, Target};
use super::shot::{Shot, Subject};
use super::stage;
use super::stock::Stock;
use super::truth::{self, Reference, Wanted};
use super::weave::{Input, Weaver};
use crate::compile::{NamedGraph, Options, Output};
use crate::diagnostic::{Diagnostic, Place};
use crate::node::Catalog;
use crate::reference::Metrics;
use crate::reference::picture::Watch;
use crate::render::{ColorFormat, Frame, Gpu};
use crate::scene::Camera;

/// What is compared.
#[derive(Clone, Debug)]
pub struct Comparison<'a> {
    /// The light, by its name in the scene or as plans have it.
    pub light: &'a str,
    /// Its only shadow: see [`shadow_of`].
    pub shadow: &'a str,
    /// Kinds of shadows, in the order in which they are tried.
    pub kinds: &'a [String],
    /// The truth; none for exhaustive filtering where a shadow says how wide its filter is, and rays elsewhere.
    pub reference: Option<Reference>,
    /// Rays a pixel, or fine texels along a texel of the map; none for the usual number.
    pub samples: Option<u32>,
    /// From where; none for the scene's own camera.
    pub camera: Option<Camera>,
    /// Columns and rows.
    pub size: (u32, u32),
    /// Whether pictures are made besides.
    pub pictures: bool,
}

/// What one kind of shadow came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Kind of the shadow node.
    pub kind: String,
    /// Root of the mean square error of visibility.
    pub rmse: f64,
    /// Time of all passes on the adapter; none where it cannot be measured.
    pub milliseconds: Option<f64>,
    /// Time of all passes but the main one.
    pub maps_milliseconds: Option<f64>,
    /// Time of the main pass.
    pub main_milliseconds: Option<f64>,
    /// What it was compared with.
    pub reference: Reference,
    /// All errors.
    pub metrics: Metrics,
    /// Where it ran.
    pub adapter: String,
}

/// A point with the pictures that it was found from.
#[derive(Debug)]
pub struct Measured<'a> {
    /// The figures.
    pub point: Point,
    /// Visibility as the shadow has it.
    pub seen: Frame,
    /// Visibility as it ought to be, rows from the top.
    pub truth: &'a [[f32; 4]],
    /// The picture, where it was asked for.
    pub lit: Option<Frame>,
}

/// Measures one kind after the other, and hands over each. Stops soon after `cancel` is set.
pub fn measure(
    subject: &Subject<'_>,
    comparison: &Comparison<'_>,
    weaver: &Weaver<'_>,
    gpu: &mut Gpu,
    cancel: &AtomicBool,
    mut each: impl FnMut(Measured<'_>),
) -> Result<(), Failure> {
    let visibility = Output::Visibility(comparison.light.to_owned());
    let mut stock = Stock::default();
    // Rays know nothing of a shadow, so that one picture of them serves all kinds.
    let mut by_rays: Option<Vec<[f32; 4]>> = None;
    for kind in comparison.kinds {
        if cancel.load(Ordering::Relaxed) {
            return Err(Failure::cancelled());
        }
        let swap = Assignment {
            node: comparison.shadow.to_owned(),
            name: "kind".into(),
            value: kind.clone(),
            target: Target::Kind,
        };
        let set: Vec<Assignment> = std::iter::once(swap).chain(weaver.set.iter().cloned()).collect();
        let as_output = |output: &Output| {
            let options = Options { output: output.clone(), ..weaver.options.clone() };
            Weaver { options, set: &set, ..*weaver }
        };
        let mut picture = |output: &Output, samples| -> Result<Frame, Failure> {
            let weaver = as_output(output);
            let shot = Shot::new(subject, &weaver)?;
            let assets = stock.assets(&shot, weaver.loader)?;
            let exposure = Exposure {
                aov: Aov::Output(output.clone()),
                camera: comparison.camera,
                size: comparison.size,
                samples,
                time: 0.0,
                format: ColorFormat::Float,
            };
            Ok(draw(&shot, &assets, &stock, weaver.loader, &exposure, gpu)?)
        };
        let reference = comparison.reference.unwrap_or_else(|| usual(weaver.catalog, kind));
        let seen = picture(&visibility, 1)?;
        let compute = || {
            let camera = comparison.camera;
            let wanted = Wanted { reference, camera, size: comparison.size, samples: comparison.samples, kernel: None };
            let watch = Watch { cancel, done: &|_| {} };
            truth::find(subject, &wanted, &as_output(&visibility), watch, &|_| {}).map(|t| t.pixels)
        };
        let filtered;
        let truth = match (reference, &mut by_rays) {
            (Reference::Pcf, _) => {
                filtered = compute()?;
                &filtered
            }
            (Reference::Rays, Some(known)) => known,
            (Reference::Rays, unknown) => unknown.insert(compute()?),
        };
        let lit = if comparison.pictures { Some(picture(&Output::Radiance, 4)?) } else { None };
        let point = point(kind, reference, &seen, truth);
        each(Measured { point, seen, truth, lit });
    }
    Ok(())
}

fn point(kind: &str, reference: Reference, seen: &Frame, truth: &[[f32; 4]]) -> Point {
    let metrics = compare(&seen.pixels, truth);
    let sum = |of: &dyn Fn(&str) -> bool| {
        seen.timings.iter().filter(|t| of(&t.name)).map(|t| t.milliseconds).sum::<Option<f64>>()
    };
    Point {
        kind: kind.to_owned(),
        rmse: metrics.rms,
        milliseconds: sum(&|_| true),
        maps_milliseconds: sum(&|name| name != "main"),
        main_milliseconds: sum(&|name| name == "main"),
        reference,
        metrics,
        adapter: seen.adapter.name.clone(),
    }
}

/// Errors over the pixels where both show something.
pub fn compare(seen: &[[f32; 4]], truth: &[[f32; 4]]) -> Metrics {
    let pairs = seen.iter().zip(truth).filter(|(a, b)| a[3] > 0.0 && b[3] > 0.0);
    Metrics::new(pairs.map(|(a, b)| (f64::from(a[0]), f64::from(b[0]))))
}

/// White where right, red where too light, blue where too dark; full colour at a difference of a quarter; grey where
/// nothing is seen. sRGB and coverage.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 255")]
pub fn error_map(seen: &[[f32; 4]], truth: &[[f32; 4]]) -> Vec<[u8; 4]> {
    let color = |(a, b): (&[f32; 4], &[f32; 4])| {
        if a[3] <= 0.0 || b[3] <= 0.0 {
            return [60, 60, 60, 255];
        }
        let difference = (a[0] - b[0]).clamp(-0.25, 0.25) * 4.0;
        let rest = ((1.0 - difference.abs()) * 255.0).round() as u8;
        if difference > 0.0 { [255, rest, rest, 255] } else { [rest, rest, 255, 255] }
    };
    seen.iter().zip(truth).map(color).collect()
}

/// Filtering for shadows that say how wide their filter is, else rays.
fn usual(catalog: &Catalog, kind: &str) -> Reference {
    let has_width = catalog
        .get(kind)
        .and_then(|f| f.header().ok())
        .is_some_and(|h| h.options.iter().any(|o| o.name == "width") && h.options.iter().any(|o| o.name == "weights"));
    if has_width { Reference::Pcf } else { Reference::Rays }
}

/// The name of the only shadow of the light's graph, with the graph's before it.
pub fn shadow_of(subject: &Subject<'_>, wanted: &str, weaver: &Weaver<'_>) -> Result<String, Failure> {
    let graph = graph_of(subject, wanted, weaver)?;
    let nodes = graph.graph.nodes.iter().filter(|(_, node)| is_shadow(weaver.catalog, &node.kind));
    let shadows: Vec<&String> = nodes.map(|(name, _)| name).collect();
    match shadows[..] {
        [shadow] => Ok(format!("{}/{shadow}", graph.name)),
        _ => {
            let message = format!("the light `{wanted}` has {} shadows", shadows.len());
            Err(fail(message, "compare a light whose graph has one shadow node"))
        }
    }
}

fn fail(message: String, help: &str) -> Failure {
    Failure::from(vec![Diagnostic::error("ST0521", message, Place::default()).help(help)])
}

/// The graph of a light.
pub fn graph_of(subject: &Subject<'_>, wanted: &str, weaver: &Weaver<'_>) -> Result<NamedGraph, Failure> {
    let is = |name: &str| wanted == name || wanted.strip_prefix(name).is_some_and(|rest| rest.starts_with('/'));
    let scene_file = match (subject.scene, subject.files) {
        (None, [only]) => only.as_path(),
        (Some(scene), _) => scene,
        (None, files) => files.first().map_or(std::path::Path::new(""), |f| f.as_path()),
    };
    let graph: NamedGraph = match weaver.loader.document(scene_file)? {
        Some(Document::Scene(scene)) => {
            let Some(light) = scene.lights.iter().find(|l| is(&l.name)) else {
                let names: Vec<&str> = scene.lights.iter().map(|l| l.name.as_str()).collect();
                let message = format!("the scene has no light `{wanted}`");
                return Err(fail(message, &format!("its lights are {}", names.join(", "))));
            };
            let path = relative(&light.graph.path, &scene_file.display().to_string());
            let graph = weaver.loader.named_graph(&path, &light.name, light.graph.span.as_ref());
            graph.ok_or_else(|| Failure::from(weaver.loader.take_found()))?
        }
        Some(Document::Graph(_)) if subject.scene.is_none() => {
            let Input::Graphs(graphs) = weaver.read(subject.files)? else { return Err(Failure::told()) };
            let alone = graphs.len() == 1;
            let lights = stage::read(subject.shape).0.map(|s| s.lights).unwrap_or_default();
            let has = |g: &NamedGraph| is(&g.name) || (alone && g.graph.nodes.contains_key(wanted));
            let found = graphs.into_iter().find(has).or_else(|| lights.into_iter().find(|g| is(&g.name)));
            found.ok_or_else(|| fail(format!("there is no light `{wanted}`"), "name a light that shines"))?
        }
        _ => {
            weaver.loader.take_found();
            let message = format!("`{}` is not a scene that can be used", scene_file.display());
            return Err(fail(message, "see `shadetree check`"));
        }
    };
    Ok(graph)
}

/// Whether nodes of this kind are shadows.
pub fn is_shadow(catalog: &Catalog, kind: &str) -> bool {
    catalog.get(kind).and_then(|f| f.header().ok()).is_some_and(|h| h.category == "shadow")
}

/// All kinds of shadows, in the order of their names.
pub fn shadow_kinds(catalog: &Catalog) -> Vec<String> {
    catalog.kinds().filter(|kind| is_shadow(catalog, kind)).map(str::to_owned).collect()
}
