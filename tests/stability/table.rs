//! Tables of measurements with their laws, compared figure by figure with committed ones.

use std::fmt::Write as _;

use shadetree::render::Gpu;

use crate::support::{expect_file, root};

/// What a measured figure has to be.
#[derive(Clone, Copy, Debug)]
pub(super) enum Bound {
    Most(f64),
    Least(f64),
    /// A value, and how far from it.
    Near(f64, f64),
}

impl Bound {
    /// How far a figure is beyond the bound; not positive where it holds. No number is within any bound.
    fn excess(self, x: f64) -> f64 {
        if !x.is_finite() {
            return f64::INFINITY;
        }
        match self {
            Self::Most(most) => x - most,
            Self::Least(least) => least - x,
            Self::Near(value, within) => (x - value).abs() - within,
        }
    }

    pub(super) fn holds(self, x: f64) -> bool {
        self.excess(x) <= 0.0
    }

    pub(super) fn text(self) -> String {
        match self {
            Self::Most(x) => format!("<= {}", figure(x)),
            Self::Least(x) => format!(">= {}", figure(x)),
            Self::Near(x, within) => format!("{} +- {}", figure(x), figure(within)),
        }
    }
}

struct Row {
    setting: String,
    law: String,
    measured: f64,
    bound: Bound,
    wide: bool,
}

/// Measurements of one failure.
pub(super) struct Table {
    name: &'static str,
    scene: &'static str,
    /// What adapters other than Vulkan's lavapipe may add to the bounds with a star, and why.
    elsewhere: (f64, &'static str),
    /// How far a figure may lie from the committed one: absolute, and relative to it.
    figures: (f64, f64),
    rows: Vec<Row>,
}

impl Table {
    pub(super) fn new(
        name: &'static str,
        scene: &'static str,
        elsewhere: (f64, &'static str),
        figures: (f64, f64),
    ) -> Self {
        Self { name, scene, elsewhere, figures, rows: Vec::new() }
    }

    /// A row whose bound holds on every adapter.
    pub(super) fn row(&mut self, setting: impl Into<String>, law: impl Into<String>, measured: f64, bound: Bound) {
        self.rows.push(Row { setting: setting.into(), law: law.into(), measured, bound, wide: false });
    }

    /// A row whose bound is for lavapipe, and wider elsewhere.
    pub(super) fn wide(&mut self, setting: impl Into<String>, law: impl Into<String>, measured: f64, bound: Bound) {
        self.rows.push(Row { setting: setting.into(), law: law.into(), measured, bound, wide: true });
    }

    /// Every figure is within its bound, and the table is the committed one.
    pub(super) fn check(self, gpu: &Gpu) {
        let elsewhere = !(gpu.adapter().software && gpu.adapter().backend == "vulkan");
        let slack = |row: &Row| if row.wide && elsewhere { self.elsewhere.0 } else { 0.0 };
        let broken: Vec<String> = self
            .rows
            .iter()
            .filter(|r| r.bound.excess(r.measured) > slack(r))
            .map(|r| format!("{}: {} is not {} ({})", r.setting, r.measured, r.bound.text(), r.law))
            .collect();
        assert!(broken.is_empty(), "{}:\n{}\n\n{}", self.name, broken.join("\n"), self.text());
        let path = format!("tests/stability/tables/{}.txt", self.name);
        let text = self.text();
        let committed = std::fs::read_to_string(root().join(&path)).unwrap_or_default();
        match self.disagreement(&committed, !elsewhere, &slack) {
            None => {}
            Some(what) if elsewhere => panic!("{path} is not what {} gives: {what}", gpu.adapter()),
            Some(_) => expect_file(&path, text.as_bytes()),
        }
    }

    /// What a committed table says otherwise, its figures within the tolerance that it states. A table that is not `whole`
    /// may lack rows that need what the adapter does not have.
    fn disagreement(&self, committed: &str, whole: bool, slack: &dyn Fn(&Row) -> f64) -> Option<String> {
        let text = self.text();
        if whole && committed.lines().count() != text.lines().count() {
            return Some("the number of lines".into());
        }
        let known: Vec<Vec<String>> = committed.lines().map(cells).collect();
        let mut rows = self.rows.iter();
        text.lines().map(cells).find_map(|new| {
            let Some(figure) = new.get(2).and_then(|c| c.parse::<f64>().ok()) else {
                return (!known.contains(&new)).then(|| new.join(" | "));
            };
            let slack = rows.next().map_or(0.0, slack);
            let near = |c: &String| {
                let before = c.parse::<f64>();
                before.is_ok_and(|b| (b - figure).abs() <= self.figures.0 + self.figures.1 * b.abs() + slack)
            };
            let same = |old: &Vec<String>| {
                old.len() == new.len() && old[..2] == new[..2] && old[3..] == new[3..] && near(&old[2])
            };
            (!known.iter().any(same)).then(|| new.join(" | "))
        })
    }

    fn text(&self) -> String {
        let head = ["setting".to_owned(), "law".to_owned(), "measured".to_owned(), "bound".to_owned()];
        let mut lines = vec![head];
        for row in &self.rows {
            let star = if row.wide { " *" } else { "" };
            let bound = format!("{}{star}", row.bound.text());
            lines.push([row.setting.clone(), row.law.clone(), figure(row.measured), bound]);
        }
        let width = |column: usize| lines.iter().map(|l| l[column].chars().count()).max().unwrap_or(0);
        let widths = [width(0), width(1), width(2)];
        let mut text = format!("{}\n", self.scene);
        let (absolute, relative) = self.figures;
        let _ = writeln!(text, "A new run agrees within {} + {} x the figure.", figure(absolute), figure(relative));
        if self.rows.iter().any(|r| r.wide) {
            let (slack, why) = self.elsewhere;
            let _ = writeln!(text, "* on lavapipe; other adapters may be off by {} more: {why}.", figure(slack));
        }
        text += "\n";
        for [setting, law, measured, bound] in &lines {
            let line = format!(
                "{setting:<a$} | {law:<b$} | {measured:<c$} | {bound}",
                a = widths[0],
                b = widths[1],
                c = widths[2]
            );
            let _ = writeln!(text, "{}", line.trim_end());
        }
        text
    }
}

fn cells(line: &str) -> Vec<String> {
    line.split(" | ").map(|c| c.trim().to_owned()).collect()
}

/// Four significant digits.
pub(super) fn figure(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let size = x.abs();
    if !(1e-3..1e5).contains(&size) {
        return format!("{x:.2e}");
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between -3 and 4")]
    let digits = (3.0 - size.log10().floor()).max(0.0) as usize;
    let text = format!("{x:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[test]
fn figures_are_short_and_bounds_refuse_what_is_no_number() {
    assert_eq!(
        [0.0, 0.25, 0.03921, 1.0, 123.456, 8.5e-8, -0.5].map(figure).join(" "),
        "0 0.25 0.03921 1 123.5 8.50e-8 -0.5"
    );
    for bound in [Bound::Most(1.0), Bound::Least(-1.0), Bound::Near(0.0, 1.0)] {
        assert!(bound.excess(f64::NAN) > 0.0 && bound.excess(0.5) <= 0.0 && bound.excess(f64::INFINITY) > 0.0);
    }
    assert!(Bound::Most(1.0).excess(1.1) > 0.0 && Bound::Least(1.0).excess(0.9) > 0.0);
}

#[test]
fn tables_agree_within_their_tolerance_only() {
    let table = |measured: f64, setting: &str| {
        let mut table = Table::new("none", "A scene.", (0.0, ""), (0.01, 0.0));
        table.row(setting, "T0", measured, Bound::Most(1.0));
        table
    };
    let committed = table(0.5, "x").text();
    let same = |table: Table, slack: f64| table.disagreement(&committed, true, &|_| slack).is_none();
    assert!(same(table(0.505, "x"), 0.0));
    assert!(!same(table(0.52, "x"), 0.0));
    assert!(same(table(0.52, "x"), 0.02));
    assert!(!same(table(0.5, "y"), 0.0));
    assert!(table(0.5, "x").disagreement("", true, &|_| 0.0).is_some());
    let mut more = table(0.5, "x");
    more.row("y", "T0", 0.5, Bound::Most(1.0));
    let more = more.text();
    assert!(table(0.5, "x").disagreement(&more, false, &|_| 0.0).is_none());
    assert!(table(0.5, "x").disagreement(&more, true, &|_| 0.0).is_some());
}
