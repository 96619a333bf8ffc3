//! `fmt`: files in canonical form.

use std::path::{Path, PathBuf};

use clap::Args;

use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use super::output;
use crate::diagnostic::{Diagnostic, Place};
use crate::studio::load::{Document, Loader};
use crate::{graph, scene, study};

/// Write graph and scene files in canonical form
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  shadetree fmt graphs/lights/*.ron
  shadetree fmt --check graphs/lights/*.ron     # exit 1 if a file would change
  shadetree fmt - < a.ron                       # from stdin to stdout")]
pub(super) struct Fmt {
    /// Files to rewrite; `-` goes from stdin to stdout
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Change nothing, but say which files would change
    #[arg(long)]
    check: bool,
}

impl Fmt {
    pub(super) fn run(&self, context: &Context) -> Outcome {
        let mut exit = Exit::Done;
        for path in &self.files {
            // One bad file must not keep the others from being written.
            let result = self.one(context, path).unwrap_or_else(|failure| {
                context.report(&failure.diagnostics);
                failure.exit
            });
            // The gravest is the answer, whatever the order of the files.
            if result as u8 > exit as u8 {
                exit = result;
            }
        }
        Ok(exit)
    }

    fn one(&self, context: &Context, path: &Path) -> Outcome {
        let loader = Loader::default();
        let text = loader.text(path)?;
        let is_study = study::write::is_study(&text.text);
        let document = if is_study { None } else { loader.document_of(&text, path) };
        let failed = context.report(&loader.take_found());
        let failed = failed || is_study && context.report(&study::read::read(&text).1);
        // A file with errors is left alone: rewriting it could lose what was not understood.
        let canonical = match document {
            Some(Document::Graph(graph)) => Some(graph::write(&graph)),
            Some(Document::Scene(scene)) => Some(scene::write(&scene)),
            None => study::write::canonical(&text).filter(|_| is_study),
        };
        let Some(canonical) = canonical.filter(|_| !failed) else { return Ok(Exit::Input) };
        let same = canonical == text.text;
        if self.check {
            if same {
                return Ok(Exit::Done);
            }
            let place = Place::file(path.display().to_string());
            let diagnostic = Diagnostic::error("ST0518", "the file is not in canonical form", place);
            return Err(Failure::new(Exit::Input, diagnostic.help("run `shadetree fmt` on it")));
        }
        if output::is_dash(path) {
            output::print(canonical.as_bytes())?;
        } else if !same {
            output::write(path, canonical.as_bytes())?;
            context.detail(&format!("rewrote {}", path.display()));
        }
        Ok(Exit::Done)
    }
}
