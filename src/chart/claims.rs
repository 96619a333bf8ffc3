//! Claims and what became of them, as a part of the report.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::text::escaped;
use crate::study::Machine;
use crate::study::claims::{Outcome, Part, Verdict};
use crate::study::figures::figure;
use crate::study::resample::CONFIDENCE;

/// The section on claims; empty where there are none.
pub(super) fn section(verdicts: &[Verdict], machine: &Machine) -> String {
    if verdicts.is_empty() {
        return String::new();
    }
    let device = if machine.adapter.is_empty() { "this adapter" } else { &machine.adapter };
    let mut out = String::from("<h2>Claims</h2>\n");
    let _ = writeln!(
        out,
        "<p>Each is judged by medians. The interval holds {:.0}% of what it comes to when the rounds are drawn again \
(bootstrap); where it reaches across a bound, it is in italics, and another run may decide otherwise. A law must hold on every device; the \
rest are facts about {}.</p>\n<p>{}</p>",
        CONFIDENCE * 100.0,
        escaped(device),
        summary(verdicts)
    );
    out.push_str(
        "<div class=\"wide\"><table><thead><tr><th></th><th>claim</th><th></th><th>verdict</th><th>decided by</th>\
<th>value</th><th>interval</th><th>allowed</th></tr></thead><tbody>\n",
    );
    for verdict in verdicts {
        let kind = if verdict.law { "law" } else { "fact" };
        let outcome = verdict.outcome;
        let _ = write!(
            out,
            "<tr><th>{}</th><td>{}</td><td>{kind}</td><td class=\"{}\">{}</td>",
            escaped(&verdict.id),
            escaped(&verdict.text),
            class(outcome),
            outcome.words()
        );
        match verdict.decisive() {
            Some(part) => {
                let reason =
                    if verdict.reason.is_empty() { String::new() } else { format!("<br>{}", escaped(&verdict.reason)) };
                let _ = writeln!(
                    out,
                    "<td>{}: {}{reason}</td>{}</tr>",
                    escaped(&part.place),
                    escaped(&part.what),
                    numbers(part)
                );
            }
            None => {
                let _ = writeln!(out, "<td colspan=\"4\">{}</td></tr>", escaped(&verdict.reason));
            }
        }
    }
    out.push_str("</tbody></table></div>\n<details><summary>Every number behind the claims</summary>\n");
    out.push_str(
        "<div class=\"wide\"><table><thead><tr><th></th><th>of</th><th>number</th><th>value</th><th>interval</th>\
<th>allowed</th><th></th><th>values along the axis, or their fit</th></tr></thead><tbody>\n",
    );
    for verdict in verdicts {
        for part in &verdict.parts {
            let held = if part.held { Outcome::Held } else { Outcome::NotHeld };
            let _ = writeln!(
                out,
                "<tr><th>{}</th><td>{}</td><td>{}</td>{}<td class=\"{}\">{}</td><td>{}</td></tr>",
                escaped(&verdict.id),
                escaped(&part.place),
                escaped(&part.what),
                numbers(part),
                class(held),
                held.words(),
                escaped(&part.detail)
            );
        }
    }
    out.push_str("</tbody></table></div></details>\n");
    out
}

/// Each hypothesis with its parts taken together.
fn summary(verdicts: &[Verdict]) -> String {
    let mut order: Vec<&str> = Vec::new();
    let mut parts: BTreeMap<&str, Vec<Outcome>> = BTreeMap::new();
    for verdict in verdicts {
        let name = verdict.id.split(' ').next().unwrap_or(&verdict.id);
        if !parts.contains_key(name) {
            order.push(name);
        }
        parts.entry(name).or_default().push(verdict.outcome);
    }
    let line = |name: &&str| {
        let all = &parts[name];
        let of = |outcome: Outcome| all.iter().filter(|o| **o == outcome).count();
        let (held, measured) = (of(Outcome::Held), all.len() - of(Outcome::NotMeasured));
        let (text, outcome) = match (held, measured) {
            (_, 0) => ("not measured".to_owned(), Outcome::NotMeasured),
            (held, _) if held == all.len() => ("held".to_owned(), Outcome::Held),
            (0, measured) if measured == all.len() => ("not held".to_owned(), Outcome::NotHeld),
            (held, _) => (format!("{held} of {} parts held", all.len()), Outcome::NotMeasured),
        };
        format!("<span class=\"tag {}\">{} {text}</span>", class(outcome), escaped(name))
    };
    order.iter().map(line).collect::<Vec<_>>().join(" ")
}

fn numbers(part: &Part) -> String {
    let sure = if part.sure { "" } else { " class=\"unsure\"" };
    format!(
        "<td class=\"n\"><b>{}</b></td><td{sure}>{} to {}</td><td>{}</td>",
        figure(part.value),
        figure(part.interval.0),
        figure(part.interval.1),
        escaped(&part.allowed())
    )
}

fn class(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Held => "held",
        Outcome::NotHeld => "fails",
        Outcome::NotMeasured => "open",
    }
}
