//! The plan as people and programs read it.

use serde_json::{Value, json};

use super::Choose;
use crate::choose::{Verdict, Wish};
use crate::reference::Metrics;
use crate::studio::choice::{Choice, error_of};

/// For people: a paragraph a light.
pub(super) fn text(choices: &[Choice], wish: &Wish, device: &str, command: &Choose) -> String {
    let mut out = String::new();
    let metric = wish.metric.name();
    for choice in choices {
        let head = match &choice.verdict {
            Verdict::Unshadowed(reason) => format!("no shadow code: {reason}; error 0\n"),
            Verdict::Met(p) | Verdict::Unmet(p) => format!(
                "{}\n  {metric} {:.4} expected, {:.4} at most; {:.2} ms on {device}\n",
                p.outlook.candidate.name(),
                p.outlook.error,
                p.outlook.bound,
                p.milliseconds
            ),
        };
        out += &format!("{}: {head}", choice.light);
        if choice.judged > 0 {
            out += &format!("  {} of {} candidates keep to {}\n", choice.good, choice.judged, wish.max_error);
        }
        if command.explain {
            for decision in &choice.decisions {
                let bound = decision.bound.map_or_else(String::new, |b| format!(" (error at most {b:.4})"));
                out += &format!("  {}: {} - {}{bound}\n", decision.about, decision.choice, decision.reason);
            }
            if !choice.unmodelled.is_empty() {
                out += &format!("  not judged, as no model tells their error: {}\n", choice.unmodelled.join(", "));
            }
        }
        for measured in &choice.front {
            let mark = if measured.on_front { '*' } else { ' ' };
            out += &format!(
                "  {mark} {:.2} ms  {metric} {:.4}  {}\n",
                measured.milliseconds, measured.error, measured.name
            );
        }
        if !choice.front.is_empty() {
            out += "  (* nothing measured is both as exact and cheaper)\n";
        }
        for (name, metrics) in &choice.verified {
            let error = error_of(metrics, wish.metric);
            let word = if error <= wish.max_error { "holds" } else { "does not hold" };
            out += &format!("  rendered {name}: {metric} {error:.4}, the bound {word}\n");
        }
    }
    out
}

/// For programs: one object a light.
pub(super) fn json(choices: &[Choice], wish: &Wish, device: &str, _: &Choose) -> String {
    choices.iter().map(|choice| format!("{}\n", one(choice, wish, device))).collect()
}

fn one(choice: &Choice, wish: &Wish, device: &str) -> Value {
    let chosen = match &choice.verdict {
        Verdict::Unshadowed(_) => Value::Null,
        Verdict::Met(p) | Verdict::Unmet(p) => {
            let c = &p.outlook.candidate;
            json!({
                "kind": c.kind, "options": c.options, "params": c.params, "splits": c.parts,
                "error": p.outlook.error, "bound": p.outlook.bound, "ms": p.milliseconds,
            })
        }
    };
    let verdict = match &choice.verdict {
        Verdict::Unshadowed(_) => "unshadowed",
        Verdict::Met(_) => "met",
        Verdict::Unmet(_) => "unmet",
    };
    let f = &choice.facts;
    let decisions: Vec<Value> = choice
        .decisions
        .iter()
        .map(|d| json!({"about": d.about, "choice": d.choice, "reason": d.reason, "bound": d.bound}))
        .collect();
    let errors = |(name, m): &(String, Metrics)| {
        let error = error_of(m, wish.metric);
        json!({"shadow": name, "error": error, "holds": error <= wish.max_error, "metrics": m})
    };
    json!({
        "schema": 1, "light": choice.light, "metric": wish.metric.name(), "max_error": wish.max_error,
        "budget_ms": wish.budget, "device": device, "verdict": verdict, "chosen": chosen,
        "judged": choice.judged, "within": choice.good, "unmodelled": choice.unmodelled, "decisions": decisions,
        "facts": {
            "lit": f.shares[0], "dark": f.shares[1], "penumbra": f.shares[2], "depth_low": f.depths[0],
            "depth_high": f.depths[1], "depth_variance": f.depths[2], "range_m": f.range, "layered": f.layered,
            "spread": f.spread, "bleeding": f.bleeding, "gap": f.gap, "behind": f.behind, "footprint": f.footprint,
            "penumbra_width": f.penumbra, "seen_m": f.seen, "split_demand": f.split_demand,
        },
        "verified": choice.verified.iter().map(errors).collect::<Vec<_>>(),
        "front": choice.front.iter().map(|m| json!({
            "shadow": m.name, "ms": m.milliseconds, "error": m.error, "front": m.on_front,
        })).collect::<Vec<_>>(),
    })
}
