//! What the storage of moments loses, and how close an occluder may come.

use glam::DMat4;
use shadetree::compile::Compiled;
use shadetree::render::Gpu;

use super::bench::{least, look_with, most, share};
use super::table::{Bound, Table};
use crate::laws::lamp::{Lamp, PLAIN, Plate, under};
use crate::stage::{Item, Stage, View, gpu, light, skipped, visibility};

/// A format; how far its rounding moves mean square - mean^2 of a flat depth z at most; and by how much the mean itself.
/// Stores of half floats may truncate, which doubles their unit; near 0 they have a fixed step.
struct Format {
    name: &'static str,
    variance: fn(f64) -> f64,
    mean: f64,
}

const FORMATS: [Format; 3] = [
    Format { name: "rg32float", variance: |z| 3.0 * z * z / 16_777_216.0, mean: 6e-8 },
    Format { name: "rg16unorm", variance: |z| (1.0 + 2.0 * z) / 131_072.0, mean: 7.7e-6 },
    Format { name: "rg16float", variance: |z| 2.0 * 3.0 * z * z / 2048.0 + 1.0 / 16_777_216.0, mean: 4.9e-4 },
];

/// Whether the adapter makes maps in a format; says so if not.
fn able(gpu: &Gpu, format: &str) -> bool {
    let known = gpu.adapter().formats.iter().find(|(name, _)| name == format);
    let able = known.is_some_and(|(_, able)| able.renderable && able.filterable);
    if !able {
        skipped(&format!("{} cannot render and filter {format}", gpu.adapter()));
    }
    able
}

fn shader(lamp: Lamp, format: &str) -> Compiled {
    let (kind, at) = lamp.kind();
    let options =
        format!("\"size\": \"256\", \"width\": \"1\", \"slope_variance\": \"off\", \"format\": \"{format}\", {PLAIN}");
    visibility(&light(kind, at, "variance_shadow", "\"bleeding_reduction\": 0", &options))
}

/// A plane through the whole range: the largest |M2 - M1^2|, its largest ratio to the bound, and the share below zero.
fn rounding(gpu: &mut Gpu, format: &Format) -> (f64, f64, f64) {
    let ramp = Item::plane([4.0, 4.0], DMat4::from_rotation_z(0.5));
    let stage = Stage::new(vec![ramp], View::down((0.0, 0.0), 2.0, 1.0, (4, 4)));
    let map = gpu.map(&stage.job(&shader(Lamp::Sun, format.name)), "light/lamp", 0).expect("renders");
    assert_eq!(map.format, format.name);
    let off: Vec<(f64, f64)> = map
        .pixels
        .iter()
        .map(|[mean, square, ..]| (f64::from(*mean), f64::from(*square)))
        .map(|(mean, square)| (mean, square - mean * mean))
        .collect();
    let all: Vec<f64> = off.iter().map(|(_, v)| v.abs()).collect();
    let ratios: Vec<f64> = off.iter().map(|(z, v)| v.abs() / (format.variance)(*z)).collect();
    (most(&all), most(&ratios), share(&off.iter().map(|o| o.1).collect::<Vec<_>>(), |v| v < 0.0))
}

/// The darkest of lit planes at sixteen distances from a spotlight, with a minimum variance.
pub(super) fn darkest_lit(gpu: &mut Gpu, format: &str, minimum: f64) -> f64 {
    let shader = shader(Lamp::Spot, format);
    let dark = |i: u32| {
        let ground = Item::plane([16.0, 16.0], DMat4::from_translation(glam::DVec3::Y * (f64::from(i) * 0.1731 - 0.9)));
        let mut stage = Stage::new(vec![ground], View::down((0.0, 0.0), 3.0, 1.0, (16, 2)));
        least(&look_with(&mut stage, gpu, &shader, "minimum_variance", minimum))
    };
    (0..16).map(dark).fold(1.0, f64::min)
}

/// The most light under a plate with a gap of `gap` ranges, with the least minimum variance.
fn leak(gpu: &mut Gpu, format: &str, gap: f64) -> f64 {
    let plates = [Plate { height: gap * 4.0, edge: 60.0, angle: 0.0 }];
    let mut stage = under(Lamp::Spot, &plates, 4.0, (16, 2));
    stage.view.position.x = 0.0;
    stage.view.target.x = 0.0;
    most(&look_with(&mut stage, gpu, &shader(Lamp::Spot, format), "minimum_variance", 0.0))
}

#[test]
fn formats_cancel_by_their_law() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "cancellation",
        "Moments of planes in three formats, unblurred: a plane through the whole range, lit planes at sixteen\ndistances, and full shadow under a plate a tenth of the range away. u: unit of rounding; n: the rounding of M2 - M1^2;\nd: that of M1; e: minimum variance.",
        (4e-4, "formats round as the device likes; lavapipe truncates half floats"),
        // Rounding is another at every texel: only its size stays.
        (0.0, 0.5),
    );
    for format in FORMATS {
        if !able(&gpu, format.name) {
            return;
        }
        let name = format.name;
        let (worst, ratio, negative) = rounding(&mut gpu, &format);
        table.row(format!("{name}: largest |M2 - M1^2|"), "T7 at z = 1", worst, Bound::Most((format.variance)(1.0)));
        table.row(
            format!("{name}: largest ratio to the bound"),
            "T7: 3 u z^2, or (1 + 2 z) / 2^17",
            ratio,
            Bound::Most(1.0),
        );
        table.row(format!("{name}: share with M2 < M1^2"), "T7: about half", negative, Bound::Near(0.5, 0.35));
        let noise = (format.variance)(Lamp::Spot.depth(0.4));
        let law = noise / (noise + 0.01);
        table.row(
            format!("{name}: umbra, gap 0.1"),
            "T7: n / (n + 0.01)",
            leak(&mut gpu, name, 0.1),
            Bound::Most(law + 1e-6),
        );
        let minimum = 254.0 * format.mean * format.mean;
        // The node keeps 1e-12 against 0 / 0, which is all that single precision needs.
        let (law, bound) = if minimum > 1e-12 {
            ("T10: e < 254 d^2 darkens", Bound::Most(0.9))
        } else {
            ("T10: 254 d^2 < 1e-12", Bound::Least(254.0 / 255.0 - 1e-4))
        };
        table.row(format!("{name}: darkest lit, e = 0"), law, darkest_lit(&mut gpu, name, 0.0), bound);
        let cured = darkest_lit(&mut gpu, name, minimum);
        table.row(
            format!("{name}: darkest lit, e = 254 d^2"),
            "T10: 254 / 255",
            cured,
            Bound::Least(254.0 / 255.0 - 1e-4),
        );
    }
    table.check(&gpu);
}

/// What leaks at a gap under a plate, with a minimum variance.
pub(super) fn contact(gpu: &mut Gpu, minimum: f64, gap: f64) -> f64 {
    let plates = [Plate { height: gap * 4.0, edge: 60.0, angle: 0.0 }];
    let mut stage = under(Lamp::Spot, &plates, 4.0, (16, 2));
    stage.view.position.x = 0.0;
    stage.view.target.x = 0.0;
    most(&look_with(&mut stage, gpu, &shader(Lamp::Spot, "rg32float"), "minimum_variance", minimum))
}

#[test]
fn minimum_variance_bounds_how_near_an_occluder_may_come() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu, "rg32float") {
        return;
    }
    let mut table = Table::new(
        "contact",
        "A plate over the ground at the gap where the minimum variance e lets 1/255 through, and at half of it. Gaps are\nin ranges of the light: with half the range, the same gap in metres allows four times the minimum variance.",
        (0.0, ""),
        (2e-4, 0.0),
    );
    for minimum in [1e-7_f64, 1e-6, 2e-5, 1e-4] {
        for part in [1.0, 0.5] {
            let gap = (254.0 * minimum).sqrt() * part;
            // Rounding of M2 may exceed e; the plate itself lies up to 1e-6 of the scene off.
            let noise = 3.0 / 16_777_216.0;
            let law = |e: f64, gap: f64| e / (e + gap * gap);
            let within = law(minimum.max(noise), gap - 2e-6) - law(minimum, gap) + 1e-6;
            let setting = format!("e {minimum:.0e}, gap {}", super::table::figure(gap));
            let bound = Bound::Near(law(minimum, gap), within);
            table.row(setting, "T10: e / (e + gap^2)", contact(&mut gpu, minimum, gap), bound);
        }
    }
    table.check(&gpu);
}
