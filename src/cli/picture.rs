//! One picture: shaders, the job, the file.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use super::output;
use super::render::{Aov, Render, Samples, adapter_options};
use crate::compile::{Options, Output};
use crate::render::image_file::{Display, ToneCurve, encode_exr, encode_png};
use crate::render::{ColorFormat, Frame, Gpu, RenderError};
use crate::studio::load::Loader;
use crate::studio::picture::{Aov as Shown, Exposure, draw};
use crate::studio::settings::overrides;
use crate::studio::stock::Stock;
use crate::studio::weave::{Known, Weaver};
use crate::studio::{self, Shot};

pub(super) fn once(command: &Render, context: &Context, loader: &Loader, gpu: &mut Option<Gpu>) -> Outcome {
    let drawn = pixels(command, context, loader, gpu)?;
    for message in &drawn.messages {
        context.say(message);
    }
    let tone = match command.aov {
        Aov::Output(Output::Radiance) => ToneCurve::Filmic,
        _ => ToneCurve::None,
    };
    save(command, context, drawn.size, &drawn.pixels, tone, ("Adapter", &drawn.adapter.name))?;
    Ok(Exit::Done)
}

/// Renders what a command asks for.
fn pixels(command: &Render, context: &Context, loader: &Loader, gpu: &mut Option<Gpu>) -> Result<Frame, Failure> {
    let (catalog, found) = loader.catalog(&command.nodes)?;
    context.report(&found);
    let mut options = Options::default();
    if let Aov::Output(output) = &command.aov {
        options.output = output.clone();
    }
    let set = overrides(&command.kind, &command.set, &command.option);
    let known = Known::default();
    let weaver = Weaver { options, set: &set, images: true, ..Weaver::new(context, loader, &catalog, &known) };
    let shot = Shot::new(&command.subject(), &weaver)?;
    let mut stock = Stock::default();
    let assets = stock.assets(&shot, loader)?;
    let exposure = Exposure {
        aov: match &command.aov {
            Aov::Output(output) => Shown::Output(output.clone()),
            Aov::Map(light) => Shown::Map(light.clone(), 0),
        },
        camera: None,
        size: command.size,
        samples: if command.samples == Samples::Four { 4 } else { 1 },
        time: 0.0,
        format: if is_exr(command) { ColorFormat::Float } else { ColorFormat::Half },
    };
    let progress = late(context, "rendering", None);
    let open = |gpu: &mut Option<Gpu>| -> Result<Frame, RenderError> {
        let gpu = match gpu {
            Some(gpu) => gpu,
            None => gpu.insert(Gpu::new(&adapter_options(command.adapter.as_deref()))?),
        };
        draw(&shot, &assets, &stock, loader, &exposure, gpu)
    };
    let result = open(gpu);
    progress.finish_and_clear();
    // A lost device is opened anew on the next run of --watch.
    let drawn = result.inspect_err(|_| *gpu = None).map_err(studio::Failure::from)?;
    if !drawn.timings.is_empty() {
        drawn.timing_table().iter().for_each(|line| context.detail(line));
    }
    Ok(drawn)
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
    studio::Failure::from(RenderError::Job(error.to_string())).into()
}
