//! `choose`: the cheapest shadow that a scene's lights can do with.

use std::path::PathBuf;

use clap::Args;

use super::context::Context;
use super::exit::Outcome;
use super::render::size;
use crate::choose::Metric;
use crate::studio::settings::Assignment;

/// Choose the cheapest shadow for each light of a scene that keeps to an error bound
///
/// From the scene alone: what the light and the camera see is looked at by rays, every kind of shadow is judged with each
/// of its settings by its closed form, and priced by constants of this device. The plan goes to stdout.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  shadetree choose graphs/scenes/car.ron --max-error 0.05 --explain
  shadetree choose graphs/scenes/car.ron --max-error 0.05 --verify -o chosen.ron
  shadetree choose graphs/scenes/three_lights.ron --max-error 0.03 -o chosen/
  shadetree choose graphs/scenes/planar.ron --light sun --max-error 0.02 --search --format json")]
pub(super) struct Choose {
    /// Scene file
    #[arg(value_name = "SCENE")]
    pub(super) scene: PathBuf,
    /// Greatest error of visibility, against rays to the whole light, over what the camera sees
    #[arg(long, value_name = "E", value_parser = positive)]
    pub(super) max_error: f64,
    /// Most milliseconds of all passes of the light's visibility
    #[arg(long, value_name = "T", value_parser = positive)]
    pub(super) budget_ms: Option<f64>,
    /// What error is: rms, percentile_99, most, or over_twentieth (the share of pixels off by more than 0.05)
    #[arg(long, default_value = "rms", value_name = "METRIC", value_parser = metric)]
    pub(super) metric: Metric,
    /// Only this light of the scene
    #[arg(long, value_name = "LIGHT")]
    pub(super) light: Option<String>,
    /// Say why, decision by decision
    #[arg(long)]
    pub(super) explain: bool,
    /// Render the choice and compare it with the truth, and so what may be cheaper or, where the bound does not hold, better
    #[arg(long)]
    pub(super) verify: bool,
    /// Measure what the bounds cannot separate, choose from what was measured, and show the Pareto front
    #[arg(long)]
    pub(super) search: bool,
    /// Light graph (.ron) to write where one light is chosen for, or a folder for all lights and their scene
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: Option<PathBuf>,
    /// Columns and rows of the picture that is chosen for
    #[arg(long, default_value = "320x180", value_name = "WxH", value_parser = size)]
    pub(super) size: (u32, u32),
    /// Give a port another value
    #[arg(long, value_name = "NODE.PORT=VALUE")]
    pub(super) set: Vec<Assignment>,
    /// Constants of a device as JSON, instead of those measured on this one
    #[arg(long, value_name = "FILE")]
    pub(super) costs: Option<PathBuf>,
    /// Measure the constants of this device again
    #[arg(long, conflicts_with = "costs")]
    pub(super) calibrate: bool,
    /// Part of an adapter's name, or `cpu` for a software one
    #[arg(long, value_name = "NAME")]
    pub(super) adapter: Option<String>,
    /// Folder with further nodes; may be given several times
    #[arg(long, value_name = "DIR")]
    pub(super) nodes: Vec<PathBuf>,
}

/// A number above zero.
fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err("expected a number above 0, as in 0.05".into()),
    }
}

fn metric(text: &str) -> Result<Metric, String> {
    let names: Vec<&str> = Metric::ALL.iter().map(|(name, _)| *name).collect();
    let found = Metric::ALL.iter().find(|(name, _)| *name == text).map(|(_, metric)| *metric);
    found.ok_or_else(|| format!("metrics are {}", names.join(", ")))
}

impl Choose {
    #[cfg(not(feature = "render"))]
    pub(super) fn run(&self, _: &Context) -> Outcome {
        Err(super::render::cannot_render())
    }

    #[cfg(feature = "render")]
    pub(super) fn run(&self, context: &Context) -> Outcome {
        super::choice::run(self, context)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_numbers_above_zero() {
        assert_eq!(positive("0.05"), Ok(0.05));
        assert!(["0", "-1", "NaN", "inf", "x", ""].iter().all(|t| positive(t).is_err()));
        assert!(metric("rms").is_ok() && metric("best").is_err());
    }
}
