//! The numbers behind a chart: every cell, every pass, and what went wrong.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::data::Chart;
use super::front::inline_mark;
use super::metric::REGIONS;
use super::text::escaped;
use crate::study::figures::figure;
use crate::study::select::Quantity;
use crate::study::{Record, Spread};

/// What is set, in few words.
pub(super) fn settings(record: &Record) -> String {
    let of = |name: &String| record.settings.get(name).map(|value| format!("{name} {value}"));
    record.varied.iter().filter_map(of).collect::<Vec<_>>().join(", ")
}

/// A median and its deviation; samples that lie far off are marked.
fn spread(samples: Option<Vec<f64>>) -> String {
    let Some(s) = samples.and_then(|s| Spread::of(&s)) else { return "<td class=\"n none\">-</td>".into() };
    let far = if s.outliers > 0 {
        format!(" <span class=\"far\" title=\"rounds that lie far off\">{}!</span>", s.outliers)
    } else {
        String::new()
    };
    format!("<td class=\"n\">{} <small>± {}</small>{far}</td>", figure(s.median), figure(s.mad))
}

fn number(x: Option<f64>) -> String {
    x.map_or("<td class=\"n none\">-</td>".into(), |x| format!("<td class=\"n\">{}</td>", figure(x)))
}

/// Every cell with its times and errors, class by class; those of the front in bold.
pub(super) fn cells(chart: &Chart<'_>, records: &[Record]) -> String {
    let mut out = String::from(
        "<h2>All cells</h2>\n<p>Milliseconds: median ± median absolute deviation; <span class=\"far\">2!</span> \
means that two rounds lie far off (they are counted all the same). Errors are of visibility, 0 to 1. Rows in bold are on the \
front of the chart.</p>\n",
    );
    let best: Vec<&Record> = chart.panels.iter().flat_map(|p| p.front.iter().map(|i| p.points[*i].record)).collect();
    let mut cases: Vec<(&str, &str)> = Vec::new();
    for record in records {
        let case = (record.class.as_str(), record.case.as_str());
        if !cases.contains(&case) {
            cases.push(case);
        }
    }
    for (class, case) in cases {
        let title = if case.is_empty() || case == class { class.to_owned() } else { format!("{class}: {case}") };
        let _ = writeln!(
            out,
            "<details><summary>{}</summary><div class=\"wide\"><table><thead><tr><th>method</th><th>set to</th>\
<th>frame</th><th>format</th><th>bits</th><th>light</th><th>filter</th><th>main</th><th>all passes</th><th>wall</th>\
<th>× plain</th><th>RMS</th><th>bias</th><th>p99</th><th>max</th><th>&gt; 1/255</th><th>false lit</th><th>false dark</th>\
<th>penumbra</th><th>umbra</th><th>lit</th><th>silhouette</th></tr></thead><tbody>",
            escaped(&title)
        );
        for record in records.iter().filter(|r| r.class == class && r.case == case) {
            let on = best.iter().any(|b| std::ptr::eq(*b, record));
            let method = chart.methods.iter().position(|m| *m == record.method).unwrap_or(0);
            let _ = write!(
                out,
                "<tr{}><td class=\"name\">{} {}{}</td><td class=\"name\">{}</td><td>{}x{}</td><td>{}</td><td class=\"n\">{}</td>",
                if on { " class=\"best\"" } else { "" },
                inline_mark(method),
                escaped(&record.method),
                if record.baseline { " <small>(plain)</small>" } else { "" },
                escaped(&settings(record)),
                record.frame.0,
                record.frame.1,
                escaped(record.format.as_deref().unwrap_or("-")),
                record.bits.map_or("-".into(), |b| b.to_string())
            );
            for time in [Quantity::Light, Quantity::Filter, Quantity::Main, Quantity::Total, Quantity::Wall] {
                out.push_str(&spread(time.of(record, None)));
            }
            out.push_str(&spread(record.ratios()));
            let errors = record.errors.get(&chart.reference);
            let all = errors.and_then(|e| e.regions.get("all"));
            let of = |f: fn(&crate::reference::Metrics) -> f64| number(all.map(f));
            for text in [
                of(|m| m.rms),
                of(|m| m.bias),
                of(|m| m.percentile_99),
                of(|m| m.most),
                of(|m| m.over_step),
                of(|m| m.false_lit),
                of(|m| m.false_dark),
            ] {
                out.push_str(&text);
            }
            for region in &REGIONS[1..] {
                // A part of the picture without pixels has no error.
                let metrics = errors.and_then(|e| e.regions.get(*region)).filter(|m| m.pixels > 0);
                out.push_str(&number(metrics.map(|m| m.rms)));
            }
            out.push_str("</tr>\n");
        }
        out.push_str("</tbody></table></div></details>\n");
    }
    out.push_str("<p><small>Penumbra, umbra, lit and silhouette: RMS error over the pixels that the truth says are such.</small></p>\n");
    out
}

/// Every pass of every cell.
pub(super) fn passes(records: &[Record]) -> String {
    let mut out = String::from(
        "<details><summary>Every pass, milliseconds</summary><div class=\"wide\"><table><thead><tr>\
<th>cell</th><th>pass</th><th>for</th><th>median</th><th>MAD</th><th>least</th><th>most</th><th>rounds</th><th>far off</th>\
</tr></thead><tbody>\n",
    );
    for record in records {
        for pass in &record.passes {
            let Some(s) = Spread::of(&pass.milliseconds) else { continue };
            let role = format!("{:?}", pass.role).to_lowercase();
            let far = if s.outliers > 0 { "far" } else { "" };
            let _ = writeln!(
                out,
                "<tr><td>{}</td><td>{}</td><td>{role}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>\
<td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n {far}\">{}</td></tr>",
                escaped(&record.cell),
                escaped(&pass.name),
                figure(s.median),
                figure(s.mad),
                figure(s.min),
                figure(s.max),
                s.count,
                s.outliers
            );
        }
    }
    out.push_str("</tbody></table></div></details>\n");
    out
}

/// Cells without figures, and what was done otherwise than asked, each with the cells that it happened to.
pub(super) fn trouble(records: &[Record]) -> String {
    let mut failures: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    let mut messages: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for record in records {
        if let Some(why) = &record.failure {
            failures.entry(why).or_default().push(&record.cell);
        }
        record.messages.iter().for_each(|m| messages.entry(m).or_default().push(&record.cell));
    }
    let mut out = String::new();
    for (title, all) in [("Cells without figures", failures), ("Done otherwise than asked", messages)] {
        if all.is_empty() {
            continue;
        }
        let _ = writeln!(out, "<h2>{title}</h2>\n<ul>");
        for (what, cells) in all {
            let shown: Vec<&str> = cells.iter().copied().take(8).collect();
            let rest = cells.len() - shown.len();
            let more = if rest > 0 { format!(" and {rest} more") } else { String::new() };
            let _ = writeln!(out, "<li>{} <small>({}{more})</small></li>", escaped(what), escaped(&shown.join("; ")));
        }
        out.push_str("</ul>\n");
    }
    out
}

/// Notes on the truth and versions of what took part.
pub(super) fn origins(records: &[Record]) -> String {
    let mut truths: BTreeMap<String, usize> = BTreeMap::new();
    let mut versions: BTreeMap<String, usize> = BTreeMap::new();
    for record in records {
        for (name, errors) in &record.errors {
            let note = if errors.note.is_empty() { String::new() } else { format!(": {}", errors.note) };
            *truths.entry(format!("{name}, {} x {}{note}", errors.size.0, errors.size.1)).or_default() += 1;
        }
        for (name, version) in &record.versions {
            *versions.entry(format!("{name} {version}")).or_default() += 1;
        }
    }
    let mut out = String::from("<h2>Truth and versions</h2>\n<ul>\n");
    for (text, count) in truths.into_iter().chain(versions) {
        let cells = if count == 1 { "1 cell".to_owned() } else { format!("{count} cells") };
        let _ = writeln!(out, "<li>{} <small>({cells})</small></li>", escaped(&text));
    }
    out.push_str("</ul>\n");
    out
}
