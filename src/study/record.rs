//! What is written of one cell: one JSON object in one line.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::reference::Metrics;

/// Version of the records that are written. Others are not read.
pub const VERSION: u32 = 1;

/// One cell, measured.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// [`VERSION`].
    pub version: u32,
    /// Title of the study.
    pub study: String,
    /// Name of the cell, the same on every machine and in every run.
    pub cell: String,
    /// The scene and its light under the study's own name.
    pub case: String,
    /// Class of scenes that the case stands for (`one layer`, `contact`, ...): one panel of a chart.
    pub class: String,
    /// Scene file, as the study names it.
    pub scene: String,
    /// The light that is looked at.
    pub light: String,
    /// Method, as the study calls it: one curve of a chart.
    pub method: String,
    /// Kind of the shadow node.
    pub shadow: String,
    /// Everything that was set on the shadow node: ports and options by name.
    pub settings: BTreeMap<String, String>,
    /// Those of the settings that the study varies, in its order.
    pub varied: Vec<String>,
    /// Whether this is a plain shadow map that others are compared with; it was measured although nothing may have asked
    /// for it.
    pub baseline: bool,
    /// Columns and rows of the frame that was timed.
    pub frame: (u32, u32),
    /// Texels on a side of the map; none without a map.
    pub side: Option<u32>,
    /// Bits of a texel of the finished map, without depth buffers.
    pub bits: Option<u32>,
    /// Format of the finished map.
    pub format: Option<String>,
    /// Triangles of all that casts.
    pub triangles: usize,
    /// Times of each pass, in milliseconds on the adapter, in the order in which they run.
    pub passes: Vec<Series>,
    /// Time from the job to the finished frame, which stays on the device: milliseconds, round by round.
    pub wall: Vec<f64>,
    /// Time of all passes of the plain shadow map of the same case, frame and side, in the same rounds.
    pub plain: Vec<f64>,
    /// Errors by the name of the reference: `rays` or `pcf`.
    pub errors: BTreeMap<String, Errors>,
    /// Where pictures of it lie, below the folder of results: with `.visibility.png` and `.error.png` after it.
    pub pictures: Option<String>,
    /// The same of the truth, with the name of a reference and `.png` after it.
    pub truth_pictures: Option<String>,
    /// Where it ran.
    pub machine: Machine,
    /// Versions of what took part, by name.
    pub versions: BTreeMap<String, String>,
    /// What was done otherwise than asked.
    pub messages: Vec<String>,
    /// Why there are no figures, where there are none.
    pub failure: Option<String>,
}

/// What a pass is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// Draws casters as the light sees them.
    Light,
    /// Makes a map from a map: blurs, sums, mips.
    Filter,
    /// Draws the picture.
    #[default]
    Main,
}

/// One pass, round by round.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Name of the pass.
    pub name: String,
    /// What it is for.
    pub role: Role,
    /// Milliseconds, one number a round. Empty where the adapter cannot tell.
    pub milliseconds: Vec<f64>,
}

/// Errors of visibility against one reference.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// Columns and rows of the pictures that were compared.
    pub size: (u32, u32),
    /// How exact the truth is, in words.
    pub note: String,
    /// Metrics over `all` pixels, and over those that the truth calls `lit`, `umbra`, `penumbra` and `silhouette`.
    pub regions: BTreeMap<String, Metrics>,
}

/// Where a cell was measured.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Machine {
    /// Name of the adapter.
    pub adapter: String,
    /// Driver and its version.
    pub driver: String,
    /// Backend of wgpu.
    pub backend: String,
    /// Whether it computes on the CPU: its times say nothing about graphics cards.
    pub software: bool,
}

impl Record {
    /// Milliseconds of all passes of these roles, round by round; none where one of them is not known.
    pub fn time_of(&self, roles: &[Role]) -> Option<Vec<f64>> {
        let wanted: Vec<&Series> = self.passes.iter().filter(|p| roles.contains(&p.role)).collect();
        let rounds = wanted.iter().map(|p| p.milliseconds.len()).max().unwrap_or(0);
        if rounds == 0 || wanted.iter().any(|p| p.milliseconds.len() != rounds) {
            return None;
        }
        Some((0..rounds).map(|r| wanted.iter().map(|p| p.milliseconds[r]).sum()).collect())
    }

    /// Milliseconds of all passes, round by round.
    pub fn total(&self) -> Option<Vec<f64>> {
        self.time_of(&[Role::Light, Role::Filter, Role::Main])
    }

    /// Time of all passes beside that of the plain shadow map, round by round.
    pub fn ratios(&self) -> Option<Vec<f64>> {
        let total = self.total()?;
        (total.len() == self.plain.len() && self.plain.iter().all(|p| *p > 0.0))
            .then(|| total.iter().zip(&self.plain).map(|(t, p)| t / p).collect())
    }

    /// The error that is charted: over all pixels, of the reference of this name.
    pub fn error(&self, reference: &str) -> Option<&Metrics> {
        self.errors.get(reference)?.regions.get("all")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record() -> Record {
        let series =
            |role, milliseconds: &[f64]| Series { name: "x".into(), role, milliseconds: milliseconds.to_vec() };
        Record {
            version: VERSION,
            passes: vec![series(Role::Light, &[1.0, 2.0]), series(Role::Main, &[3.0, 5.0])],
            plain: vec![2.0, 3.5],
            errors: BTreeMap::from([("rays".into(), Errors::default())]),
            ..Record::default()
        }
    }

    #[test]
    fn times_are_summed_round_by_round() {
        let record = record();
        assert_eq!(record.total(), Some(vec![4.0, 7.0]));
        assert_eq!(record.ratios(), Some(vec![2.0, 2.0]));
        assert_eq!(record.time_of(&[Role::Filter]), None);
        let partial = Record { passes: vec![Series::default(), record.passes[0].clone()], ..record };
        assert_eq!(partial.total(), None);
    }

    #[test]
    fn what_is_written_is_read_again() {
        let text = serde_json::to_string(&record()).expect("JSON");
        assert!(!text.contains('\n'));
        assert_eq!(serde_json::from_str::<Record>(&text).expect("a record"), record());
    }
}
