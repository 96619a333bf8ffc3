//! The errors that can be charted.

use crate::reference::Metrics;

/// One of the errors of a cell.
#[derive(Clone, Copy, Debug)]
pub struct Metric {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it is, for an axis.
    pub label: &'static str,
    /// Its value, at least 0.
    pub of: fn(&Metrics) -> f64,
}

/// All of them.
pub const METRICS: &[Metric] = &[
    Metric { name: "rms", label: "RMS error of visibility", of: |m| m.rms },
    Metric { name: "bias", label: "mean error of visibility, without its sign", of: |m| m.bias.abs() },
    Metric { name: "most", label: "greatest error of visibility", of: |m| m.most },
    Metric { name: "percentile_99", label: "error of visibility, 99th percentile", of: |m| m.percentile_99 },
    Metric { name: "over_step", label: "share of pixels off by more than 1/255", of: |m| m.over_step },
    Metric { name: "over_twentieth", label: "share of pixels off by more than 0.05", of: |m| m.over_twentieth },
    Metric { name: "false_lit", label: "share of pixels too light by more than 0.05", of: |m| m.false_lit },
    Metric { name: "false_dark", label: "share of pixels too dark by more than 0.05", of: |m| m.false_dark },
];

/// The parts of the picture that errors are taken over.
pub const REGIONS: [&str; 5] = ["all", "penumbra", "umbra", "lit", "silhouette"];

impl Metric {
    /// The error of this name.
    pub fn named(name: &str) -> Option<Self> {
        METRICS.iter().find(|m| m.name == name).copied()
    }
}

/// Two metrics are the same if they go by the same name.
impl PartialEq for Metric {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}
