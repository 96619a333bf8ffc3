//! `new`: a graph to start from.

use std::path::Path;

use clap::Args;

use super::context::Context;
use super::exit::{Failure, Outcome};
use super::{Exit, output};
use crate::diagnostic::{Diagnostic, Place};

/// A light with a shadow on a matte surface: the smallest whole shader.
const STARTER: &str = include_str!("starter.ron");

/// Write a starter graph
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  shadetree new glow           # writes glow.ron
  shadetree new glow && shadetree render glow.ron -o glow.png")]
pub(super) struct New {
    /// Name of the graph; `.ron` is added to the file
    name: String,
}

impl New {
    pub(super) fn run(&self, context: &Context) -> Outcome {
        let stem = self.name.strip_suffix(".ron").unwrap_or(&self.name);
        let title = Path::new(stem).file_name().map(|n| n.to_string_lossy().into_owned());
        let Some(title) = title.filter(|t| !t.starts_with('-')) else {
            return Err(Failure::usage(format!("`{}` cannot name a file", self.name), "choose a plain name"));
        };
        let file = format!("{stem}.ron");
        let path = Path::new(&file);
        if path.symlink_metadata().is_ok() {
            let diagnostic = Diagnostic::error("ST0509", "the file exists and is not overwritten", Place::file(&*file));
            return Err(Failure::new(Exit::Io, diagnostic.help("choose another name, or remove the file first")));
        }
        let text = STARTER.replace("\"starter\"", &crate::ron::text(&title));
        output::write(path, text.as_bytes())?;
        context.say(&format!("wrote {file}; see it with: shadetree render {file} -o {stem}.png"));
        Ok(Exit::Done)
    }
}
