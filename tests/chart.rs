//! Charts and reports of results that are made up: what is on them, and that they come out the same.

use shadetree::chart::{Chart, Choice, Metric, Report, Time, html, json, svg};
use shadetree::study::Record;
use shadetree::study::claims::{Outcome, judge};
use shadetree::{diagnostic::SourceText, study::sheet};

use crate::made_study::{STUDY, records};
use crate::support::expect_file;

fn report(records: &[Record], choice: &Choice) -> (String, String, serde_json::Value) {
    let chart = Chart::new(records, choice).expect("a chart");
    let (sheet, found) = sheet::read(&SourceText::new("study.ron", STUDY));
    assert_eq!(found, []);
    let verdicts = judge(&sheet.claims, records);
    let outcomes: Vec<Outcome> = verdicts.iter().map(|v| v.outcome).collect();
    assert_eq!(outcomes, [Outcome::Held, Outcome::NotHeld, Outcome::Held, Outcome::NotMeasured]);
    let comparisons: Vec<_> = sheet.published.iter().map(|t| t.compare(records)).collect();
    let report = Report {
        chart: &chart,
        records,
        title: &sheet.title,
        note: &sheet.note,
        verdicts: &verdicts,
        comparisons: &comparisons,
    };
    (svg(&chart, &sheet.title), html(&report, &|_| None), json(&report))
}

/// Enough for a drawing that can be looked at, and little enough to keep.
fn few() -> Vec<Record> {
    let methods = ["Shadow Map", "PCF", "VSM", "ESM"];
    let classes = ["one layer", "contact"];
    records()
        .into_iter()
        .filter(|r| methods.contains(&r.method.as_str()) && classes.contains(&r.class.as_str()))
        .collect()
}

#[test]
fn a_chart_is_as_expected() {
    let few = few();
    let chart = Chart::new(&few, &Choice::default()).expect("a chart");
    expect_file("tests/golden/chart/two_classes.svg", svg(&chart, "Two classes").as_bytes());
    let ratio = Choice {
        time: Time::Ratio,
        metric: Metric::named("percentile_99").expect("known"),
        region: "penumbra".into(),
        ..Choice::default()
    };
    let one: Vec<Record> = few.into_iter().filter(|r| r.class == "contact").collect();
    let chart = Chart::new(&one, &ratio).expect("a chart");
    expect_file("tests/golden/chart/one_class.svg", svg(&chart, "").as_bytes());
}

#[test]
fn fronts_hold_what_nothing_beats() {
    let records = records();
    let chart = Chart::new(&records, &Choice::default()).expect("a chart");
    assert_eq!((chart.panels.len(), chart.methods.len(), chart.frame), (6, 12, (320, 180)));
    for panel in &chart.panels {
        let places = panel.places();
        let beats = |a: (f64, f64), b: (f64, f64)| a.0 <= b.0 && a.1 <= b.1 && a != b;
        for (i, place) in places.iter().enumerate() {
            let beaten = places.iter().any(|other| beats(*other, *place));
            assert_eq!(panel.front.contains(&i), !beaten, "{} {i}", panel.class);
        }
        // A curve a width, along the size of the map.
        let pcf = chart.methods.iter().position(|m| m == "PCF").expect("there");
        let curves: Vec<_> = panel.curves.iter().filter(|c| c.method == pcf).collect();
        assert_eq!(curves.len(), 3);
        for curve in curves {
            let labels: Vec<&str> = curve.points.iter().map(|i| panel.points[*i].label.as_str()).collect();
            assert!(labels[0].starts_with("256 · ") && labels[3].starts_with("2048 · "), "{labels:?}");
        }
    }
    assert!(chart.has_zero(), "one is exact");
    // What failed is on no chart.
    let contact = chart.panels.iter().find(|p| p.class == "contact").expect("there");
    assert_eq!(contact.points.len(), chart.panels[1].points.len() - 1);
}

#[test]
fn reports_say_what_there_is_and_come_out_the_same() {
    let records = records();
    let all = report(&records, &Choice::default());
    assert_eq!(all, report(&records, &Choice::default()));
    let (drawing, page, data) = all;
    for part in ["computes on the CPU", "15 rounds", "llvmpipe", "time of all passes, ms", "RMS error"] {
        assert!(drawing.contains(part), "{part}");
    }
    for part in [
        "Who wins",
        "Claims",
        "not measured",
        "Beside what was published",
        "the device ran out of memory",
        "maps have 16 bits",
        "penumbra",
        "shadetree 0.1.0",
        "256 rays a pixel",
    ] {
        assert!(page.contains(part), "{part}");
    }
    for foreign in ["http://", "https://", "<script", "@import", "url("] {
        let own = page.replace("http://www.w3.org/2000/svg", "");
        assert!(!own.contains(foreign), "{foreign}");
    }
    assert_eq!(data["panels"].as_array().map(Vec::len), Some(6));
    assert_eq!(data["claims"][1]["outcome"], "not_held");
}

/// Names come from files, and must not become markup.
#[test]
fn names_stay_words() {
    let mut records = few();
    for record in &mut records {
        record.method = format!("<b>&\"{}\"", record.method);
        record.class = "<script>".into();
        record.case = "</svg>".into();
        record.machine.adapter = "<i>".repeat(200);
        record.settings.insert("size".into(), "<u>".into());
        record.messages.push("<img src=x>".into());
    }
    let chart = Chart::new(&records, &Choice::default()).expect("a chart");
    let drawing = svg(&chart, "<title>");
    let none = [];
    let whole =
        Report { chart: &chart, records: &records, title: "<x>", note: "<y>", verdicts: &none, comparisons: &[] };
    let page = html(&whole, &|_| None);
    for tag in ["<script>", "<i>", "<u>", "<img src=x", "<x>", "<y>"] {
        assert!(!page.contains(tag) && !drawing.contains(tag), "{tag}");
    }
    assert!(!drawing.contains("<b>") && drawing.matches("</svg>").count() == 1);
}

#[test]
fn odd_numbers_are_drawn_or_left_out() {
    let mut records = few();
    records.truncate(6);
    records[0].passes[0].milliseconds = vec![1e300; 15];
    records[1].passes[0].milliseconds = vec![1e-300; 15];
    records[2].passes[0].milliseconds = vec![f64::NAN; 15];
    records[3].errors.get_mut("rays").expect("there").regions.get_mut("all").expect("there").rms = f64::INFINITY;
    records[4].passes.clear();
    records[5].bits = None;
    let chart = Chart::new(&records, &Choice::default()).expect("a chart");
    assert_eq!(chart.panels[0].points.len(), 3);
    let drawing = svg(&chart, "odd");
    assert!(!drawing.contains("NaN") && !drawing.contains("inf"), "{drawing}");
    records.iter_mut().for_each(|r| r.errors.clear());
    assert!(Chart::new(&records, &Choice::default()).is_none());
}

/// The drawing is well-formed, nothing lies outside of it, and words do not touch.
#[cfg(feature = "render")]
#[test]
fn nothing_is_cut_off() {
    use resvg::usvg;
    let records = records();
    for metric in ["rms", "over_step", "most"] {
        let choice = Choice { metric: Metric::named(metric).expect("known"), ..Choice::default() };
        let chart = Chart::new(&records, &choice).expect("a chart");
        let text = svg(&chart, "A title of some length, as people give them to their studies");
        let mut options = usvg::Options::default();
        options.fontdb_mut().load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
        options.font_family = "Ubuntu".into();
        let tree = usvg::Tree::from_str(&text, &options).expect("well-formed");
        let (size, all) = (tree.size(), tree.root().abs_stroke_bounding_box());
        assert!(all.left() >= 0.0 && all.top() >= 0.0, "{all:?}");
        assert!(all.right() <= size.width() + 0.5 && all.bottom() <= size.height() + 0.5, "{all:?} in {size:?}");
        let mut words = Vec::new();
        boxes(tree.root(), &mut words);
        assert!(words.len() > 60, "{}", words.len());
        for (i, (a, what)) in words.iter().enumerate() {
            for (b, other) in &words[i + 1..] {
                let apart =
                    a.right() <= b.left() || b.right() <= a.left() || a.bottom() <= b.top() || b.bottom() <= a.top();
                assert!(apart, "{metric}: `{what}` and `{other}` touch: {a:?} {b:?}");
            }
        }
    }
}

#[cfg(feature = "render")]
fn boxes(group: &resvg::usvg::Group, found: &mut Vec<(resvg::tiny_skia::Rect, String)>) {
    use resvg::usvg::Node;
    for node in group.children() {
        match node {
            Node::Group(group) => boxes(group, found),
            Node::Text(text) => {
                let words: String = text.chunks().iter().map(|c| c.text()).collect();
                // Ascent and descent are in the box whether letters have them or not.
                let b = text.abs_bounding_box();
                let shrunk = resvg::tiny_skia::Rect::from_ltrb(b.left(), b.top() + 2.0, b.right(), b.bottom() - 2.0);
                found.extend(shrunk.map(|b| (b, words)));
            }
            _ => {}
        }
    }
}
