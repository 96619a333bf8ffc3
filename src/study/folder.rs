//! The files of a folder of results, and the reading of what was measured. Texts are given: nothing is read from disk here.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::Record;
use super::record::VERSION;
use crate::diagnostic::{Diagnostic, Place, SourceText, Span};

/// What was measured: one JSON object a line, a [`Record`].
pub const RESULTS: &str = "results.jsonl";
/// The study that it was measured for.
pub const STUDY: &str = "study.ron";
/// Most lines of one file that are complained of.
const MOST_REPORTED: usize = 20;

/// Reads the lines of a results file, with everything that is wrong with them. A last line that has no end is left out with
/// a warning.
pub fn parse(source: &Arc<SourceText>) -> (Vec<Record>, Vec<Diagnostic>) {
    let mut records: Vec<Record> = Vec::new();
    let mut known: BTreeMap<(String, String), usize> = BTreeMap::new();
    let mut found = Vec::new();
    let mut again: Option<(Place, String, usize)> = None;
    let mut start = 0;
    for line in source.text.split_inclusive('\n') {
        let place = Place::span(Span::new(source, start..start + line.trim_end().len()));
        start += line.len();
        if line.trim().is_empty() {
            continue;
        }
        match record(line) {
            Ok(record) => {
                let key = (record.cell.clone(), record.machine.adapter.clone());
                if let Some(&at) = known.get(&key) {
                    again.get_or_insert_with(|| (place, record.cell.clone(), 0)).2 += 1;
                    records[at] = record;
                } else {
                    known.insert(key, records.len());
                    records.push(record);
                }
            }
            Err(Wrong::Other(_)) if !line.ends_with('\n') => {
                let message = "the last line is cut off; its cell is left out";
                found.push(Diagnostic::warning("ST0663", message, place).help("run the study again: it goes on there"));
            }
            Err(Wrong::Version(version)) => {
                let message = format!("the results have version {version}; this program reads version {VERSION}");
                found.push(Diagnostic::error("ST0662", message, place).help("run the study again into a new folder"));
                // So will all the others be.
                break;
            }
            Err(Wrong::Other(why)) => {
                let message = format!("the line is not what was measured of a cell: {why}");
                found
                    .push(Diagnostic::error("ST0661", message, place).help("remove the line, and run the study again"));
                if found.len() >= MOST_REPORTED {
                    break;
                }
            }
        }
    }
    if let Some((place, cell, count)) = again {
        let lines = if count == 1 { "1 line measures".to_owned() } else { format!("{count} lines measure") };
        let message = format!("{lines} again what was measured before, first the cell `{cell}`");
        found.push(Diagnostic::warning("ST0666", message, place).help("the later measurement counts"));
    }
    (records, found)
}

enum Wrong {
    Version(u64),
    Other(String),
}

fn record(line: &str) -> Result<Record, Wrong> {
    #[derive(serde::Deserialize)]
    struct Versioned {
        version: u64,
    }
    let other = |error: serde_json::Error| {
        // The place within the line says little, and the line is one for people no more than for us.
        let text = error.to_string();
        Wrong::Other(text.split(" at line ").next().unwrap_or_default().to_owned())
    };
    let versioned: Versioned = serde_json::from_str(line).map_err(other)?;
    if versioned.version != u64::from(VERSION) {
        return Err(Wrong::Version(versioned.version));
    }
    serde_json::from_str(line).map_err(other)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(cell: &str) -> String {
        let record = Record { version: VERSION, cell: cell.into(), ..Record::default() };
        format!("{}\n", serde_json::to_string(&record).expect("JSON"))
    }

    fn read(text: String) -> (Vec<String>, Vec<&'static str>) {
        let (records, found) = parse(&SourceText::new(RESULTS, text));
        (records.into_iter().map(|r| r.cell).collect(), found.iter().map(|d| d.code).collect())
    }

    #[test]
    fn lines_are_cells_and_the_later_counts() {
        assert_eq!(read(line("a") + "\n" + &line("b")), (vec!["a".into(), "b".into()], vec![]));
        assert_eq!(read(line("a") + &line("b") + &line("a") + &line("a")).1, ["ST0666"]);
        assert_eq!(read(String::new()), (vec![], vec![]));
    }

    #[test]
    fn what_is_cut_off_is_left_out_and_what_is_wrong_is_told() {
        let whole = line("b");
        let cut = &whole[..whole.len() / 2];
        assert_eq!(read(line("a") + cut), (vec!["a".into()], vec!["ST0663"]));
        assert_eq!(read(line("a") + cut + "\n" + &line("c")).1, ["ST0661"]);
        assert_eq!(read("{}\n".into()).1, ["ST0661"]);
        assert_eq!(read(whole.replace("\"version\":1", "\"version\":2")).1, ["ST0662"]);
        assert_eq!(read("x\n".repeat(100)).1.len(), MOST_REPORTED);
        // A whole line without an end is a whole line.
        assert_eq!(read(whole.trim_end().into()), (vec!["b".into()], vec![]));
    }
}
