//! Every example scene, rendered by the program itself: first numbers that hold on any adapter, then the picture.
//!
//! A scene becomes a test by lying in `graphs/scenes`. `BLESS=1` writes `tests/golden/images`; look at the pictures then.

use std::path::{Path, PathBuf};
use std::process::Command;

use exr::prelude::read_first_rgba_layer_from_file;
use serde_json::{Map, Value, json};
use shadetree::render::image_file::{Display, ToneCurve, encode_png};

use crate::stage::gpu;
use crate::support::{expect_file, files, no_strays, root, text};

const SIZE: (u32, u32) = (128, 72);
/// What a number may be off by, as a part of its size plus a tenth. Covers 16-bit maps, other sampling of edges, and other
/// anisotropic kernels; a small shadow that vanishes is more.
const TOLERANCE: f64 = 0.02;
/// What a channel of 8 bits may be off by, and how many pixels may be off by more: edges that fall to the other side.
const CHANNEL: u8 = 3;
const MISSES: usize = 24;

struct Picture {
    /// As written, to be compared with another run.
    bytes: Vec<u8>,
    pixels: Vec<[f32; 4]>,
}

/// Renders with the program.
fn render(scene: &Path, aov: &str, folder: &Path) -> Picture {
    let file = folder.join("picture.exr");
    let output = Command::new(env!("CARGO_BIN_EXE_shadetree"))
        .current_dir(root())
        .args(["--quiet", "render", "--size", &format!("{}x{}", SIZE.0, SIZE.1), "--aov", aov, "-o"])
        .args([&file, scene])
        .output()
        .expect("the program runs");
    assert!(output.status.success(), "{} {aov}: {}", scene.display(), String::from_utf8_lossy(&output.stderr));
    let bytes = std::fs::read(&file).expect("a picture");
    let image = read_first_rgba_layer_from_file(
        &file,
        |size, _| (size.width(), vec![[0.0_f32; 4]; size.area()]),
        |(width, pixels), at, (r, g, b, a): (f32, f32, f32, f32)| pixels[at.y() * *width + at.x()] = [r, g, b, a],
    );
    let (width, pixels) = image.expect("an OpenEXR picture").layer_data.channel_data.pixels;
    assert_eq!((width, pixels.len()), (SIZE.0 as usize, (SIZE.0 * SIZE.1) as usize));
    assert!(pixels.iter().flatten().all(|x| x.is_finite()), "{} {aov}: not all is finite", scene.display());
    Picture { bytes, pixels }
}

/// Four digits: what is left of them is noise.
fn rounded(x: f64) -> Value {
    json!((x * 1e4).round() / 1e4)
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count.max(1.0)
}

/// Mean and spread of luminance, the mean of each channel, and per light how much of what is seen it does not reach.
fn numbers(radiance: &Picture, lights: &[(String, Picture)]) -> Value {
    let luminance = |p: &[f32; 4]| 0.2126 * f64::from(p[0]) + 0.7152 * f64::from(p[1]) + 0.0722 * f64::from(p[2]);
    let average = mean(radiance.pixels.iter().map(luminance));
    let spread = mean(radiance.pixels.iter().map(|p| (luminance(p) - average).abs()));
    let channel = |i: usize| rounded(mean(radiance.pixels.iter().map(|p| f64::from(p[i]))));
    let mut per_light = Map::new();
    for (name, picture) in lights {
        let seen: Vec<f64> = picture.pixels.iter().filter(|p| p[3] > 0.5).map(|p| f64::from(p[0] / p[3])).collect();
        per_light.insert(
            name.clone(),
            json!({
                "covered": rounded(seen.len() as f64 / picture.pixels.len() as f64),
                "visibility": rounded(mean(seen.iter().copied())),
                "shadowed": rounded(mean(seen.iter().map(|v| if *v < 0.5 { 1.0 } else { 0.0 }))),
            }),
        );
    }
    json!({
        "luminance": rounded(average),
        "luminance_spread": rounded(spread),
        "mean": [channel(0), channel(1), channel(2)],
        "lights": per_light,
    })
}

/// Every number of `actual` near that of `expected`, with the same names.
fn compare(what: &str, expected: &Value, actual: &Value, wrong: &mut Vec<String>) {
    match (expected, actual) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap_or(f64::NAN), b.as_f64().unwrap_or(f64::NAN));
            if (a - b).abs().is_nan() || (a - b).abs() > TOLERANCE * (a.abs() + 0.1) {
                wrong.push(format!("{what}: expected {a}, actual {b}"));
            }
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            a.iter().zip(b).enumerate().for_each(|(i, (a, b))| compare(&format!("{what}[{i}]"), a, b, wrong));
        }
        (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => {
            a.iter().for_each(|(key, a)| compare(&format!("{what}.{key}"), a, &b[key], wrong));
        }
        _ => wrong.push(format!("{what}: expected {expected}, actual {actual}")),
    }
}

/// Pixels of two PNGs that differ by more than a channel may.
fn misses(expected: &[u8], actual: &[u8]) -> usize {
    let decode = |bytes: &[u8]| image::load_from_memory(bytes).expect("a PNG").into_rgba8();
    let (expected, actual) = (decode(expected), decode(actual));
    assert_eq!(expected.dimensions(), actual.dimensions());
    let far = |(a, b): &(&image::Rgba<u8>, &image::Rgba<u8>)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > CHANNEL);
    expected.pixels().zip(actual.pixels()).filter(far).count()
}

#[test]
fn scenes_look_as_expected() {
    // The lock is given back at once: the program opens its own device.
    let Some(adapter) = gpu().map(|gpu| gpu.adapter().clone()) else { return };
    let lavapipe = adapter.backend == "vulkan" && adapter.name.contains("llvmpipe");
    let bless = std::env::var_os("BLESS").is_some();
    assert!(lavapipe || !bless, "expected pictures are made with lavapipe, not {adapter}");
    let folder = tempfile::tempdir().expect("a folder");
    let mut known = Vec::new();
    let mut wrong = Vec::new();
    for scene in files("graphs/scenes", "ron") {
        let (read, _) = shadetree::scene::read(&text(&scene));
        let read = read.unwrap_or_else(|| panic!("{} is a scene", scene.display()));
        let radiance = render(&scene, "radiance", folder.path());
        let again = render(&scene, "radiance", folder.path());
        if radiance.bytes != again.bytes {
            wrong.push(format!("{}: two runs differ", scene.display()));
        }
        let visibility = |name: &str| render(&scene, &format!("visibility:{name}"), folder.path());
        let lights: Vec<_> = read.lights.iter().map(|l| (l.name.clone(), visibility(&l.name))).collect();
        let numbers = numbers(&radiance, &lights);
        let table = format!("{}\n", serde_json::to_string_pretty(&numbers).expect("JSON"));
        let tone = Display { tone: ToneCurve::Filmic, ..Display::default() };
        let png = encode_png(SIZE, &radiance.pixels, &tone, &[]).expect("a PNG");
        let golden = Path::new("tests/golden/images").join(scene.file_stem().expect("a stem"));
        let name = |extension: &str| golden.with_extension(extension).display().to_string();
        known.extend([name("json"), name("png")]);
        if bless {
            expect_file(&name("json"), table.as_bytes());
            expect_file(&name("png"), &png);
            continue;
        }
        let expected = |extension: &str| {
            let path: PathBuf = root().join(name(extension));
            std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}: make it with BLESS=1", path.display()))
        };
        let before = wrong.len();
        let stated: Value = serde_json::from_slice(&expected("json")).expect("JSON");
        compare(&scene.display().to_string(), &stated, &numbers, &mut wrong);
        // Where the numbers are wrong, the picture says nothing new.
        if wrong.len() == before && lavapipe {
            let misses = misses(&expected("png"), &png);
            if misses > MISSES {
                let seen = root().join("target").join(golden.with_extension("png").file_name().expect("a name"));
                std::fs::write(&seen, &png).expect("leave the picture");
                wrong.push(format!("{}: {misses} pixels differ, see {}", scene.display(), seen.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}\n(BLESS=1 accepts them)", wrong.join("\n"));
    no_strays("tests/golden/images", "png", &known);
    no_strays("tests/golden/images", "json", &known);
}

#[test]
fn comparisons_find_what_is_wrong() {
    let mut wrong = Vec::new();
    let expected = json!({"a": 1.0, "lights": {"sun": {"shadowed": 0.3}}, "mean": [1.0, 200.0]});
    compare(
        "x",
        &expected,
        &json!({"a": 1.015, "lights": {"sun": {"shadowed": 0.307}}, "mean": [1.0, 203.0]}),
        &mut wrong,
    );
    assert!(wrong.is_empty(), "{wrong:?}");
    compare(
        "x",
        &expected,
        &json!({"a": 1.03, "lights": {"sun": {"shadowed": 0.31}}, "mean": [1.0, 205.0]}),
        &mut wrong,
    );
    assert_eq!(wrong.len(), 3, "{wrong:?}");
    compare("x", &expected, &json!({"a": 1.0, "lights": {}, "mean": [1.0]}), &mut wrong);
    assert_eq!(wrong.len(), 5, "{wrong:?}");
    let png =
        |value: f32| encode_png((2, 1), &[[0.5, 0.5, value, 1.0], [0.5; 4]], &Display::default(), &[]).expect("a PNG");
    assert_eq!((misses(&png(0.5), &png(0.502)), misses(&png(0.5), &png(0.7))), (0, 1));
}
