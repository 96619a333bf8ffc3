//! The chart as a drawing.

use std::fmt::Write as _;

use super::data::Chart;
use super::legend::{legend, small_print, source};
use super::panel::{Axes, draw};
use super::text::{FONT, cut, escaped};

const MARGIN: f64 = 18.0;
/// Between panels, in points.
const GAP: f64 = 10.0;
const INK: &str = "#22262d";

/// Columns of so many panels, and the size of one.
fn layout(panels: usize) -> (usize, [f64; 2]) {
    match panels {
        0 | 1 => (1, [760.0, 470.0]),
        2 => (2, [470.0, 370.0]),
        4 => (2, [470.0, 330.0]),
        _ => (3, [360.0, 300.0]),
    }
}

/// The chart as the text of an SVG file. The same chart gives the same bytes.
pub fn svg(chart: &Chart<'_>, title: &str) -> String {
    let (columns, size) = layout(chart.panels.len());
    let rows = chart.panels.len().div_ceil(columns);
    let inner = columns as f64 * size[0] + (columns - 1) as f64 * GAP;
    let wide = inner + 2.0 * MARGIN;
    let mut top = MARGIN;
    let mut out = String::new();
    if !title.is_empty() {
        let title = escaped(&cut(title, 90));
        let _ = writeln!(
            out,
            "<text x=\"{MARGIN}\" y=\"{:.1}\" font-size=\"18\" fill=\"{INK}\" stroke=\"{INK}\" stroke-width=\"0.4\">{title}</text>",
            top + 15.0
        );
        top += 32.0;
    }
    let axes = Axes::new(chart);
    for (i, panel) in chart.panels.iter().enumerate() {
        let (x, y) = (MARGIN + (i % columns) as f64 * (size[0] + GAP), top + (i / columns) as f64 * (size[1] + GAP));
        let _ = writeln!(out, "<g transform=\"translate({x:.1} {y:.1})\">\n{}</g>", draw(chart, panel, &axes, size));
    }
    top += rows as f64 * (size[1] + GAP) + 6.0;
    let indent = MARGIN + 12.0;
    for (text, height) in [legend(chart, wide - 2.0 * indent), small_print(&source(chart), wide - 2.0 * indent)] {
        let _ = writeln!(out, "<g transform=\"translate({indent:.1} {top:.1})\">\n{text}</g>");
        top += height + 10.0;
    }
    let high = top + MARGIN - 10.0;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{wide:.0}\" height=\"{high:.0}\" viewBox=\"0 0 {wide:.0} {high:.0}\" font-family=\"{FONT}\">\n\
<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{out}</svg>\n"
    )
}
