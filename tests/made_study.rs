//! Results of a study that was never run: times and errors by simple laws, so that charts of them can be judged.

use std::collections::BTreeMap;
use std::path::Path;

use shadetree::reference::Metrics;
use shadetree::study::record::VERSION;
use shadetree::study::{Errors, Machine, Record, Role, Series};

/// A method: name, kind, bits of a texel, what a pixel and a megatexel of filtering cost in milliseconds, widths.
type Method = (&'static str, &'static str, u32, f64, f64, &'static [u32]);

const METHODS: [Method; 12] = [
    ("Shadow Map", "hard_shadow", 32, 1.0, 0.0, &[1]),
    ("PCF", "pcf_shadow", 32, 0.6, 0.0, &[3, 5, 9]),
    ("Disc PCF", "disc_shadow", 32, 3.0, 0.0, &[16]),
    ("PCSS", "pcss_shadow", 32, 9.0, 0.0, &[16]),
    ("Adaptive PCF", "adaptive_pcf_shadow", 32, 4.0, 0.0, &[5]),
    ("VSM", "variance_shadow", 64, 1.6, 3.0, &[5]),
    ("VSM, 16 bits", "variance_shadow", 32, 1.5, 2.0, &[5]),
    ("ESM", "exponential_shadow", 16, 1.2, 1.5, &[5]),
    ("EVSM4", "exponential_variance_shadow", 128, 2.1, 6.0, &[5]),
    ("MSM4", "moment_shadow", 64, 2.4, 4.0, &[5]),
    ("SAT", "summed_area_shadow", 64, 2.8, 14.0, &[5, 17]),
    ("SAT, soft", "summed_area_soft_shadow", 64, 6.0, 14.0, &[17]),
];

/// Classes of scenes, with how far off each kind of method is there.
const CLASSES: [(&str, f64, f64, f64); 6] = [
    ("one layer", 0.002, 0.0, 0.01),
    ("two layers", 0.004, 0.16, 0.02),
    ("many layers", 0.006, 0.17, 0.06),
    ("contact", 0.02, 0.09, 0.3),
    ("receiver edge", 0.008, 0.19, 0.13),
    ("grazing slope", 0.03, 0.012, 0.02),
];

/// The name of the adapter.
pub const ADAPTER: &str = "llvmpipe (made up)";

/// Rounds around a value: spread a little, with one that lies far off in every second cell.
fn rounds(value: f64, seed: u32) -> Vec<f64> {
    let wobble = |i: u32| f64::from((i * 37 + seed * 11) % 23) / 23.0 - 0.5;
    let far = |i: u32| if seed.is_multiple_of(2) && i == 4 { 1.8 } else { 1.0 };
    (0..15).map(|i| value * (1.0 + 0.03 * wobble(i)) * far(i)).collect()
}

/// Every cell.
pub fn records() -> Vec<Record> {
    let mut all = Vec::new();
    for (class, pcf, moments, other) in CLASSES {
        for (method, kind, bits, pixel, filter, widths) in METHODS {
            for &width in widths {
                for side in [256_u32, 512, 1024, 2048] {
                    all.push(record(
                        (class, [pcf, moments, other]),
                        (method, kind, bits, pixel, filter, widths),
                        width,
                        side,
                    ));
                }
            }
        }
    }
    // One that is exact, and one that failed.
    if let Some(exact) = all.iter_mut().find(|r| r.class == "one layer" && r.method == "VSM" && r.side == Some(2048)) {
        exact.errors.insert(
            "rays".into(),
            Errors { regions: BTreeMap::from([("all".into(), Metrics::default())]), ..Errors::default() },
        );
    }
    if let Some(failed) = all.iter_mut().find(|r| r.class == "contact" && r.method == "SAT" && r.side == Some(2048)) {
        failed.failure = Some("the device ran out of memory".into());
        failed.passes.clear();
        failed.wall.clear();
        failed.errors.clear();
    }
    all
}

fn record(
    (class, errors): (&str, [f64; 3]),
    (method, kind, bits, pixel, filter, widths): Method,
    width: u32,
    side: u32,
) -> Record {
    let seed = side / 256 + width + bits;
    let texels = f64::from(side * side) / 1e6;
    let taps = if method == "PCF" { f64::from(width * width) } else { 1.0 };
    let light = 0.3 + 0.4 * texels * f64::from(bits) / 32.0;
    let passes = [
        (Role::Light, "key: depth", light),
        (Role::Filter, "key: blur x", filter * texels),
        (Role::Main, "main", 0.6 + pixel * taps),
    ];
    let base = match kind {
        "variance_shadow" | "summed_area_shadow" | "summed_area_soft_shadow" => errors[1],
        "exponential_shadow" | "exponential_variance_shadow" | "moment_shadow" => errors[2],
        "hard_shadow" => errors[0] + 0.05,
        "pcss_shadow" => errors[0] * 0.4,
        _ => errors[0] + 0.004 * (f64::from(width) - 5.0).abs(),
    };
    let rms = base + 6.0 / f64::from(side) * if kind == "hard_shadow" { 4.0 } else { 1.0 } + f64::from(bits) * 1e-6;
    let metrics = |rms: f64| Metrics {
        pixels: 57_600,
        rms,
        bias: rms * 0.3,
        most: (rms * 9.0).min(1.0),
        percentile_99: (rms * 4.0).min(1.0),
        over_step: (rms * 3.0).min(1.0),
        over_twentieth: (rms * 1.2).min(1.0),
        false_lit: (rms * 0.9).min(1.0),
        false_dark: (rms * 0.3).min(1.0),
    };
    let parts = [("all", 1.0), ("penumbra", 2.5), ("umbra", 1.4), ("lit", 0.2), ("silhouette", 3.0)];
    let mut settings = BTreeMap::from([("size".to_owned(), side.to_string())]);
    let mut varied = vec!["size".to_owned()];
    if widths.len() > 1 {
        settings.insert("width".into(), width.to_string());
        varied.push("width".into());
    }
    Record {
        version: VERSION,
        study: "Shadows by class of scene".into(),
        cell: format!("{class}/{method}/{side}/{width}"),
        case: class.into(),
        class: class.into(),
        scene: format!("graphs/scenes/{}.ron", class.replace(' ', "_")),
        light: "key".into(),
        method: method.into(),
        shadow: kind.into(),
        settings,
        varied,
        frame: (320, 180),
        side: Some(side),
        bits: Some(bits),
        format: Some(if bits == 32 { "depth32float" } else { "rg32float" }.into()),
        triangles: 1204,
        passes: passes
            .into_iter()
            .filter(|p| p.2 > 0.0)
            .map(|(role, name, x)| Series { name: name.into(), role, milliseconds: rounds(x, seed) })
            .collect(),
        wall: rounds(light + filter * texels + pixel * taps + 2.0, seed + 1),
        plain: rounds(1.9 + 0.4 * texels, seed + 2),
        errors: BTreeMap::from([(
            "rays".to_owned(),
            Errors {
                size: (320, 180),
                note: "256 rays a pixel".into(),
                regions: parts.map(|(name, share)| (name.to_owned(), metrics((rms * share).min(1.0)))).into(),
            },
        )]),
        pictures: Some(format!("pictures/{}", method.replace([' ', ','], "_").to_lowercase())),
        truth_pictures: Some("pictures/truth".into()),
        machine: Machine {
            adapter: ADAPTER.into(),
            driver: "Mesa 0.0".into(),
            backend: "vulkan".into(),
            software: true,
        },
        versions: BTreeMap::from([("shadetree".to_owned(), "0.1.0".to_owned())]),
        messages: if bits == 128 {
            vec!["maps have 16 bits: the adapter filters no others".into()]
        } else {
            Vec::new()
        },
        ..Record::default()
    }
}

/// Claims and a table that go with the records.
pub const STUDY: &str = r#"Study(
    version: 1,
    title: "Shadows by class of scene",
    note: "Made up, to see the chart of it.",
    published: [
        (title: "T", source: "nobody, nowhere", device: "nothing", unit: "fps", plain: "Shadow Map", vary: "size", class: "contact",
         columns: ["256", "512"], rows: {"Shadow Map": [340, 334], "VSM": [265, 255], "PCSS": [30, 20]}),
    ],
    claims: [
        (id: "C1", law: true, text: "The main pass takes as long whatever the size of the map", kind: "constant", time: "main",
         over: "size", within: 0.05, methods: ["Shadow Map", "PCF"]),
        (id: "C2", law: true, text: "The blur takes as long whatever the size of the map", kind: "constant", time: "filter",
         over: "size", within: 0.05, methods: ["VSM"]),
        (id: "C3", text: "ESM is cheaper than MSM", kind: "ordered", time: "total", over: "size", methods: ["ESM", "MSM4"]),
        (id: "C4", text: "Nothing is known of LVSM", kind: "grows", time: "total", over: "size", methods: ["LVSM"]),
    ],
)
"#;

/// Lines of a results file.
pub fn lines(records: &[Record]) -> String {
    records.iter().map(|r| serde_json::to_string(r).expect("JSON") + "\n").collect()
}

/// Writes a folder of results, with pictures.
pub fn write(folder: &Path) {
    std::fs::create_dir_all(folder.join("pictures")).expect("a folder");
    std::fs::write(folder.join("results.jsonl"), lines(&records())).expect("written");
    std::fs::write(folder.join("study.ron"), STUDY).expect("written");
    let picture = |name: &str, of: &dyn Fn(u32, u32) -> [u8; 3]| {
        let pixels = image::RgbImage::from_fn(320, 180, |x, y| image::Rgb(of(x, y)));
        pixels.save(folder.join("pictures").join(name)).expect("a picture");
    };
    let disc = |x: u32, y: u32, soft: f64| {
        let d = (f64::from(x) - 160.0).hypot(f64::from(y) - 90.0) - 50.0;
        (d / soft + 0.5).clamp(0.0, 1.0)
    };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 255")]
    let byte = |v: f64| (v * 255.0) as u8;
    picture("truth.rays.png", &|x, y| [byte(disc(x, y, 20.0)); 3]);
    for (i, (method, ..)) in METHODS.iter().enumerate() {
        let name = method.replace([' ', ','], "_").to_lowercase();
        let soft = 2.0 + 3.0 * i as f64;
        picture(&format!("{name}.visibility.png"), &|x, y| [byte(disc(x, y, soft)); 3]);
        picture(&format!("{name}.error.png"), &|x, y| {
            let d = (disc(x, y, soft) - disc(x, y, 20.0)) * 4.0;
            let rest = byte(1.0 - d.abs().min(1.0));
            if d > 0.0 { [255, rest, rest] } else { [rest, rest, 255] }
        });
    }
}
