//! One row per kind of shadow: picture, visibility, error against the truth, and the figures.

use std::sync::atomic::AtomicBool;

use font8x8::legacy::BASIC_LEGACY;
use image::{Rgba, RgbaImage};
use serde_json::json;

use super::compare::Compare;
use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use super::output;
use super::picture::{late, unwritable};
use super::render::adapter_options;
use crate::diagnostic::{Diagnostic, Place};
use crate::node::Catalog;
use crate::render::image_file::{Display, ToneCurve, encode_png};
use crate::render::{Frame, Gpu};
use crate::studio::load::{Document, Loader};
use crate::studio::measure::{Comparison, Point, error_map, measure, shadow_kinds, shadow_of};
use crate::studio::truth::Reference;
use crate::studio::weave::{Known, Weaver};
use crate::studio::{self, Shown, Subject};

/// Space around pictures, and the height of a line of text.
const GAP: u32 = 8;
const LINE: u32 = 16;
const INK: Rgba<u8> = Rgba([225, 225, 225, 255]);
const PAPER: Rgba<u8> = Rgba([24, 25, 28, 255]);

/// What one kind of shadow came to, with its pictures.
struct Row {
    point: Point,
    pictures: Option<[RgbaImage; 3]>,
}

pub(super) fn run(command: &Compare, context: &Context) -> Outcome {
    let loader = Loader::default();
    let (catalog, found) = loader.catalog(&command.nodes)?;
    context.report(&found);
    // Graphs on the stage are for those who look at them while they edit.
    if !matches!(loader.document(&command.scene)?, Some(Document::Scene(_))) {
        let message = format!("`{}` is not a scene that can be used", command.scene.display());
        let error = Diagnostic::error("ST0521", message, Place::default());
        return Err(vec![error.help("see `shadetree check`")].into());
    }
    loader.take_found();
    let files = [command.scene.clone()];
    let subject = Subject { files: &files, scene: None, shape: &Shown::Sphere };
    let quiet = Context { quiet: true, ..*context };
    let known = Known::default();
    let weaver = Weaver { set: &command.set, ..Weaver::new(&quiet, &loader, &catalog, &known) };
    let shadow = shadow_of(&subject, &command.light, &weaver)?;
    let kinds = kinds(command, &catalog)?;
    let comparison = Comparison {
        light: &command.light,
        shadow: &shadow,
        kinds: &kinds,
        reference: command.reference.map(Reference::from),
        samples: None,
        camera: None,
        size: command.size,
        pictures: command.output.is_some(),
    };
    let bar = late(context, "comparing", Some(kinds.len() as u64));
    let mut gpu = Gpu::new(&adapter_options(command.adapter.as_deref())).map_err(studio::Failure::from)?;
    // Every shadow pays for its own maps.
    gpu.keep_maps(0);
    let cancel = AtomicBool::new(false);
    let mut measured = Vec::new();
    measure(&subject, &comparison, &weaver, &mut gpu, &cancel, |row| {
        let errors = row.lit.is_some().then(|| error_picture(&row.seen, row.truth));
        measured.push((row.point, row.lit, row.seen, errors));
        bar.inc(1);
    })?;
    let mut rows = Vec::new();
    for (point, lit, seen, errors) in measured {
        let pictures = match (lit, errors) {
            (Some(lit), Some(errors)) => {
                Some([decoded(&lit, ToneCurve::Filmic)?, decoded(&seen, ToneCurve::None)?, errors])
            }
            _ => None,
        };
        rows.push(Row { point, pictures });
    }
    bar.finish_and_clear();
    let adapter = rows.last().map(|r| r.point.adapter.clone()).unwrap_or_default();
    output::print(if context.is_json() { listed(&rows, &adapter) } else { table(&rows, &adapter) }.as_bytes())?;
    if let Some(path) = &command.output {
        let mut bytes = std::io::Cursor::new(Vec::new());
        sheet(&rows, &adapter).write_to(&mut bytes, image::ImageFormat::Png).map_err(unwritable)?;
        output::write(path, bytes.get_ref())?;
    }
    Ok(Exit::Done)
}

fn kinds(command: &Compare, catalog: &Catalog) -> Result<Vec<String>, Failure> {
    let all = shadow_kinds(catalog);
    if let Some(wrong) = command.only.iter().find(|kind| !all.contains(kind)) {
        let message = format!("`{wrong}` is not a kind of shadow");
        return Err(Failure::usage(message, format!("kinds are {}", all.join(", "))));
    }
    let wanted = |kind: &String| command.only.is_empty() || command.only.contains(kind);
    Ok(all.into_iter().filter(wanted).collect())
}

fn name(reference: Reference) -> &'static str {
    if reference == Reference::Pcf { "pcf" } else { "rays" }
}

/// As a screen shows it.
fn decoded(drawn: &Frame, tone: ToneCurve) -> Result<RgbaImage, Failure> {
    let display = Display { tone, ..Display::default() };
    let bytes = encode_png(drawn.size, &drawn.pixels, &display, &[]).map_err(unwritable)?;
    Ok(image::load_from_memory(&bytes).map_err(unwritable)?.into_rgba8())
}

fn error_picture(seen: &Frame, truth: &[[f32; 4]]) -> RgbaImage {
    let colors = error_map(&seen.pixels, truth);
    RgbaImage::from_fn(seen.size.0, seen.size.1, |x, y| Rgba(colors[(y * seen.size.0 + x) as usize]))
}

fn table(rows: &[Row], adapter: &str) -> String {
    let wide = rows.iter().map(|r| r.point.kind.len()).max().unwrap_or(0);
    let mut text = format!(
        "{:wide$} {:>5} {:>8} {:>8} {:>7} {:>8} {:>10} {:>8} {:>8}\n",
        "shadow", "truth", "rms", "bias", "most", "too lit", "too dark", "maps ms", "main ms"
    );
    let time = |t: Option<f64>| t.map_or("-".to_owned(), |t| format!("{t:.2}"));
    for Row { point, .. } in rows {
        let (kind, reference, m) = (&point.kind, name(point.reference), &point.metrics);
        text += &format!(
            "{kind:wide$} {reference:>5} {:>8.4} {:>+8.4} {:>7.3} {:>7.2}% {:>9.2}% {:>8} {:>8}\n",
            m.rms,
            m.bias,
            m.most,
            m.false_lit * 100.0,
            m.false_dark * 100.0,
            time(point.maps_milliseconds),
            time(point.main_milliseconds),
        );
    }
    text + &format!("one frame each on {adapter}; `too lit` and `too dark` count pixels off by more than 0.05\n")
}

fn listed(rows: &[Row], adapter: &str) -> String {
    let row = |r: &Row| {
        let r = &r.point;
        let m = &r.metrics;
        json!({
            "schema": 1, "shadow": r.kind, "reference": name(r.reference), "adapter": adapter, "pixels": m.pixels,
            "rms": m.rms, "bias": m.bias, "max": m.most, "p99": m.percentile_99, "over_1_255": m.over_step,
            "over_0.05": m.over_twentieth, "false_lit": m.false_lit, "false_dark": m.false_dark,
            "maps_ms": r.maps_milliseconds, "main_ms": r.main_milliseconds,
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
            row.point.kind,
            row.point.metrics.rms,
            row.point.metrics.bias,
            name(row.point.reference)
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
