//! `chart`: what it writes, and folders that it refuses.

use std::path::Path;

use super::{Ran, names, put, run};
use crate::made_study::{ADAPTER, STUDY, lines, records, write};

fn chart(folder: &Path, more: &str) -> Ran {
    run(&format!("chart {} {more}", folder.display()))
}

#[test]
fn drawings_and_a_report_are_written() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path());
    let ran = chart(folder.path(), "").exits(0);
    assert!(ran.text().contains("one layer\n") && ran.text().contains("C2             not held: "), "{}", ran.text());
    let all = names(folder.path());
    let png = cfg!(feature = "render");
    assert_eq!(all.contains(&"chart.png".to_owned()), png);
    assert_eq!(ran.err.contains("no PNG"), !png);
    let page = std::fs::read_to_string(folder.path().join("report.html")).expect("written");
    assert!(page.matches("data:image/png;base64,").count() > 30 && page.contains("the truth"));
    let drawing = std::fs::read(folder.path().join("chart.svg")).expect("written");
    let again = folder.path().join("again.svg");
    chart(folder.path(), &format!("-o {}", again.display())).exits(0);
    assert_eq!(drawing, std::fs::read(again).expect("written"), "the same bytes");
}

#[test]
fn programs_are_told_fronts_and_verdicts() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path());
    let out = folder.path().join("x.html");
    let ran = chart(folder.path(), &format!("-o {} --format json --time ratio --error most", out.display())).exits(0);
    let data: serde_json::Value = serde_json::from_str(ran.text()).expect("JSON");
    assert_eq!((data["schema"].as_u64(), data["chart"]["time"].as_str()), (Some(1), Some("ratio")));
    assert!(data["panels"][0]["front"].as_array().is_some_and(|f| !f.is_empty()));
    assert_eq!(data["claims"].as_array().map(Vec::len), Some(4));
    assert_eq!(names(folder.path()), ["pictures", "results.jsonl", "study.ron", "x.html"]);
}

#[test]
fn what_is_no_folder_of_results_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    chart(&path.join("none"), "").exits(3).says("ST0501").no_data();
    chart(path, "").exits(1).says("ST0660").says("there is no results.jsonl").no_data();
    put(path, "results.jsonl", "");
    chart(path, "").exits(1).says("ST0660").says("holds no cell");
    chart(&path.join("results.jsonl"), "").exits(1).says("is a file");
    put(path, "results.jsonl", "{\"a\": 1}\n");
    chart(path, "").exits(1).says("ST0661").says("results.jsonl:1:1");
    let good = lines(&records()[..8]);
    put(path, "results.jsonl", &good.replace("\"version\":1,", "\"version\":9,"));
    chart(path, "").exits(1).says("ST0662").says("version 9");
    put(path, "results.jsonl", &good[..good.len() - 20]);
    chart(path, "").exits(0).says("ST0663");
    put(path, "study.ron", "Graph()");
    chart(path, "").exits(1).says("ST0667");
    assert!(!path.join("none").exists());
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path();
    let mut some = records()[..8].to_vec();
    let mut other = some.clone();
    other.iter_mut().for_each(|r| r.machine.adapter = "Other".into());
    put(path, "results.jsonl", &(lines(&some) + &lines(&other)));
    chart(path, "").exits(1).says("ST0664").says(ADAPTER).says("--adapter");
    chart(path, "--adapter other").exits(0);
    chart(path, "--adapter missing").exits(1).says("ST0664").says("missing");
    some.iter_mut().for_each(|r| r.errors.clear());
    put(path, "results.jsonl", &lines(&some));
    chart(path, "").exits(1).says("ST0665");
    // Times are enough for claims.
    put(path, "study.ron", STUDY);
    let told = chart(path, "").exits(0).says("warning[ST0665]");
    assert!(told.text().contains("C1 ") && names(path).contains(&"report.html".to_owned()), "{}", told.text());
    chart(path, &format!("-o {}", path.join("a.svg").display())).exits(1).says("error[ST0665]");
    std::fs::remove_file(path.join("study.ron")).expect("there");
    chart(path, "-o x.pdf").exits(2).says("neither an .svg");
    chart(path, "--error many").exits(2);
    let told = chart(path, "--format json").exits(1);
    assert_eq!(told.diagnostics()[0]["code"], "ST0665");
}
