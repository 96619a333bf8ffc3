//! `--reference`: the visibility of a light as it ought to be, without an adapter.

use std::sync::atomic::AtomicBool;

use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use super::picture::{late, save};
use super::render::{Aov, Render};
use crate::compile::{Options, Output};
use crate::reference::picture::Watch;
use crate::render::image_file::ToneCurve;
use crate::studio::load::Loader;
use crate::studio::settings::overrides;
use crate::studio::truth::{Reference, Wanted, find};
use crate::studio::weave::{Known, Weaver};

pub(super) fn once(command: &Render, context: &Context, loader: &Loader) -> Outcome {
    let Aov::Output(output @ Output::Visibility(_)) = &command.aov else {
        let message = "--reference knows visibility alone";
        return Err(Failure::usage(message, "add --aov visibility:LIGHT with the name of a light"));
    };
    let (catalog, found) = loader.catalog(&command.nodes)?;
    context.report(&found);
    let set = overrides(&command.kind, &command.set, &command.option);
    let options = Options { output: output.clone(), ..Options::default() };
    let known = Known::default();
    let weaver = Weaver { options, set: &set, ..Weaver::new(context, loader, &catalog, &known) };
    let wanted = Wanted {
        reference: command.reference.map_or(Reference::Rays, Reference::from),
        camera: None,
        size: command.size,
        samples: command.reference_samples,
        kernel: command.kernel,
    };
    let pixels = u64::from(command.size.0) * u64::from(command.size.1);
    let progress = late(context, "computing the truth", Some(2 * pixels));
    let cancel = AtomicBool::new(false);
    let watch = Watch { cancel: &cancel, done: &|count| progress.inc(count as u64) };
    let truth = find(&command.subject(), &wanted, &weaver, watch, &|count| progress.inc_length(count as u64))?;
    progress.finish_and_clear();
    context.say(&truth.note);
    save(command, context, command.size, &truth.pixels, ToneCurve::None, ("Reference", &truth.note))?;
    Ok(Exit::Done)
}
