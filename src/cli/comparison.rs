//! One row per kind of shadow: picture, visibility, error against the truth, and the figures.

use std::path::PathBuf;

use font8x8::legacy::BASIC_LEGACY;
use image::{Rgba, RgbaImage};
use serde_json::json;

use super::compare::Compare;
use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use super::load::{Document, Loader};
use super::output;
use super::picture::{Drawn, failure, late, pixels, unwritable};
use super::render::{Aov, Reference, Render, Samples, adapter_options};
use super::settings::{Assignment, Target};
use super::truth;
use crate::compile::Output;
use crate::diagnostic::{Diagnostic, Place};
use crate::node::Catalog;
use crate::reference::Metrics;
use crate::render::Gpu;
use crate::render::image_file::{Display, ToneCurve, encode_png};

/// Space around pictures, and the height of a line of text.
const GAP: u32 = 8;
const LINE: u32 = 16;
const INK: Rgba<u8> = Rgba([225, 225, 225, 255]);
const PAPER: Rgba<u8> = Rgba([24, 25, 28, 255]);

/// What one kind of shadow came to.
struct Row {
    kind: String,
    reference: &'static str,
    metrics: Metrics,
    /// Sum of all passes but the main one, and the main one, on the adapter.
    milliseconds: (Option<f64>, Option<f64>),
    pictures: Option<[RgbaImage; 3]>,
}

pub(super) fn run(command: &Compare, context: &Context) -> Outcome {
    let loader = Loader::default();
    let (catalog, found) = loader.catalog(&command.nodes)?;
    context.report(&found);
    let shadow = shadow_of(command, &loader, &catalog)?;
    let kinds = kinds(command, &catalog)?;
    let bar = late(context, "comparing", Some(kinds.len() as u64));
    let mut gpu = Gpu::new(&adapter_options(command.adapter.as_deref())).map_err(failure)?;
    // Every shadow pays for its own maps.
    gpu.keep_maps(0);
    let mut gpu = Some(gpu);
    let quiet = Context { quiet: true, ..*context };
    let visibility = Output::Visibility(command.light.clone());
    // Rays know nothing of a shadow, so that one picture of them serves all kinds.
    let mut by_rays: Option<Vec<[f32; 4]>> = None;
    let mut rows = Vec::new();
    let mut adapter = String::new();
    for kind in &kinds {
        let has_width = catalog.get(kind).and_then(|f| f.header().ok()).is_some_and(|h| {
            h.options.iter().any(|o| o.name == "width") && h.options.iter().any(|o| o.name == "weights")
        });
        let reference = command.reference.unwrap_or(if has_width { Reference::Pcf } else { Reference::Rays });
        let ask = |output: &Output| asked(command, &shadow, kind, output.clone());
        let seen = pixels(&ask(&visibility), &quiet, &loader, &mut gpu)?;
        let compute = || {
            let command = Render { reference: Some(reference), ..ask(&visibility) };
            truth::pixels(&command, &quiet, &loader).map(|(pixels, _)| pixels)
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
        let pairs = seen.pixels.iter().zip(truth).filter(|(a, b)| a[3] > 0.0 && b[3] > 0.0);
        let metrics = Metrics::new(pairs.map(|(a, b)| (f64::from(a[0]), f64::from(b[0]))));
        let pictures = match &command.output {
            Some(_) => {
                let lit = pixels(&ask(&Output::Radiance), &quiet, &loader, &mut gpu)?;
                Some([decoded(&lit, ToneCurve::Filmic)?, decoded(&seen, ToneCurve::None)?, error_map(&seen, truth)])
            }
            None => None,
        };
        adapter = seen.adapter.clone();
        let sum = |of: &dyn Fn(&str) -> bool| {
            seen.timings.iter().filter(|t| of(&t.name)).map(|t| t.milliseconds).sum::<Option<f64>>()
        };
        let milliseconds = (sum(&|name| name != "main"), sum(&|name| name == "main"));
        let reference = if reference == Reference::Pcf { "pcf" } else { "rays" };
        rows.push(Row { kind: kind.clone(), reference, metrics, milliseconds, pictures });
        bar.inc(1);
    }
    bar.finish_and_clear();
    output::print(if context.is_json() { listed(&rows, &adapter) } else { table(&rows, &adapter) }.as_bytes())?;
    if let Some(path) = &command.output {
        let mut bytes = std::io::Cursor::new(Vec::new());
        sheet(&rows, &adapter).write_to(&mut bytes, image::ImageFormat::Png).map_err(unwritable)?;
        output::write(path, bytes.get_ref())?;
    }
    Ok(Exit::Done)
}

/// The name of the only shadow of the light's graph.
fn shadow_of(command: &Compare, loader: &Loader, catalog: &Catalog) -> Result<String, Failure> {
    let fail = |message: String, help: &str| {
        Failure::from(vec![Diagnostic::error("ST0521", message, Place::default()).help(help)])
    };
    let Some(Document::Scene(scene)) = loader.document(&command.scene)? else {
        return Err(fail(
            format!("`{}` is not a scene that can be used", command.scene.display()),
            "see `shadetree check`",
        ));
    };
    let Some(light) = scene.lights.iter().find(|l| l.name == command.light) else {
        let names: Vec<&str> = scene.lights.iter().map(|l| l.name.as_str()).collect();
        let message = format!("the scene has no light `{}`", command.light);
        return Err(fail(message, &format!("its lights are {}", names.join(", "))));
    };
    let path = super::load::relative(&light.graph.path, &command.scene.display().to_string());
    let graph = loader.named_graph(&path, &light.name, light.graph.span.as_ref());
    let graph = graph.ok_or_else(|| Failure::from(loader.take_found()))?;
    let nodes = graph.graph.nodes.iter().filter(|(_, node)| is_shadow(catalog, &node.kind));
    let shadows: Vec<&String> = nodes.map(|(name, _)| name).collect();
    match shadows[..] {
        [shadow] => Ok(format!("{}/{shadow}", light.name)),
        _ => {
            let message = format!("the light `{}` has {} shadows", light.name, shadows.len());
            Err(fail(message, "compare a light whose graph has one shadow node"))
        }
    }
}

fn is_shadow(catalog: &Catalog, kind: &str) -> bool {
    catalog.get(kind).and_then(|f| f.header().ok()).is_some_and(|h| h.category == "shadow")
}

fn kinds(command: &Compare, catalog: &Catalog) -> Result<Vec<String>, Failure> {
    let all: Vec<&str> = catalog.kinds().filter(|kind| is_shadow(catalog, kind)).collect();
    if let Some(wrong) = command.only.iter().find(|kind| !all.contains(&kind.as_str())) {
        let message = format!("`{wrong}` is not a kind of shadow");
        return Err(Failure::usage(message, format!("kinds are {}", all.join(", "))));
    }
    let wanted = |kind: &&&str| command.only.is_empty() || command.only.iter().any(|only| only == *kind);
    Ok(all.iter().filter(wanted).map(|kind| (*kind).to_owned()).collect())
}

/// The `render` that shows one kind.
fn asked(command: &Compare, shadow: &str, kind: &str, output: Output) -> Render {
    let swap = Assignment { node: shadow.into(), name: "kind".into(), value: kind.into(), target: Target::Kind };
    Render {
        files: vec![command.scene.clone()],
        output: PathBuf::from("comparison.exr"),
        scene: None,
        size: command.size,
        samples: if output == Output::Radiance { Samples::Four } else { Samples::One },
        aov: Aov::Output(output),
        reference: None,
        reference_samples: None,
        kernel: None,
        set: command.set.clone(),
        option: Vec::new(),
        kind: vec![swap],
        adapter: command.adapter.clone(),
        nodes: command.nodes.clone(),
        watch: false,
    }
}

/// As a screen shows it.
fn decoded(drawn: &Drawn, tone: ToneCurve) -> Result<RgbaImage, Failure> {
    let display = Display { tone, ..Display::default() };
    let bytes = encode_png(drawn.size, &drawn.pixels, &display, &[]).map_err(unwritable)?;
    Ok(image::load_from_memory(&bytes).map_err(unwritable)?.into_rgba8())
}

/// White where right, red where too light, blue where too dark; full colour at a difference of a quarter.
fn error_map(seen: &Drawn, truth: &[[f32; 4]]) -> RgbaImage {
    let (width, height) = seen.size;
    RgbaImage::from_fn(width, height, |x, y| {
        let index = (y * width + x) as usize;
        let (a, b) = (seen.pixels[index], truth[index]);
        if a[3] <= 0.0 || b[3] <= 0.0 {
            return Rgba([60, 60, 60, 255]);
        }
        let difference = (a[0] - b[0]).clamp(-0.25, 0.25) * 4.0;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 255")]
        let rest = ((1.0 - difference.abs()) * 255.0).round() as u8;
        if difference > 0.0 { Rgba([255, rest, rest, 255]) } else { Rgba([rest, rest, 255, 255]) }
    })
}

fn table(rows: &[Row], adapter: &str) -> String {
    let wide = rows.iter().map(|r| r.kind.len()).max().unwrap_or(0);
    let mut text = format!(
        "{:wide$} {:>5} {:>8} {:>8} {:>7} {:>8} {:>10} {:>8} {:>8}\n",
        "shadow", "truth", "rms", "bias", "most", "too lit", "too dark", "maps ms", "main ms"
    );
    let time = |t: Option<f64>| t.map_or("-".to_owned(), |t| format!("{t:.2}"));
    for Row { kind, reference, metrics: m, milliseconds, .. } in rows {
        text += &format!(
            "{kind:wide$} {reference:>5} {:>8.4} {:>+8.4} {:>7.3} {:>7.2}% {:>9.2}% {:>8} {:>8}\n",
            m.rms,
            m.bias,
            m.most,
            m.false_lit * 100.0,
            m.false_dark * 100.0,
            time(milliseconds.0),
            time(milliseconds.1),
        );
    }
    text + &format!("one frame each on {adapter}; `too lit` and `too dark` count pixels off by more than 0.05\n")
}

fn listed(rows: &[Row], adapter: &str) -> String {
    let row = |r: &Row| {
        let m = &r.metrics;
        json!({
            "schema": 1, "shadow": r.kind, "reference": r.reference, "adapter": adapter, "pixels": m.pixels,
            "rms": m.rms, "bias": m.bias, "max": m.most, "p99": m.percentile_99, "over_1_255": m.over_step,
            "over_0.05": m.over_twentieth, "false_lit": m.false_lit, "false_dark": m.false_dark,
            "maps_ms": r.milliseconds.0, "main_ms": r.milliseconds.1,
        })
    };
    rows.iter().map(|r| format!("{}\n", row(r))).collect()
}

/// Two kinds beside each other, each with its three pictures under a line of text.
fn sheet(rows: &[Row], adapter: &str) -> RgbaImage {
    let size = rows.iter().find_map(|r| r.pictures.as_ref()).map_or((1, 1), |p| p[0].dimensions());
    let (cell_width, cell_height) = (3 * (size.0 + GAP) + GAP, size.1 + LINE + 2 * GAP);
    #[allow(clippy::cast_possible_truncation, reason = "a handful of rows")]
    let lines = rows.len().div_ceil(2) as u32;
    let mut sheet = RgbaImage::from_pixel(2 * cell_width, lines * cell_height + LINE + 2 * GAP, PAPER);
    let head =
        format!("picture, visibility, error (white right, red too light, blue too dark, full at 0.25)   {adapter}");
    write(&mut sheet, (GAP, GAP), &head);
    for (index, row) in (0..).zip(rows) {
        let at = (index % 2 * cell_width + GAP, index / 2 * cell_height + LINE + 2 * GAP);
        let label = format!(
            "{}  rms {:.4}  bias {:+.4}  against {}",
            row.kind, row.metrics.rms, row.metrics.bias, row.reference
        );
        write(&mut sheet, at, &label);
        for (i, picture) in (0..).zip(row.pictures.iter().flatten()) {
            let left = i64::from(at.0 + i * (size.0 + GAP));
            image::imageops::replace(&mut sheet, picture, left, i64::from(at.1 + LINE));
        }
    }
    sheet
}

/// A line of text in a font of 8 by 8 pixels.
fn write(sheet: &mut RgbaImage, (left, top): (u32, u32), text: &str) {
    for (i, letter) in (0..).zip(text.bytes()) {
        let glyph = BASIC_LEGACY.get(usize::from(letter)).copied().unwrap_or_default();
        for (y, bits) in (0..).zip(glyph) {
            for x in (0..8).filter(|x| bits >> x & 1 == 1) {
                if let Some(pixel) = sheet.get_pixel_mut_checked(left + i * 8 + x, top + y) {
                    *pixel = INK;
                }
            }
        }
    }
}
