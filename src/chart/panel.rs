//! One panel: axes, curves, the front, marks and a few labels.

use std::fmt::Write as _;

use super::data::{Chart, Panel};
use super::marks::{color, mark, pale, radius};
use super::scale::Scale;
use super::text::{cut, escaped, width};

/// Room around the plot, in points: left, top, right, below.
pub(super) const ROOM: [f64; 4] = [58.0, 26.0, 12.0, 42.0];
/// Height of the strip for errors of 0.
const STRIP: f64 = 24.0;
const SMALL: f64 = 9.5;
const INK: &str = "#22262d";
const FAINT: &str = "#8b919b";

/// A box, in points: left, top, right, bottom.
type Box4 = [f64; 4];

/// What all panels share.
pub(super) struct Axes {
    pub(super) x: Scale,
    pub(super) y: Scale,
    pub(super) zero: bool,
}

impl Axes {
    pub(super) fn new(chart: &Chart<'_>) -> Self {
        let points = || chart.panels.iter().flat_map(|p| &p.points);
        Self {
            x: Scale::new(points().map(|p| p.time.median), 0.0, 1.0),
            y: Scale::new(points().map(|p| p.error), 1.0, 0.0),
            zero: chart.has_zero(),
        }
    }
}

/// Draws a panel of this size, its upper left corner at the origin.
pub(super) fn draw(chart: &Chart<'_>, panel: &Panel<'_>, axes: &Axes, size: [f64; 2]) -> String {
    let [left, top, right, below] = ROOM;
    let plot = [left, top, size[0] - right, size[1] - below];
    let floor = if axes.zero { plot[3] - STRIP } else { plot[3] };
    let x = axes.x.at(plot[0], plot[2]);
    let y = axes.y.at(floor, plot[1]);
    let mut out = String::new();
    let title = escaped(&cut(&panel.title(), 46));
    let _ = writeln!(
        out,
        "<text x=\"{left:.1}\" y=\"{:.1}\" font-size=\"13\" fill=\"{INK}\" stroke=\"{INK}\" stroke-width=\"0.35\">{title}</text>",
        top - 9.0
    );
    grid(&mut out, &x, &y, plot, floor);
    let place = |i: usize| {
        let point = &panel.points[i];
        [x.place(point.time.median), if point.error > 0.0 { y.place(point.error) } else { floor + STRIP / 2.0 }]
    };
    curves(&mut out, panel, &place);
    stairs(&mut out, panel, &place, plot);
    let mut taken: Vec<Box4> = Vec::new();
    let beaten = (0..panel.points.len()).filter(|i| !panel.front.contains(i));
    for (i, best) in beaten.map(|i| (i, false)).chain(panel.front.iter().map(|i| (*i, true))) {
        let point = &panel.points[i];
        let (at, r) = (place(i), radius(point.record.bits));
        let style = if best {
            format!("fill=\"{}\" stroke=\"#111111\" stroke-width=\"1.1\"", color(point.method))
        } else {
            format!("fill=\"{}\" stroke=\"#9aa0a8\" stroke-width=\"0.8\"", pale(point.method))
        };
        spread(&mut out, &x, point, at, plot);
        let told = format!(
            "{}{}{}: {:.3}{}, {:.2e}",
            chart.methods[point.method],
            if point.label.is_empty() { "" } else { " " },
            point.label,
            point.time.median,
            chart.choice.time.unit(),
            point.error
        );
        let _ = writeln!(out, "<g><title>{}</title>{}</g>", escaped(&told), mark(point.method, at, r, &style));
        taken.push([at[0] - r, at[1] - r, at[0] + r, at[1] + r]);
    }
    labels(&mut out, panel, &place, plot, &mut taken);
    names(&mut out, chart, size, plot, floor, axes.zero);
    out
}

/// Lines of the marks of both axes, and the frame.
fn grid(out: &mut String, x: &Scale, y: &Scale, plot: Box4, floor: f64) {
    let mut shown = f64::NEG_INFINITY;
    for tick in x.ticks() {
        let at = x.place(tick.value);
        let main = !tick.label.is_empty();
        let (length, shade) = if main { (5.0, "#e4e7eb") } else { (3.0, "#f2f4f6") };
        let _ = writeln!(
            out,
            "<path d=\"M{at:.1} {:.1}V{:.1}\" stroke=\"{shade}\"/><path d=\"M{at:.1} {:.1}v{length}\" stroke=\"{INK}\" stroke-width=\"0.8\"/>",
            plot[1], plot[3], plot[3]
        );
        let half = width(&tick.label, SMALL) / 2.0;
        if main && at - half > shown {
            let _ = writeln!(
                out,
                "<text x=\"{at:.1}\" y=\"{:.1}\" font-size=\"{SMALL}\" fill=\"{INK}\" text-anchor=\"middle\">{}</text>",
                plot[3] + 16.0,
                tick.label
            );
            shown = at + half + 4.0;
        }
    }
    let mut shown = f64::INFINITY;
    for tick in y.ticks() {
        let at = y.place(tick.value);
        let main = !tick.label.is_empty();
        let (length, shade) = if main { (5.0, "#e4e7eb") } else { (3.0, "#f2f4f6") };
        let _ = writeln!(
            out,
            "<path d=\"M{:.1} {at:.1}H{:.1}\" stroke=\"{shade}\"/><path d=\"M{:.1} {at:.1}h-{length}\" stroke=\"{INK}\" stroke-width=\"0.8\"/>",
            plot[0], plot[2], plot[0]
        );
        if main && at + 5.0 < shown {
            let _ = writeln!(
                out,
                "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"{SMALL}\" fill=\"{INK}\" text-anchor=\"end\">{}</text>",
                plot[0] - 8.0,
                at + 3.3,
                tick.label
            );
            shown = at - 6.0;
        }
    }
    let _ = writeln!(
        out,
        "<path d=\"M{:.1} {:.1}V{floor:.1}M{:.1} {:.1}H{:.1}\" fill=\"none\" stroke=\"{INK}\" stroke-width=\"0.9\"/>",
        plot[0], plot[1], plot[0], plot[3], plot[2]
    );
}

/// Points of a method, joined in the order of its sweep.
fn curves(out: &mut String, panel: &Panel<'_>, place: &dyn Fn(usize) -> [f64; 2]) {
    for curve in panel.curves.iter().filter(|c| c.points.len() > 1) {
        let _ = writeln!(
            out,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.1\" stroke-opacity=\"0.45\" stroke-linejoin=\"round\"/>",
            joined(curve.points.iter().map(|i| place(*i))),
            color(curve.method)
        );
    }
}

fn joined(points: impl Iterator<Item = [f64; 2]>) -> String {
    points.map(|[x, y]| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ")
}

/// The least error that any time up to here reaches.
fn stairs(out: &mut String, panel: &Panel<'_>, place: &dyn Fn(usize) -> [f64; 2], plot: Box4) {
    let steps: Vec<[f64; 2]> = panel.front.iter().map(|i| place(*i)).collect();
    let (Some(first), Some(last)) = (steps.first(), steps.last()) else { return };
    let mut line = vec![[first[0], plot[1]]];
    for pair in steps.windows(2) {
        line.extend([pair[0], [pair[1][0], pair[0][1]]]);
    }
    line.extend([*last, [plot[2], last[1]]]);
    let _ = writeln!(
        out,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{INK}\" stroke-width=\"1.7\" stroke-linejoin=\"round\"/>",
        joined(line.into_iter())
    );
}

/// How far times lie from their median, where that can be seen.
fn spread(out: &mut String, x: &Scale, point: &super::Point<'_>, at: [f64; 2], plot: Box4) {
    let ends = [point.time.median - point.time.mad, point.time.median + point.time.mad];
    let from = if ends[0] > 0.0 { x.place(ends[0]) } else { plot[0] };
    let to = x.place(ends[1]);
    if to - from > 3.0 {
        let _ = writeln!(
            out,
            "<path d=\"M{from:.1} {:.1}H{to:.1}\" stroke=\"{}\" stroke-width=\"0.9\" stroke-opacity=\"0.7\"/>",
            at[1],
            color(point.method)
        );
    }
}

/// Says what the points of the front are set to, where there is room beside them.
fn labels(out: &mut String, panel: &Panel<'_>, place: &dyn Fn(usize) -> [f64; 2], plot: Box4, taken: &mut Vec<Box4>) {
    const SIZE: f64 = 8.5;
    let hits = |a: &Box4, b: &Box4| a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
    // The stairs must not run through words: what lies on the front is right of and below a point.
    let mut lines: Vec<Box4> = Vec::new();
    let steps: Vec<[f64; 2]> = panel.front.iter().map(|i| place(*i)).collect();
    for pair in steps.windows(2) {
        lines.push([pair[0][0], pair[0][1] - 1.0, pair[1][0], pair[0][1] + 1.0]);
        lines.push([pair[1][0] - 1.0, pair[0][1], pair[1][0] + 1.0, pair[1][1]]);
    }
    if let (Some(first), Some(last)) = (steps.first(), steps.last()) {
        lines.push([first[0] - 1.0, plot[1], first[0] + 1.0, first[1]]);
        lines.push([last[0], last[1] - 1.0, plot[2], last[1] + 1.0]);
    }
    for &i in &panel.front {
        let point = &panel.points[i];
        if point.label.is_empty() {
            continue;
        }
        let text = cut(&point.label, 18);
        let (w, r, [x, y]) = (width(&text, SIZE), radius(point.record.bits) + 3.0, place(i));
        let corners = [
            [x - r - w, y + r - 2.0],
            [x - r - w, y - SIZE / 2.0],
            [x + r - 1.0, y - r - SIZE + 3.0],
            [x - w / 2.0, y + r],
            [x + r, y - SIZE / 2.0],
            [x - r - w, y - r - SIZE + 2.0],
            [x - w / 2.0, y - r - SIZE],
        ];
        let boxes = corners.map(|[left, top]| [left, top, left + w, top + SIZE]);
        let fits = |b: &&Box4| {
            b[0] > plot[0] + 1.0
                && b[2] < plot[2] - 1.0
                && b[1] > plot[1]
                && b[3] < plot[3]
                && !taken.iter().chain(&lines).any(|t| hits(b, t))
        };
        let Some(free) = boxes.iter().find(fits).copied() else { continue };
        taken.push(free);
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"{SIZE}\" fill=\"{INK}\">{}</text>",
            free[0],
            free[3] - 1.5,
            escaped(&text)
        );
    }
}

/// Names of the axes, and the line of errors that are 0.
fn names(out: &mut String, chart: &Chart<'_>, size: [f64; 2], plot: Box4, floor: f64, zero: bool) {
    let middle = (plot[0] + plot[2]) / 2.0;
    let _ = writeln!(
        out,
        "<text x=\"{middle:.1}\" y=\"{:.1}\" font-size=\"10.5\" fill=\"{INK}\" text-anchor=\"middle\">{}</text>",
        size[1] - 8.0,
        chart.choice.time.label()
    );
    let region = match chart.choice.region.as_str() {
        "all" => String::new(),
        region => format!(", {region} only"),
    };
    let label = format!("{}{region}", chart.choice.metric.label);
    let middle = (plot[1] + plot[3]) / 2.0;
    let _ = writeln!(
        out,
        "<text transform=\"translate(13 {middle:.1}) rotate(-90)\" font-size=\"10.5\" fill=\"{INK}\" text-anchor=\"middle\">{}</text>",
        escaped(&label)
    );
    if zero {
        let line = floor + STRIP / 2.0;
        let left = plot[0];
        // The axis is broken between its least value and nothing.
        let _ = writeln!(
            out,
            "<path d=\"M{left:.1} {line:.1}H{:.1}\" stroke=\"{FAINT}\" stroke-width=\"0.7\" stroke-dasharray=\"2 3\"/>\
<path d=\"M{left:.1} {line:.1}V{:.1}M{:.1} {:.1}l8 -4M{:.1} {:.1}l8 -4\" stroke=\"{INK}\" stroke-width=\"0.9\"/>\
<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"{SMALL}\" fill=\"{INK}\" text-anchor=\"end\">0</text>",
            plot[2],
            plot[3],
            left - 4.0,
            floor + 4.0,
            left - 4.0,
            floor + 8.0,
            left - 8.0,
            line + 3.3
        );
    }
}
