//! Claims about devices that are made up, so that it is known what holds.

use super::*;
use crate::diagnostic::{Diagnostic, SourceText, has_errors};
use crate::study::{Machine, Role, Series, sheet};

const HYPOTHESES: &str = include_str!("hypotheses.ron");

/// Milliseconds of the light, filter and main pass of a method: from the side of its map, the megapixels of the frame, the
/// width of its filter and the triangles of the scene.
type Device = fn(&str, f64, f64, f64, f64) -> [f64; 3];

/// Reads per pixel, as the costs of a device that does nothing but read.
fn reads(method: &str) -> f64 {
    match method {
        "Shadow Map" => 1.0,
        "Bil. PCF 1x1 hardware" => 1.1,
        "Bil. PCF 1x1" => 2.0,
        "Bil. PCF 3x3 hardware" => 4.0,
        "PCF 3x3" => 5.0,
        "Bil. PCF 3x3" => 12.0,
        _ => 1.5,
    }
}

/// A device on which everything is as the hypotheses have it.
fn ideal(method: &str, side: f64, megapixels: f64, _: f64, triangles: f64) -> [f64; 3] {
    let texels = side * side / 1e6;
    let moments = if method.starts_with("VSM") { 1.5 } else { 1.0 };
    let filter = match method {
        "VSM 3x3" => 0.01 + 12.0 * texels,
        "SAT" => texels * side.log2(),
        _ => 0.0,
    };
    [moments * (0.2 + texels + triangles / 1e5), filter, 0.3 + reads(method) * megapixels]
}

/// A cell with a little noise, the same every time.
fn record(method: &str, (side, frame, width, triangles): (u32, (u32, u32), u32, usize), device: Device) -> Record {
    let megapixels = f64::from(frame.0 * frame.1) / 1e6;
    let times = device(method, f64::from(side), megapixels, f64::from(width), triangles as f64);
    let noise = |round: u32, seed: u32| 1.0 + f64::from((round * 7 + seed * 3) % 11) / 1100.0 - 0.0045;
    let series = |(name, role, x): (&str, Role, f64)| Series {
        name: name.into(),
        role,
        milliseconds: (0..15).map(|round| x * noise(round, side + frame.0)).collect(),
    };
    let passes = [
        ("key: depth", Role::Light, times[0]),
        ("key: blur x", Role::Filter, times[1]),
        ("main", Role::Main, times[2]),
    ];
    let mut settings = vec![("size", side.to_string())];
    if method == "SAT" {
        settings.push(("width", width.to_string()));
    }
    Record {
        cell: format!("{method}/{side}/{frame:?}/{width}/{triangles}"),
        case: format!("{triangles} triangles"),
        class: if triangles == 500 { "paper" } else { "triangles" }.into(),
        method: method.into(),
        settings: settings.into_iter().map(|(n, v)| (n.to_owned(), v)).collect(),
        frame,
        side: Some(side),
        triangles,
        passes: passes.into_iter().filter(|p| p.2 > 0.0).map(series).collect(),
        machine: Machine { adapter: "made up".into(), ..Machine::default() },
        ..Record::default()
    }
}

const METHODS: [&str; 8] = [
    "Shadow Map",
    "Bil. PCF 1x1",
    "Bil. PCF 1x1 hardware",
    "VSM",
    "PCF 3x3",
    "Bil. PCF 3x3",
    "Bil. PCF 3x3 hardware",
    "VSM 3x3",
];

/// What a study of the paper would measure.
fn records(device: Device) -> Vec<Record> {
    let wide = (1024, 768);
    let mut all = Vec::new();
    for method in METHODS {
        for side in [128, 256, 512, 1024] {
            all.push(record(method, (side, wide, 3, 500), device));
        }
        for frame in [(640, 480), (800, 600), (1280, 960)] {
            all.push(record(method, (512, frame, 3, 500), device));
        }
    }
    for width in [3, 5, 9, 17, 33, 65] {
        all.push(record("SAT", (512, wide, width, 500), device));
    }
    for side in [256, 1024] {
        all.push(record("SAT", (side, wide, 5, 500), device));
    }
    for triangles in [1, 1000, 100_000] {
        all.push(record("VSM 3x3", (512, wide, 3, triangles), device));
    }
    all
}

fn hypotheses() -> Vec<Claim> {
    let (sheet, found) = sheet::read(&SourceText::new("hypotheses.ron", HYPOTHESES));
    assert_eq!(found, []);
    sheet.claims
}

fn outcomes(records: &[Record]) -> Vec<(String, Outcome)> {
    judge(&hypotheses(), records).into_iter().map(|v| (v.id, v.outcome)).collect()
}

#[test]
fn all_hypotheses_hold_on_a_device_that_is_made_so() {
    let verdicts = judge(&hypotheses(), &records(ideal));
    for number in 1..=10 {
        let named = |v: &&Verdict| v.id.split(' ').next() == Some(&format!("H{number}"));
        assert!(verdicts.iter().any(|v| named(&v)), "H{number}");
    }
    for verdict in &verdicts {
        assert_eq!(verdict.outcome, Outcome::Held, "{verdict:#?}");
        for part in &verdict.parts {
            assert!(part.interval.0 <= part.value && part.value <= part.interval.1, "{part:?}");
            assert!(part.sure, "{}: {part:?}", verdict.id);
        }
    }
    // The order of records changes nothing.
    let mut turned = records(ideal);
    turned.reverse();
    assert_eq!(judge(&hypotheses(), &turned), verdicts);
}

/// Devices on which one thing is otherwise, and the claims that then fail; all others still hold.
#[test]
fn each_hypothesis_fails_where_the_device_is_otherwise() {
    let cases: [(&[&str], Device); 9] = [
        // Larger maps are slower to read.
        (&["H1"], |m, side, mp, w, t| {
            let [l, f, main] = ideal(m, side, mp, w, t);
            [l, f, if m == "PCF 3x3" { main * (1.0 + side / 5000.0) } else { main }]
        }),
        // A blur with a large fixed part: the law of growth fails, and its fit does not.
        (&["H2"], |m, side, mp, w, t| {
            let [l, f, main] = ideal(m, side, mp, w, t);
            [l, if m == "VSM 3x3" { f + 0.5 } else { f }, main]
        }),
        (&["H3"], |m, side, mp, w, t| {
            let [l, f, main] = ideal(m, side, mp, w, t);
            [l, if m == "VSM 3x3" { f * (1.0 + 0.1 * mp) } else { f }, main]
        }),
        (&["H4"], |m, side, mp, w, t| {
            let [l, f, main] = ideal(m, side, mp, w, t);
            [l, f, if m == "VSM 3x3" && mp < 0.4 { main * 3.0 } else { main }]
        }),
        (&["H5"], |m, side, mp, w, t| {
            ideal(if m == "Bil. PCF 3x3" { "Bil. PCF 3x3 hardware" } else { m }, side, mp, w, t)
        }),
        (&["H7", "H7 nearest", "H7 hardware"], |m, side, mp, w, t| {
            let [l, f, main] = ideal(m, side, mp, w, t);
            [l, f, if m == "VSM 3x3" { main + 20.0 * mp } else { main }]
        }),
        (&["H8"], |m, side, mp, w, t| {
            let [l, f, main] = ideal(m, side, mp, w, t);
            [if m == "VSM" { l * (1.0 + side / 1024.0) } else { l }, f, main]
        }),
        (&["H9 build", "H9 sampling"], |m, side, mp, w, t| {
            let [l, f, main] = ideal(m, side, mp, w, t);
            if m == "SAT" { [l, f * side, main + 0.01 * w] } else { [l, f, main] }
        }),
        (&["H10 filter", "H10 light"], |m, side, mp, w, t| {
            let [l, f, main] = ideal(m, side, mp, w, 500.0);
            [l - t / 1e6, if f > 0.0 { f + t / 1e5 } else { f }, main]
        }),
    ];
    for (failing, device) in cases {
        for (id, outcome) in outcomes(&records(device)) {
            let expected = if failing.contains(&id.as_str()) { Outcome::NotHeld } else { Outcome::Held };
            assert_eq!(outcome, expected, "{id} of {failing:?}");
        }
    }
}

#[test]
fn what_was_not_measured_is_not_held() {
    assert!(outcomes(&[]).iter().all(|(_, o)| *o == Outcome::NotMeasured));
    let without: Vec<Record> = records(ideal).into_iter().filter(|r| r.method != "PCF 3x3").collect();
    let verdicts = judge(&hypotheses(), &without);
    let h1 = verdicts.iter().find(|v| v.id == "H1").expect("there");
    assert_eq!(h1.outcome, Outcome::NotMeasured);
    assert!(h1.reason.contains("PCF 3x3") && !h1.parts.is_empty(), "{h1:?}");
    let failed: Vec<Record> =
        records(ideal).into_iter().map(|r| Record { failure: Some("lost".into()), ..r }).collect();
    assert!(outcomes(&failed).iter().all(|(_, o)| *o == Outcome::NotMeasured));
}

#[test]
fn the_crossing_and_the_fit_are_found() {
    let verdicts = judge(&hypotheses(), &records(ideal));
    let of = |id: &str| verdicts.iter().find(|v| v.id == id).expect("there").parts[0].clone();
    // Total times meet where 12 texels + light = reads: by hand between 512 and 1024.
    let crossing: f64 = of("H7").detail.rsplit(' ').next().and_then(|x| x.parse().ok()).expect("a place");
    assert!((700.0..1000.0).contains(&crossing), "{crossing}");
    assert!(of("H2").detail.contains("x^2") && of("H2").detail.contains("R² 1.0000"), "{}", of("H2").detail);
    assert!((of("H2").value - 4.0).abs() < 0.1, "{:?}", of("H2"));
}

fn found(text: &str) -> Vec<Diagnostic> {
    let source = SourceText::new("study.ron", text);
    let document = crate::ron::read(&source).0.expect("RON");
    let mut found = Vec::new();
    let methods = ["PCF".to_owned(), "VSM".to_owned()];
    read_claims(&document.root, &source, Some(&methods), &mut found);
    found
}

#[test]
fn mistakes_are_told_with_a_remedy() {
    let good = r#"[(id: "H1", kind: "constant", time: "main", over: "size", within: 0.1, methods: ["PCF"])]"#;
    assert_eq!(found(good), []);
    let cases = [
        ("\"constant\"", "\"constnat\"", "ST0650"),
        ("\"main\"", "\"mian\"", "ST0651"),
        ("[\"PCF\"]", "[\"PFC\"]", "ST0652"),
        ("[\"PCF\"]", "[\"PCF\"], to: \"VMS\"", "ST0652"),
        ("0.1", "-0.1", "ST0653"),
        ("\"H1\"", "\"\"", "ST0654"),
        ("within: 0.1, ", "", "ST0655"),
        ("over: \"size\", ", "", "ST0655"),
        ("\"constant\"", "\"crossing\"", "ST0655"),
        ("within: 0.1", "within: 0.1, least: 0.9", "ST0655"),
        ("within: 0.1", "within: 0.1, frame: (0, 5)", "ST0653"),
    ];
    for (from, to, code) in cases {
        let told = found(&good.replace(from, to));
        assert!(told.iter().any(|d| d.code == code && d.help.is_some()), "{from} -> {to}: {told:#?}");
        assert!(has_errors(&told));
    }
    assert_eq!(found(&good.replace("within: 0.1", "within: 0.1, colour: 1"))[0].code, "ST0010");
    let twice = good.replace("[(", &format!("[{}, (", good.trim_matches(['[', ']'])));
    assert_eq!(found(&twice)[0].code, "ST0654");
    assert_eq!(found("[7, \"x\"]").len(), 2);
}
