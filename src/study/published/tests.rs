//! A published table beside measurements that are made up.

use super::*;
use crate::study::{Role, Series, sheet};

fn table() -> Published {
    let text = r#"Study(published: [(title: "T", unit: "fps", plain: "Plain", vary: "size", columns: ["128", "256"],
        rows: {"Plain": [300, 200], "Soft": [100, 100], "Quick": [200, 150]})])"#;
    let (sheet, found) = sheet::read(&SourceText::new("study.ron", text));
    assert_eq!(found, []);
    sheet.published[0].clone()
}

fn record(method: &str, size: u32, total: f64, plain: Option<f64>) -> Record {
    Record {
        cell: format!("{method} {size}"),
        method: method.into(),
        settings: [("size".to_owned(), size.to_string())].into(),
        passes: vec![Series {
            name: "main".into(),
            role: Role::Main,
            milliseconds: vec![total * 0.9, total, total * 1.1],
        }],
        plain: plain.map(|x| vec![x * 0.9, x, x * 1.1]).unwrap_or_default(),
        ..Record::default()
    }
}

#[test]
fn ratios_stand_side_by_side() {
    let records = [
        record("Plain", 128, 2.0, Some(2.0)),
        record("Soft", 128, 5.0, Some(2.0)),
        record("Quick", 128, 7.0, None),
        record("Other", 256, 3.0, Some(2.0)),
    ];
    let comparison = table().compare(&records);
    let names: Vec<&str> = comparison.rows.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["Plain", "Soft", "Quick", "Other"]);
    let pair = |row: usize, column: usize| comparison.rows[row].1[column];
    assert_eq!((pair(0, 0).published, pair(1, 0).published, pair(1, 1).published), (Some(1.0), Some(3.0), Some(2.0)));
    let near = |x: Option<f64>, y: f64| x.is_some_and(|x| (x - y).abs() < 1e-9);
    // Of the same rounds, so that their noise goes out; else of the medians.
    assert!(near(pair(1, 0).measured, 2.5) && near(pair(2, 0).measured, 3.5), "{comparison:?}");
    let interval = pair(1, 0).interval.expect("an interval");
    assert!((interval.0 - 2.5).abs() < 1e-9 && (interval.1 - 2.5).abs() < 1e-9);
    assert_eq!((pair(1, 1).measured, pair(3, 0).published), (None, None));
    assert!(near(pair(3, 1).measured, 1.5));
    // Plain before both others as published; Quick before Soft there, and after it here.
    assert_eq!(comparison.agreement, [(2, 3), (0, 0)]);
}

#[test]
fn milliseconds_are_ratios_the_other_way_round() {
    let mut table = table();
    table.unit = Unit::Ms;
    assert_eq!(table.ratios(&[600.0, 100.0]), [Some(2.0), Some(0.5)]);
    assert_eq!(frame("640x480"), Some((640, 480)));
    assert_eq!((column("640x480", "frame"), column("x", "size")), (Some(307_200.0), None));
}

#[test]
fn mistakes_are_told_with_a_remedy() {
    let good = r#"[(unit: "fps", plain: "A", vary: "frame", columns: ["64x48"], rows: {"A": [3]})]"#;
    let told = |text: &str| {
        let source = SourceText::new("study.ron", text);
        let mut found = Vec::new();
        let methods = ["A".to_owned()];
        read_published(&crate::ron::read(&source).0.expect("RON").root, &source, Some(&methods), &mut found);
        found
    };
    assert_eq!(told(good), []);
    let cases = [
        ("\"fps\"", "\"hz\"", "ST0656"),
        ("[3]", "[3, 4]", "ST0657"),
        ("[3]", "[0]", "ST0657"),
        ("plain: \"A\"", "plain: \"B\"", "ST0657"),
        ("vary: \"frame\", ", "", "ST0657"),
        ("64x48", "64", "ST0658"),
        ("{\"A\"", "{\"B\": [1], \"A\"", "ST0652"),
    ];
    for (from, to, code) in cases {
        let found = told(&good.replace(from, to));
        assert!(found.iter().any(|d| d.code == code && d.help.is_some()), "{from} -> {to}: {found:#?}");
    }
}
