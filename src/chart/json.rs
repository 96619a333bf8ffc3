//! Fronts and verdicts for programs.

use serde_json::{Value, json};

use super::data::Chart;
use super::front::{ERRORS, budgets, name};
use super::report::Report;
use crate::study::front::{best_within, cheapest_within};

/// What a report comes to.
pub fn json(report: &Report<'_>) -> Value {
    let chart = report.chart;
    let panels: Vec<Value> = chart
        .panels
        .iter()
        .map(|panel| {
            let point = |i: usize| {
                let point = &panel.points[i];
                json!({
                    "cell": point.record.cell,
                    "method": chart.methods[point.method],
                    "settings": point.record.settings,
                    "time": point.time,
                    "error": point.error,
                    "bits": point.record.bits,
                })
            };
            let places = panel.places();
            let winner = |i: Option<usize>| {
                i.map(|i| json!({"name": name(chart, panel, i), "cell": panel.points[i].record.cell}))
            };
            let within_time: Vec<Value> = budgets(chart)
                .into_iter()
                .map(|b| json!({"time": b, "winner": winner(best_within(&places, &panel.front, b))}))
                .collect();
            let within_error: Vec<Value> = ERRORS
                .iter()
                .map(|e| json!({"error": e, "winner": winner(cheapest_within(&places, &panel.front, *e))}))
                .collect();
            json!({
                "class": panel.class,
                "case": panel.points.first().map(|p| p.record.case.clone()),
                "points": panel.points.len(),
                "front": panel.front.iter().map(|i| point(*i)).collect::<Vec<_>>(),
                "within_time": within_time,
                "within_error": within_error,
            })
        })
        .collect();
    json!({
        "schema": 1,
        "study": report.title,
        "machine": chart.machine,
        "chart": about(chart),
        "panels": panels,
        "claims": report.verdicts,
        "published": report.comparisons,
        "failures": report.records.iter().filter_map(|r| Some(json!({"cell": r.cell, "why": r.failure.as_ref()?}))).collect::<Vec<_>>(),
    })
}

fn about(chart: &Chart<'_>) -> Value {
    json!({
        "time": format!("{:?}", chart.choice.time).to_lowercase(),
        "error": chart.choice.metric.name,
        "region": chart.choice.region,
        "reference": chart.reference,
        "frame": chart.frame,
    })
}
