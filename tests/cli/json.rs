//! `--format json`: failures too are objects, one a line, whoever finds them.

use super::{LIGHT, SURFACE, names, put, run, run_fed};

#[test]
fn mistakes_carry_code_file_line_column_node_and_port() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = "Graph(\n    version: 1,\n    nodes: {\n        \"m\": (kind: \"lambert\", params: {\"albedo\": true}),\n    },\n)\n";
    let file = put(folder.path(), "g.ron", text);
    let ran = run(&format!("check --format json {LIGHT} {file}")).exits(1);
    let found = ran.diagnostics();
    let wrong = found.iter().find(|d| d["code"] == "ST0204").unwrap_or_else(|| panic!("{found:?}"));
    assert_eq!(wrong["file"], file.as_str());
    assert_eq!((wrong["line"].as_u64(), wrong["column"].as_u64()), (Some(4), Some(51)));
    assert_eq!(wrong["end"], serde_json::json!({"line": 4, "column": 55}));
    assert_eq!((wrong["node"].as_str(), wrong["port"].as_str()), (Some("m"), Some("albedo")));
    assert!(wrong["help"].is_string());
}

#[test]
fn each_kind_of_failure_is_json() {
    let folder = tempfile::tempdir().expect("a folder");
    let base = folder.path().display();
    for (line, exit, code) in [
        (format!("check {base}/none.ron"), 3, "ST0501"),
        (format!("check {base}"), 3, "ST0502"),
        (format!("generate {LIGHT} {SURFACE} -o {base}/no/a.wgsl"), 3, "ST0505"),
        (format!("generate {LIGHT} {SURFACE} -o {base}/a.txt"), 2, "ST0500"),
        (format!("generate {LIGHT} {SURFACE} --set x.y=1"), 1, "ST0511"),
        ("generate".into(), 2, "ST0500"),
        ("generate --no-such-flag x".into(), 2, "ST0500"),
        ("paint".into(), 2, "ST0500"),
        ("render x.ron -o a.jpg".into(), 2, "ST0500"),
        ("render x.ron -o a.png --size 0x0".into(), 2, "ST0500"),
        ("render x.ron -o a.png --aov nothing".into(), 2, "ST0500"),
        ("explain ST9999".into(), 1, "ST0517"),
        ("nodes no_such_node_at_all".into(), 1, "ST0516"),
        ("completions tcsh".into(), 2, "ST0500"),
        (format!("new {base}/no/such"), 3, "ST0505"),
        (format!("fmt {base}/none.ron"), 3, "ST0501"),
    ] {
        for line in [format!("{line} --format json"), format!("--format=json {line}")] {
            let ran = run(&line).exits(exit).no_data();
            let found = ran.diagnostics();
            assert_eq!(found.iter().map(|d| d["code"].as_str()).collect::<Vec<_>>(), [Some(code)], "{line}");
        }
    }
    assert_eq!(names(folder.path()), [""; 0]);
}

#[test]
fn a_misused_format_is_a_usage_error_as_text() {
    run("check --format xml a.ron").exits(2).says("possible values");
    // Without a command, where that does not mean the editor, there is still a failure to tell of.
    if cfg!(not(feature = "gui")) {
        assert_eq!(run("--format json").exits(2).no_data().diagnostics().len(), 1);
    }
}

#[test]
fn messages_for_people_stay_out_of_json() {
    let ran = run(&format!("check --format json -v {LIGHT} {SURFACE}")).exits(0);
    assert_eq!(ran.err, "");
    let summary: serde_json::Value = serde_json::from_str(ran.text()).expect("JSON");
    assert_eq!(summary, serde_json::json!({"schema": 1, "ok": true, "shaders": 1}));
    let ran = run_fed("check --format json -", b"Graph(version: 1, nodes: {\"a\": (kind: \"lambert\")})").exits(0);
    let found = ran.diagnostics();
    assert_eq!((found.len(), found[0]["severity"].as_str()), (1, Some("warning")));
}

#[test]
fn listings_are_json_too() {
    for line in
        ["doctor --format json", "nodes --format json", "nodes glass --format json", "explain ST0501 --format json"]
    {
        let ran = run(line).exits(0);
        assert!(serde_json::from_str::<serde_json::Value>(ran.text()).is_ok(), "{line}: {}", ran.text());
    }
    for line in run("explain --format json").exits(0).text().lines() {
        assert!(serde_json::from_str::<serde_json::Value>(line).is_ok(), "{line}");
    }
}
