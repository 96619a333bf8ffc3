//! `edit`: the window.

use std::path::PathBuf;

use clap::Args;

use super::context::Context;
use super::exit::Outcome;

/// Open the node editor; also what `shadetree` does without a command
#[derive(Args, Debug, Default)]
#[command(after_help = "Examples:
  shadetree edit
  shadetree edit graphs/surfaces/bumpy_glass.ron
  shadetree edit graphs/scenes/car.ron
  shadetree edit --nodes my_nodes mine.ron")]
pub(super) struct Edit {
    /// Graph files to open, or a scene with its graphs
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Scene to show the graphs in
    #[arg(long, value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// Part of an adapter's name, or `cpu` for a software one; for the preview
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Folder with further nodes; may be given several times
    #[arg(long, value_name = "DIR")]
    nodes: Vec<PathBuf>,
}

impl Edit {
    #[cfg(not(feature = "gui"))]
    pub(super) fn run(&self, _: &Context) -> Outcome {
        let help = "build it with `--features gui`, which is the default";
        Err(super::exit::Failure::usage("this shadetree was built without the editor", help))
    }

    #[cfg(feature = "gui")]
    pub(super) fn run(&self, context: &Context) -> Outcome {
        use super::exit::{Exit, Failure};
        use crate::diagnostic::{Diagnostic, Place};

        let (catalog, found) = crate::studio::Loader::default().catalog(&self.nodes)?;
        context.report(&found);
        let options = crate::gui::Options {
            files: self.files.clone(),
            scene: self.scene.clone(),
            nodes: self.nodes.clone(),
            catalog,
            adapter: super::render::adapter_options(self.adapter.as_deref()),
            places: crate::gui::Places::of_system(),
            paused: false,
        };
        match crate::gui::run(options) {
            Ok(()) => Ok(Exit::Done),
            Err(error) => {
                let message = format!("the window cannot be opened: {error}");
                let help = "the editor needs a display, and Vulkan or another graphics system: on Debian and Ubuntu, \
                            `apt-get install mesa-vulkan-drivers libvulkan1`; the other commands need no display";
                Err(Failure::new(Exit::NoAdapter, Diagnostic::error("ST0513", message, Place::default()).help(help)))
            }
        }
    }
}
