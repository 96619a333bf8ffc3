//! What the source papers claim, held against measurements: `tests/stability/CLAIMS.md` is written and kept true here.

use std::fmt::Write as _;

use super::table::{Bound, figure};
use crate::stage::gpu;
use crate::support::{expect_file, root};

mod costs;
mod filters;
mod storage;

/// A measurement that speaks for a claim, or shows its limit.
pub(super) struct Evidence {
    what: String,
    measured: f64,
    bound: Bound,
    /// Depends on a clock: only whether the bound holds is worth reporting.
    timed: bool,
    /// What was found when the report was last written, for what depends on a clock: a busy machine changes no report.
    recorded: Option<bool>,
}

impl Evidence {
    fn holds(&self) -> bool {
        self.recorded.unwrap_or_else(|| self.bound.holds(self.measured))
    }
}

pub(super) fn shows(what: impl Into<String>, measured: f64, bound: Bound) -> Evidence {
    Evidence { what: what.into(), measured, bound, timed: false, recorded: None }
}

pub(super) fn timed(what: impl Into<String>, measured: f64, bound: Bound) -> Evidence {
    Evidence { what: what.into(), measured, bound, timed: true, recorded: None }
}

pub(super) struct Claim {
    pub(super) id: u32,
    /// The source, by its short name in the report.
    pub(super) source: &'static str,
    pub(super) says: &'static str,
    /// All of it must hold for the claim to be true.
    pub(super) holds: Vec<Evidence>,
    /// What limits it: one that holds is enough.
    pub(super) limits: Vec<Evidence>,
}

impl Claim {
    fn verdict(&self) -> &'static str {
        let limited = self.limits.iter().any(Evidence::holds);
        match (self.holds.iter().all(Evidence::holds), limited) {
            (true, false) => "confirmed",
            (true, true) => "true, with a limit",
            (false, _) => "refuted",
        }
    }

    fn text(&self) -> String {
        let mut text = format!("\n## C{} {} ({}): {}\n\n", self.id, self.says, self.source, self.verdict());
        for (role, all) in [("", &self.holds), ("limit: ", &self.limits)] {
            for evidence in all {
                let Evidence { what, measured, bound, timed, .. } = evidence;
                let found = match (timed, evidence.holds()) {
                    (false, _) => figure(*measured),
                    (true, true) => "yes".into(),
                    (true, false) => "no".into(),
                };
                let _ = writeln!(text, "* {role}{what} | {found} | {}", bound.text());
            }
        }
        text
    }
}

const HEAD: &str = "# What the source papers claim, and what is measured\n\n\
Written by `cargo test --test all claims` with `BLESS=1`; the same test fails when a figure or a verdict changes. Every\n\
line is a measurement on woven modules and the bound that it is held against; for what a clock says, only whether the\n\
bound held when this was written. A claim is confirmed if all its lines hold, true with a limit if a line shows one, and refuted if a line\n\
fails. Figures and verdicts are those of lavapipe, a software adapter: costs (C4, C9 to C11, C22) may differ elsewhere.\n\n\
Sources: VSM is Donnelly and Lauritzen, Variance Shadow Maps (2006); PSVSM Lauritzen's poster, Parallel-Split Variance\n\
Shadow Maps (2007); note a note on PCF, VSM, PSVSM and SATVSM; Unity a report on variance and exponential shadow maps in\n\
a production; blog notes on an implementation (2011).\n";

const SLIPS: &str = "\n## Slips of the sources\n\n\
* VSM 5.1 calls p_max a lower bound on brightness. It is an upper bound on the lit share (C2).\n\
* VSM 3 words P(x >= t) as the share of the filter that fails the comparison. It is the share that passes: the lit one.\n\
* PSVSM calls p(t) the probability of being in shadow. It is that of being lit.\n\
* The note says that percentage-closer filtering averages depths. It averages results of comparisons.\n\
* The note says that the bound is close to 1 where the gap is large. It is only as the spread of the occluders grows over\n  their distance to the receiver, and then as (r / (r + 2))^2: C7.\n\
* VSM's file ends with captions of another paper, on shade trees. They say nothing about shadows.\n";

#[test]
fn claims_of_the_sources_are_what_the_report_says() {
    let Some(mut gpu) = gpu() else { return };
    if !(gpu.adapter().software && gpu.adapter().backend == "vulkan") {
        return crate::stage::skipped("the report is about lavapipe");
    }
    let mut claims = filters::claims(&mut gpu);
    claims.extend(storage::claims(&mut gpu));
    claims.extend(costs::claims(&mut gpu));
    claims.sort_by_key(|c| c.id);
    let ids: Vec<u32> = claims.iter().map(|c| c.id).collect();
    assert_eq!(ids, (1..=22).collect::<Vec<u32>>(), "every claim once");
    let path = "tests/stability/CLAIMS.md";
    let committed = std::fs::read_to_string(root().join(path)).unwrap_or_default();
    let all = claims.iter_mut().flat_map(|c| c.holds.iter_mut().chain(&mut c.limits));
    for evidence in all.filter(|e| e.timed) {
        println!("{}: {:.3}, {}", evidence.what, evidence.measured, evidence.bound.text());
        let said = |answer: &str| committed.contains(&format!("{} | {answer} |", evidence.what));
        if std::env::var_os("BLESS").is_none() && (said("yes") || said("no")) {
            evidence.recorded = Some(said("yes"));
        }
    }
    let count = |verdict: &str| claims.iter().filter(|c| c.verdict() == verdict).count();
    let sums = ["confirmed", "true, with a limit", "refuted"].map(|v| format!("{} {v}", count(v))).join("; ");
    let body: String = claims.iter().map(Claim::text).collect();
    let text = format!("{HEAD}\n{sums}.\n{body}{SLIPS}");
    if !agrees(&committed, &text) {
        expect_file(path, text.as_bytes());
    }
}

/// Whether two reports say the same: figures within a twentieth, or 0.003.
fn agrees(committed: &str, text: &str) -> bool {
    let cells = |line: &str| line.split(" | ").map(str::to_owned).collect::<Vec<_>>();
    committed.lines().count() == text.lines().count()
        && committed.lines().zip(text.lines()).all(|(old, new)| {
            let (old, new) = (cells(old), cells(new));
            let number = |all: &[String]| all.get(1).and_then(|c| c.parse::<f64>().ok());
            match (number(&old), number(&new)) {
                (Some(a), Some(b)) => {
                    (a - b).abs() <= 0.003 + 0.05 * a.abs() && old[0] == new[0] && old[2..] == new[2..]
                }
                _ => old == new,
            }
        })
}

#[test]
fn verdicts_follow_from_measurements() {
    let verdict = |held: f64, limit: Option<f64>| {
        let holds = vec![shows("a", held, Bound::Most(1.0))];
        let limits = limit.into_iter().map(|x| shows("b", x, Bound::Most(1.0))).collect();
        Claim { id: 1, source: "VSM", says: "x", holds, limits }.verdict()
    };
    assert_eq!(verdict(0.5, None), "confirmed");
    assert_eq!(verdict(0.5, Some(2.0)), "confirmed");
    assert_eq!(verdict(0.5, Some(0.5)), "true, with a limit");
    assert_eq!(verdict(1.5, Some(0.5)), "refuted");
}
