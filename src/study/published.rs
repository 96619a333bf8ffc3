//! Tables that others have published, beside what was measured here: as ratios to a plain shadow map, because times of other
//! devices mean nothing.

use std::sync::Arc;

use serde::Serialize;

use super::Record;
use super::claims::known_method;
use super::reading::Reader;
use super::resample::intervals;
use super::select::{Filter, Quantity, position};
use super::statistics::median;
use crate::diagnostic::{Diagnostic, SourceText};
use crate::ron::{Node, field};

/// What a published number is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Unit {
    /// Frames a second.
    #[default]
    Fps,
    /// Milliseconds a frame.
    Ms,
}

/// A table of times.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Published {
    /// What it is called.
    pub title: String,
    /// Where it was published.
    pub source: String,
    /// What it was measured on.
    pub device: String,
    /// What its numbers are.
    pub unit: Unit,
    /// The method that the others are compared with: one of the rows.
    pub plain: String,
    /// What varies from column to column: `frame`, or the name of a setting.
    pub vary: String,
    /// Heads of the columns: `640x480` where the frame varies.
    pub columns: Vec<String>,
    /// Which records are set beside it.
    pub only: Filter,
    /// Numbers by method, in the order of the file.
    pub rows: Vec<(String, Vec<f64>)>,
}

/// Two ratios to the plain shadow map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Pair {
    /// As published.
    pub published: Option<f64>,
    /// As measured: the median over the rounds.
    pub measured: Option<f64>,
    /// Ends of the interval of what was measured.
    pub interval: Option<(f64, f64)>,
}

/// A published table beside measurements.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Comparison {
    /// The table.
    pub published: Published,
    /// By method: the rows of the table first, then others that were measured at its places.
    pub rows: Vec<(String, Vec<Pair>)>,
    /// By column: of the pairs of methods that the table tells apart, how many come in the same order here, and how many
    /// there are.
    pub agreement: Vec<(usize, usize)>,
}

impl Published {
    /// Ratios of the times of a row to those of the plain method.
    fn ratios(&self, row: &[f64]) -> Vec<Option<f64>> {
        let plain = self.rows.iter().find(|(name, _)| *name == self.plain).map(|(_, numbers)| numbers);
        let ratio = |(i, x): (usize, &f64)| {
            let plain = plain?.get(i)?;
            Some(match self.unit {
                Unit::Fps => plain / x,
                Unit::Ms => x / plain,
            })
        };
        row.iter().enumerate().map(ratio).collect()
    }

    /// Sets measurements beside the table.
    pub fn compare(&self, records: &[Record]) -> Comparison {
        let places: Vec<Option<f64>> = self.columns.iter().map(|c| column(c, &self.vary)).collect();
        let mut methods: Vec<String> = self.rows.iter().map(|(name, _)| name.clone()).collect();
        let here = |r: &&Record| {
            self.only.takes(r)
                && (self.vary != "frame" || places.iter().flatten().any(|p| position(r, "frame") == Some(*p)))
        };
        let mut others: Vec<String> = records.iter().filter(here).map(|r| r.method.clone()).collect();
        others.sort();
        others.dedup();
        methods.extend(others.into_iter().filter(|name| self.rows.iter().all(|(n, _)| n != name)));
        let row = |method: &String| {
            let published = self.rows.iter().find(|(n, _)| n == method).map(|(_, numbers)| self.ratios(numbers));
            let pair = |(i, place): (usize, &Option<f64>)| {
                let measured = place.and_then(|place| self.measured(records, method, place, i));
                Pair {
                    published: published.as_ref().and_then(|p| *p.get(i)?),
                    measured: measured.map(|m| m.0),
                    interval: measured.map(|m| m.1),
                }
            };
            (method.clone(), places.iter().enumerate().map(pair).collect::<Vec<Pair>>())
        };
        let mut rows: Vec<_> = methods.iter().map(row).collect();
        rows.retain(|(_, pairs)| pairs.iter().any(|p| p.published.is_some() || p.measured.is_some()));
        let agreement = (0..places.len()).map(|i| agreement(&rows, i)).collect();
        Comparison { published: self.clone(), rows, agreement }
    }

    /// The median ratio of a method at a place to the plain shadow map there, and its interval.
    fn measured(&self, records: &[Record], method: &str, place: f64, i: usize) -> Option<(f64, (f64, f64))> {
        let at = |name: &str| {
            let there = |r: &&Record| {
                r.method == name
                    && self.only.takes(r)
                    && position(r, &self.vary) == Some(place)
                    && (self.vary != "frame" || frame(&self.columns[i]) == Some(r.frame))
            };
            records.iter().filter(there).min_by(|a, b| a.cell.cmp(&b.cell))
        };
        let record = at(method)?;
        // Of the same rounds where they are known, else of what was measured of the plain method elsewhere.
        if let Some(ratios) = record.ratios() {
            let interval = *intervals(&[&ratios], |m| vec![m[0]]).first()?;
            return Some((median(&ratios), interval));
        }
        let total = |r: &Record| Quantity::Total.of(r, None).or_else(|| Quantity::Wall.of(r, None));
        let (own, plain) = (total(record)?, total(at(&self.plain)?)?);
        let interval = *intervals(&[&own, &plain], |m| vec![m[0] / m[1]]).first()?;
        Some((median(&own) / median(&plain), interval))
    }
}

/// How many pairs of methods come in the same order, of those that were published with different ratios and measured.
fn agreement(rows: &[(String, Vec<Pair>)], column: usize) -> (usize, usize) {
    let both: Vec<(f64, f64)> =
        rows.iter().filter_map(|(_, pairs)| Some((pairs[column].published?, pairs[column].measured?))).collect();
    let (mut same, mut all) = (0, 0);
    for (i, a) in both.iter().enumerate() {
        for b in &both[i + 1..] {
            if a.0 != b.0 {
                all += 1;
                same += usize::from((a.0 < b.0) == (a.1 < b.1));
            }
        }
    }
    (same, all)
}

/// Columns and rows of a frame written `640x480`.
fn frame(text: &str) -> Option<(u32, u32)> {
    let (columns, rows) = text.split_once('x')?;
    Some((columns.trim().parse().ok()?, rows.trim().parse().ok()?))
}

/// Where a column lies along what varies.
fn column(text: &str, vary: &str) -> Option<f64> {
    match vary {
        "frame" => frame(text).map(|(columns, rows)| f64::from(columns) * f64::from(rows)),
        _ => text.trim().parse::<f64>().ok().filter(|x| x.is_finite()),
    }
}

/// Reads a list of tables. `methods` are those that the study has; without them none is questioned.
pub fn read_published(
    node: &Node,
    source: &Arc<SourceText>,
    methods: Option<&[String]>,
    found: &mut Vec<Diagnostic>,
) -> Vec<Published> {
    let mut reader = Reader { source, found };
    let items = reader.take(node.as_list(source)).unwrap_or_default();
    items.iter().filter_map(|item| table(item, methods, &mut reader)).collect()
}

fn table(node: &Node, methods: Option<&[String]>, reader: &mut Reader<'_>) -> Option<Published> {
    const KNOWN: [&str; 11] =
        ["title", "source", "device", "unit", "plain", "vary", "columns", "frame", "class", "settings", "rows"];
    let fields = reader.fields(node, "a table `(title: ..., vary: \"size\", columns: [...], rows: {...})`", &KNOWN)?;
    let words = [("fps", Unit::Fps), ("ms", Unit::Ms)];
    let unit = reader.word(fields, "unit", ("ST0656", "unit"), &words).unwrap_or_default();
    let vary = reader.text(fields, "vary").unwrap_or_default();
    if vary.is_empty() {
        reader.error("ST0657", "the table does not say what varies", node, "add `vary: \"size\"` or `vary: \"frame\"`");
    }
    let columns = reader.texts(fields, "columns");
    for (text, at) in columns.iter().filter(|(text, _)| !vary.is_empty() && column(text, &vary).is_none()) {
        let help = if vary == "frame" { "write it as `640x480`" } else { "write a number" };
        reader.error("ST0658", format!("the column `{text}` is at no place along `{vary}`"), at, help);
    }
    let mut rows: Vec<(String, Vec<f64>)> = Vec::new();
    for (key, value) in reader.get(fields, "rows", Node::as_map).unwrap_or_default() {
        let name = reader.take(key.as_str(reader.source)).map(str::to_owned);
        let numbers = reader.take(value.as_numbers(reader.source));
        let (Some(name), Some(numbers)) = (name, numbers) else { continue };
        known_method(&name, key, methods, reader);
        if numbers.len() != columns.len() {
            let message = format!("the row has {} numbers, and the table {} columns", numbers.len(), columns.len());
            reader.error("ST0657", message, value, "write a number for each column");
        } else if numbers.iter().any(|x| *x <= 0.0) {
            reader.error("ST0657", "a time or rate is not above 0", value, "write what was published");
        } else {
            rows.push((name, numbers));
        }
    }
    let plain = reader.text(fields, "plain").unwrap_or_default();
    if rows.iter().all(|(name, _)| *name != plain) {
        let help = "name one of the rows: `plain: \"Shadow Map\"`";
        reader.error(
            "ST0657",
            "no row is what the others are compared with",
            field(fields, "plain").unwrap_or(node),
            help,
        );
    }
    Some(Published {
        title: reader.text(fields, "title").unwrap_or_default(),
        source: reader.text(fields, "source").unwrap_or_default(),
        device: reader.text(fields, "device").unwrap_or_default(),
        unit,
        plain,
        vary,
        columns: columns.into_iter().map(|(text, _)| text).collect(),
        only: reader.filter(fields),
        rows,
    })
}

#[cfg(test)]
mod tests;
