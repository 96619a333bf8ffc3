//! `compare`: every shadow on one light of a scene, next to the truth.

use std::path::PathBuf;

use clap::Args;

use super::context::Context;
use super::exit::{Failure, Outcome};
use super::render::{Reference, size};
use crate::studio::settings::Assignment;

/// Try every kind of shadow on a light of a scene, and measure each against the truth
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  shadetree compare graphs/scenes/car.ron --light spot
  shadetree compare graphs/scenes/car.ron --light spot -o sheet.png --size 320x180
  shadetree compare graphs/scenes/car.ron --light spot --only hard_shadow,pcf_shadow --format json")]
pub(super) struct Compare {
    /// Scene file
    #[arg(value_name = "SCENE")]
    pub(super) scene: PathBuf,
    /// Light of the scene; the graph behind it must have one shadow
    #[arg(long, value_name = "LIGHT")]
    pub(super) light: String,
    /// Contact sheet to write (.png): the picture, the visibility, and its error (red too light, blue too dark)
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: Option<PathBuf>,
    /// Kinds of shadows to try, instead of all
    #[arg(long, value_name = "KIND,...", value_delimiter = ',')]
    pub(super) only: Vec<String>,
    /// The truth: exhaustive filtering with the shadow's own kernel, or rays; by default rays for shadows without `width`
    #[arg(long, value_enum)]
    pub(super) reference: Option<Reference>,
    /// Columns and rows of each picture
    #[arg(long, default_value = "320x180", value_name = "WxH", value_parser = size)]
    pub(super) size: (u32, u32),
    /// Give a port another value
    #[arg(long, value_name = "NODE.PORT=VALUE")]
    pub(super) set: Vec<Assignment>,
    /// Part of an adapter's name, or `cpu` for a software one
    #[arg(long, value_name = "NAME")]
    pub(super) adapter: Option<String>,
    /// Folder with further nodes; may be given several times
    #[arg(long, value_name = "DIR")]
    pub(super) nodes: Vec<PathBuf>,
}

impl Compare {
    pub(super) fn run(&self, context: &Context) -> Outcome {
        let png = |path: &PathBuf| path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
        if let Some(path) = self.output.as_ref().filter(|p| !png(p)) {
            let message = format!("`{}` is not a .png", path.display());
            return Err(Failure::usage(message, "contact sheets are PNG files"));
        }
        self.start(context)
    }

    #[cfg(not(feature = "render"))]
    fn start(&self, _: &Context) -> Outcome {
        Err(super::render::cannot_render())
    }

    #[cfg(feature = "render")]
    fn start(&self, context: &Context) -> Outcome {
        super::comparison::run(self, context)
    }
}
