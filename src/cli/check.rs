//! `check`: is everything in order?

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;

use super::context::Context;
use super::exit::{Exit, Outcome};
use super::output;
use super::watch::watch;
use crate::diagnostic::SourceText;
use crate::studio::assets;
use crate::studio::load::Loader;
use crate::studio::weave::{Input, Known, Weaver};
use crate::study;

/// Report every mistake in graphs, a scene or a study, without writing anything
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  shadetree check graphs/scenes/car.ron
  shadetree check spot_vsm.ron bumpy_glass.ron
  shadetree check --format json spot.ron matte.ron    # one JSON object a line on stderr")]
pub(super) struct Check {
    /// Graph files that are used together, one scene file, or one study; `-` is stdin
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Folder with further nodes; may be given several times
    #[arg(long, value_name = "DIR")]
    nodes: Vec<PathBuf>,
    /// Check again whenever a file changes
    #[arg(long)]
    watch: bool,
}

impl Check {
    pub(super) fn run(&self, context: &Context) -> Outcome {
        watch(context, self.watch, &self.files, |loader| self.once(context, loader))
    }

    fn once(&self, context: &Context, loader: &Loader) -> Outcome {
        let (catalog, found) = loader.catalog(&self.nodes)?;
        // Here the person asks about everything, so a broken node file counts.
        let mut broken = context.report(&found);
        let known = Known::default();
        let weaver = Weaver { images: true, ..Weaver::new(context, loader, &catalog, &known) };
        if let [file] = &self.files[..]
            && !output::is_dash(file)
        {
            let source = loader.text(file)?;
            if study::write::is_study(&source.text) {
                return check_study(&source, file, &weaver, broken, context);
            }
        }
        let shaders = match weaver.read(&self.files)? {
            Input::Graphs(graphs) => vec![weaver.weave_graphs(graphs)?],
            Input::Scene(scene, file) => {
                // Everything is looked at before giving up.
                let shaders = weaver.weave_scene(&scene, &file);
                let meshes = assets::each_mesh(&scene, &file, loader, drop);
                let surroundings = assets::environment_image(&scene.environment, &file, loader);
                for failure in [meshes.err(), surroundings.err()].into_iter().flatten() {
                    broken |= context.report(&failure.diagnostics);
                }
                shaders?
            }
        };
        if context.is_json() {
            let summary = serde_json::json!({ "schema": 1, "ok": !broken, "shaders": shaders.len() });
            output::print(format!("{summary}\n").as_bytes())?;
        }
        if broken {
            return Err(Vec::new().into());
        }
        context.say(&format!("no errors; {} shader{}", shaders.len(), if shaders.len() == 1 { "" } else { "s" }));
        Ok(Exit::Done)
    }
}

/// A study, and all that it names.
fn check_study(source: &Arc<SourceText>, file: &Path, weaver: &Weaver<'_>, broken: bool, context: &Context) -> Outcome {
    let (study, found) = study::read::read(source);
    let broken = context.report(&found) || broken;
    let Some(study) = study else { return Err(Vec::new().into()) };
    #[cfg(feature = "render")]
    study::check::is_whole(&study, file, weaver)?;
    // Without a renderer nothing could be measured, so what is measured is not looked for.
    #[cfg(not(feature = "render"))]
    let _ = (file, weaver);
    if broken {
        return Err(Vec::new().into());
    }
    if context.is_json() {
        let summary = serde_json::json!({ "schema": 1, "ok": true, "cases": study.cases.len() });
        output::print(format!("{summary}\n").as_bytes())?;
    }
    context.say(&format!("no errors; {} cases, {} methods", study.cases.len(), study.methods.len()));
    Ok(Exit::Done)
}
