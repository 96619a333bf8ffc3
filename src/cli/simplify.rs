//! `simplify`: a ladder of cheaper shaders for a material.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::context::Context;
use super::exit::Outcome;

/// Find cheaper shaders for a material: a ladder of levels of detail with what each costs and how far it is off
#[derive(Args, Debug)]
#[command(
    after_help = "The error is the RMSE of linear radiance over the mean radiance of the full material, where what is brighter than 99 of
100 values counts as just that bright.

Examples:
  shadetree simplify graphs/surfaces/rust.ron
  shadetree simplify graphs/surfaces/rust.ron -o lods --distance 4,16,64
  shadetree simplify graphs/lights/sun_pcf.ron graphs/surfaces/brick_wall.ron --max-error 0.05 --format json
  shadetree simplify marble.ron --scene graphs/scenes/car.ron --by time --rungs 2"
)]
pub(super) struct Simplify {
    /// Graph files, woven together by type: one has the surface; `-` is stdin
    #[arg(required = true, value_name = "GRAPH")]
    pub(super) files: Vec<PathBuf>,
    /// Scene that the graphs are shown in, rather than on a ball
    #[arg(long, value_name = "SCENE")]
    pub(super) scene: Option<PathBuf>,
    /// Folder for the rungs, as GRAPH.lod1.ron and so on; made if it is not there
    #[arg(short, long, value_name = "DIR")]
    pub(super) output: Option<PathBuf>,
    /// Largest error of a rung
    #[arg(long, default_value_t = 0.2, value_name = "E", value_parser = error)]
    pub(super) max_error: f64,
    /// Most rungs below the full material
    #[arg(long, default_value_t = 4, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=32))]
    pub(super) rungs: u16,
    /// Columns and rows of the pictures that are compared
    #[arg(long, default_value = "320x240", value_name = "WxH", value_parser = super::render::size)]
    pub(super) size: (u32, u32),
    /// Metres from the eye, one ladder each, rather than the scene's own
    #[arg(long, value_name = "D,...", value_delimiter = ',', value_parser = distance)]
    pub(super) distance: Vec<f64>,
    /// What is saved: counted operations and texture reads, the same on every machine; or time on this one
    #[arg(long, value_enum, default_value_t)]
    pub(super) by: By,
    /// Part of an adapter's name, or `cpu` for a software one
    #[arg(long, value_name = "NAME")]
    pub(super) adapter: Option<String>,
    /// Folder with further nodes; may be given several times
    #[arg(long, value_name = "DIR")]
    pub(super) nodes: Vec<PathBuf>,
}

/// What is saved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum By {
    #[default]
    Operations,
    Time,
}

fn error(text: &str) -> Result<f64, String> {
    let wrong = || "expected a number from 0 to 10, such as 0.1 for a tenth of the light".to_owned();
    text.parse::<f64>().ok().filter(|e| (0.0..=10.0).contains(e)).ok_or_else(wrong)
}

fn distance(text: &str) -> Result<f64, String> {
    let wrong = || "expected metres above 0, such as 4,16,64".to_owned();
    text.parse::<f64>().ok().filter(|d| (0.01..=100_000.0).contains(d)).ok_or_else(wrong)
}

impl Simplify {
    #[cfg(not(feature = "render"))]
    pub(super) fn run(&self, _: &Context) -> Outcome {
        Err(super::render::cannot_render())
    }

    #[cfg(feature = "render")]
    pub(super) fn run(&self, context: &Context) -> Outcome {
        super::ladder::run(self, context)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_mean_nothing_are_refused() {
        assert_eq!((error("0.25"), distance("16")), (Ok(0.25), Ok(16.0)));
        assert!(["-1", "nan", "x", "11", ""].iter().all(|t| error(t).is_err()));
        assert!(["0", "-4", "inf", "nan", ""].iter().all(|t| distance(t).is_err()));
    }
}
