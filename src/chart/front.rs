//! Who wins: the least error within a time, and the least time within an error.

use std::fmt::Write as _;

use super::data::{Chart, Panel};
use super::marks::{color, mark};
use super::text::escaped;
use crate::study::figures::figure;
use crate::study::front::{best_within, cheapest_within};

/// Errors that people ask for.
pub(super) const ERRORS: [f64; 6] = [0.1, 0.05, 0.02, 0.01, 0.005, 0.002];
/// Most budgets of time that are listed.
const BUDGETS: usize = 7;

/// Round times that differ in who wins: of 1, 1.5, 2, 3, 5 and 7 and their tens those from the quickest point to the slowest
/// of all fronts.
pub(super) fn budgets(chart: &Chart<'_>) -> Vec<f64> {
    let times = || chart.panels.iter().flat_map(|p| p.front.iter().map(|i| p.points[*i].time.median));
    let (low, high) = (times().fold(f64::INFINITY, f64::min), times().fold(0.0, f64::max));
    if !(low > 0.0 && low <= high && high.is_finite()) {
        return Vec::new();
    }
    let mut all = Vec::new();
    let mut power = low.log10().floor();
    while power <= high.log10().ceil() && all.len() < 4000 {
        all.extend([1.0, 1.5, 2.0, 3.0, 5.0, 7.0].map(|d| d * 10f64.powf(power)));
        power += 1.0;
    }
    // The first that leaves nothing out is the last that is needed.
    let end = all.iter().position(|b| *b >= high).map_or(all.len(), |i| i + 1);
    let start = all.iter().position(|b| *b >= low).unwrap_or(0);
    let between = &all[start.min(end)..end];
    let every = between.len().div_ceil(BUDGETS).max(1);
    // From the end, so that the largest stays.
    let mut kept: Vec<f64> = between.iter().rev().step_by(every).copied().collect();
    kept.reverse();
    kept
}

/// A point by its method and what it is set to.
pub(super) fn name(chart: &Chart<'_>, panel: &Panel<'_>, i: usize) -> String {
    let point = &panel.points[i];
    let method = &chart.methods[point.method];
    if point.label.is_empty() { method.clone() } else { format!("{method}, {}", point.label) }
}

/// The mark of a method within a line of text.
pub(super) fn inline_mark(method: usize) -> String {
    let style = format!("fill=\"{}\" stroke=\"#111\" stroke-width=\"1\"", color(method));
    format!(
        "<svg class=\"mark\" width=\"14\" height=\"14\" viewBox=\"0 0 14 14\">{}</svg>",
        mark(method, [7.0, 7.0], 4.6, &style)
    )
}

/// Both tables.
pub(super) fn tables(chart: &Chart<'_>) -> String {
    let unit = chart.choice.time.unit();
    let budgets = budgets(chart);
    let mut out = String::from("<h2>Who wins</h2>\n");
    let _ = writeln!(
        out,
        "<p>Of all that was measured, the least {} within a time, and the least time within an error.</p>",
        escaped(chart.choice.metric.label)
    );
    let heads: Vec<String> = budgets.iter().map(|b| format!("at most {}{unit}", short(*b))).collect();
    table(&mut out, chart, &heads, &|panel, column| {
        let i = best_within(&panel.places(), &panel.front, budgets[column])?;
        Some((i, figure(panel.points[i].error)))
    });
    let heads: Vec<String> = ERRORS.iter().map(|e| format!("error at most {e}")).collect();
    table(&mut out, chart, &heads, &|panel, column| {
        let i = cheapest_within(&panel.places(), &panel.front, ERRORS[column])?;
        Some((i, format!("{}{unit}", figure(panel.points[i].time.median))))
    });
    out
}

/// The point that wins in a panel and a column, and what is said of it.
type Winner<'a> = &'a dyn Fn(&Panel<'_>, usize) -> Option<(usize, String)>;

fn table(out: &mut String, chart: &Chart<'_>, heads: &[String], winner: Winner<'_>) {
    out.push_str("<div class=\"wide\"><table><thead><tr><th>class</th>");
    heads.iter().for_each(|head| out.push_str(&format!("<th>{}</th>", escaped(head))));
    out.push_str("</tr></thead><tbody>\n");
    for panel in &chart.panels {
        let _ = write!(out, "<tr><th>{}</th>", escaped(&panel.title()));
        for column in 0..heads.len() {
            match winner(panel, column) {
                Some((i, value)) => {
                    let mark = inline_mark(panel.points[i].method);
                    let name = escaped(&name(chart, panel, i));
                    let _ = write!(out, "<td>{mark} {name}<br><b>{value}</b></td>");
                }
                None => out.push_str("<td class=\"none\">none</td>"),
            }
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody></table></div>\n");
}

/// A round number without needless digits.
fn short(x: f64) -> String {
    // Tens of the binary 10^-1 and the like end in noise.
    let text = format!("{x:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
