//! Published tables beside measurements, as a part of the report.

use std::fmt::Write as _;

use super::text::escaped;
use crate::study::figures::figure;
use crate::study::published::{Comparison, Pair};

/// The section on published tables; empty where there are none.
pub(super) fn section(comparisons: &[Comparison], device: &str) -> String {
    if comparisons.is_empty() {
        return String::new();
    }
    let mut out = String::from("<h2>Beside what was published</h2>\n");
    let _ = writeln!(
        out,
        "<p>Times as multiples of the plain shadow map's in the same place: as published, and below, in bold, as measured \
on {} with the interval of its median.</p>",
        escaped(device)
    );
    for comparison in comparisons {
        let table = &comparison.published;
        let on = if table.device.is_empty() { String::new() } else { format!(" ({})", table.device) };
        let _ = write!(
            out,
            "<h3>{}</h3>\n<p>{}{}; divided by {}.</p>\n<div class=\"wide\"><table><thead><tr><th>{}</th>",
            escaped(&table.title),
            escaped(&table.source),
            escaped(&on),
            escaped(&table.plain),
            escaped(&table.vary)
        );
        table.columns.iter().for_each(|c| out.push_str(&format!("<th>{}</th>", escaped(c))));
        out.push_str("</tr></thead><tbody>\n");
        for (method, pairs) in &comparison.rows {
            let _ = write!(out, "<tr><th>{}</th>", escaped(method));
            pairs.iter().for_each(|pair| out.push_str(&cell(pair)));
            out.push_str("</tr>\n");
        }
        out.push_str("<tr><th>pairs in the published order</th>");
        for (same, all) in &comparison.agreement {
            let _ = write!(out, "<td class=\"n\">{same} of {all}</td>");
        }
        out.push_str("</tr>\n</tbody></table></div>\n");
    }
    out
}

fn cell(pair: &Pair) -> String {
    let published = pair.published.map_or("-".to_owned(), figure);
    let measured = match (pair.measured, pair.interval) {
        (Some(x), Some((low, high))) => {
            format!("<b>{}</b> <small>{} to {}</small>", figure(x), figure(low), figure(high))
        }
        (Some(x), None) => format!("<b>{}</b>", figure(x)),
        (None, _) => "<span class=\"none\">not measured</span>".to_owned(),
    };
    format!("<td class=\"n\">{published}<br>{measured}</td>")
}
