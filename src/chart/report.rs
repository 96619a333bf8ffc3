//! The report: the chart, who wins, claims, published tables, pictures and all numbers, in one file.

use std::fmt::Write as _;

use base64::Engine as _;

use super::data::{Chart, Panel};
use super::front::{inline_mark, name, tables};
use super::legend::machine;
use super::page::page;
use super::svg::svg;
use super::text::escaped;
use super::{claims, published, tables as numbers};
use crate::study::Record;
use crate::study::claims::Verdict;
use crate::study::figures::figure;
use crate::study::published::Comparison;

/// Most points of a panel that others beat and that are shown as pictures.
const BEATEN_SHOWN: usize = 6;

/// What a report is made of.
pub struct Report<'a> {
    /// The chart.
    pub chart: &'a Chart<'a>,
    /// All that was measured.
    pub records: &'a [Record],
    /// Title of the study.
    pub title: &'a str,
    /// What it is about.
    pub note: &'a str,
    /// Claims, judged.
    pub verdicts: &'a [Verdict],
    /// Published tables beside measurements.
    pub comparisons: &'a [Comparison],
}

/// The report as the text of an HTML file. `picture` gives the small PNG file of a name below the folder of results.
pub fn html(report: &Report<'_>, picture: &dyn Fn(&str) -> Option<Vec<u8>>) -> String {
    let chart = report.chart;
    let title = if report.title.is_empty() { "Error against time" } else { report.title };
    let mut body = String::new();
    let _ = writeln!(body, "<h1>{}</h1>", escaped(title));
    report.note.lines().filter(|l| !l.trim().is_empty()).for_each(|line| {
        let _ = writeln!(body, "<p>{}</p>", escaped(line));
    });
    let class = if chart.machine.software { " class=\"warn\"" } else { "" };
    let failed = report.records.iter().filter(|r| r.failure.is_some()).count();
    let without = if failed > 0 { format!(", {failed} of them without figures") } else { String::new() };
    let _ = writeln!(
        body,
        "<p{class}>Measured on {}. {} cells{without}.</p>",
        escaped(&machine(&chart.machine)),
        report.records.len()
    );
    if chart.panels.is_empty() {
        body.push_str("<p>No errors were measured, so there is no chart of them.</p>\n");
    } else {
        body.push_str("<h2>Error against time</h2>\n");
        body.push_str(&svg(chart, "").replacen(
            "<svg ",
            "<svg class=\"chart\" role=\"img\" aria-label=\"Error against time\" ",
            1,
        ));
        body.push_str(
        "<p>Both axes are logarithmic; further left is quicker, further down nearer to the truth. Points of a method are \
joined in the order of its sweep, and the numbers beside those of the front are what it is set to there.</p>\n",
    );
        body.push_str(&tables(chart));
    }
    body.push_str(&claims::section(report.verdicts, &chart.machine));
    let device = if chart.machine.adapter.is_empty() { "this adapter" } else { &chart.machine.adapter };
    body.push_str(&published::section(report.comparisons, device));
    body.push_str(&pictures(chart, picture));
    body.push_str(&numbers::cells(chart, report.records));
    body.push_str(&numbers::passes(report.records));
    body.push_str(&numbers::trouble(report.records));
    body.push_str(&numbers::origins(report.records));
    page(title, &body)
}

/// The truth of each panel, then what is on its front and the best of some other methods, with their errors.
fn pictures(chart: &Chart<'_>, picture: &dyn Fn(&str) -> Option<Vec<u8>>) -> String {
    let mut sections = String::new();
    for panel in &chart.panels {
        let mut figures = String::new();
        let truth = panel.points.iter().find_map(|p| p.record.truth_pictures.as_ref());
        if let Some(png) = truth.and_then(|t| picture(&format!("{t}.{}.png", chart.reference))) {
            let _ =
                writeln!(figures, "<figure>{}<figcaption>the truth</figcaption></figure>", image(&png, "the truth"));
        }
        for i in panel.front.iter().copied().chain(others(panel)) {
            let point = &panel.points[i];
            let Some(base) = &point.record.pictures else { continue };
            let seen = picture(&format!("{base}.visibility.png"));
            let wrong = picture(&format!("{base}.error.png"));
            if seen.is_none() && wrong.is_none() {
                continue;
            }
            let name = name(chart, panel, i);
            let images: String = [(seen, "visibility"), (wrong, "error")]
                .iter()
                .filter_map(|(png, what)| Some(image(png.as_ref()?, &format!("{what} of {name}"))))
                .collect();
            let place = if panel.front.contains(&i) { "on the front" } else { "beaten" };
            let _ = writeln!(
                figures,
                "<figure><div class=\"pair\">{images}</div><figcaption>{} {}<br>{}{}, error {} <small>({place})</small></figcaption></figure>",
                inline_mark(point.method),
                escaped(&name),
                figure(point.time.median),
                chart.choice.time.unit(),
                figure(point.error)
            );
        }
        if !figures.is_empty() {
            let _ = writeln!(sections, "<h3>{}</h3>\n{figures}", escaped(&panel.title()));
        }
    }
    if sections.is_empty() {
        return String::new();
    }
    format!(
        "<h2>Pictures</h2>\n<p>Visibility (white is lit) beside its error: white is right, red too light, blue too dark, in \
full colour from a quarter on; grey is nothing.</p>\n{sections}"
    )
}

/// The best points of methods that are not on the front.
fn others(panel: &Panel<'_>) -> Vec<usize> {
    let mut shown: Vec<usize> = panel.front.iter().map(|i| panel.points[*i].method).collect();
    let mut order: Vec<usize> = (0..panel.points.len()).collect();
    order.sort_by(|a, b| panel.points[*a].error.total_cmp(&panel.points[*b].error).then(a.cmp(b)));
    let mut best = Vec::new();
    for i in order {
        let method = panel.points[i].method;
        if best.len() < BEATEN_SHOWN && panel.points[i].record.pictures.is_some() && !shown.contains(&method) {
            shown.push(method);
            best.push(i);
        }
    }
    best
}

fn image(png: &[u8], what: &str) -> String {
    let data = base64::engine::general_purpose::STANDARD.encode(png);
    format!("<img alt=\"{}\" src=\"data:image/png;base64,{data}\">", escaped(what))
}
