//! Ranges of light from short to very long, and maps from small to large.

use glam::{DMat4, DVec3};
use shadetree::reference::{Weights, edge_visibility, kernel};
use shadetree::render::Gpu;

use super::bench::most;
use super::bleeding::WEIGHTS;
use super::exponentials::able;
use super::table::{Bound, Table};
use crate::laws::lamp::{CLOSED_FORM, PLAIN};
use crate::stage::{Item, Stage, View, gpu, light, visibility};

/// A plate 1 m above the ground, with its right edge `edge` metres from the middle, and a strip of the ground under it
/// around that edge.
fn strip(edge: f64, shown: f64, scale: f64, size: (u32, u32)) -> Stage {
    let plate = DMat4::from_translation(DVec3::new(edge - 4.0, 1.0, 0.0));
    let items = vec![Item::plane([16.0, 16.0], DMat4::IDENTITY), Item::plane([8.0, 16.0], plate)];
    Stage::new(items, View::down((edge * scale, 0.0), 0.75, shown, size))
}

/// Of a spotlight 4 m above the ground: the largest error of filtered comparison at the edge of a plate, and the most
/// that leaks under the plate by the variance bound.
pub(super) fn ranges(gpu: &mut Gpu, near: f64, far: f64, metric: &str) -> (f64, f64) {
    let lamp = format!(
        "\"position\": (0, 4, 0), \"direction\": (0, -1, 0), \"outer_angle\": 45, \"inner_angle\": 44, \"near\": {near}, \"range\": {far}"
    );
    // Texels: 6 m / 256 at the plate, 8 m / 256 on the ground.
    let (at_plate, on_ground) = (6.0 / 256.0, 8.0 / 256.0);
    let stage = strip(4.0 * at_plate, 16.0 * on_ground, on_ground / at_plate, (160, 2));
    let options = |rest: &str| format!("\"size\": \"256\", \"width\": \"5\", \"metric\": \"{metric}\", {rest}");
    let compared = visibility(&light("spot_light", &lamp, "pcf_shadow", "", &options("\"taps\": \"bilinear\"")));
    let kernel = kernel(Weights::Gaussian, 5);
    let values = stage.look(gpu, &compared);
    let error = |(p, v): (DVec3, f64)| (v - edge_visibility(&kernel, p.x / on_ground - 4.0)).abs();
    let error = most(&stage.on_ground(&values).map(error).collect::<Vec<_>>());
    let rest = "\"slope_variance\": \"off\", \"mips\": \"off\", \"filter\": \"linear\", \"anisotropy\": \"1\"";
    let variance =
        visibility(&light("spot_light", &lamp, "variance_shadow", "\"bleeding_reduction\": 0", &options(rest)));
    let values = stage.look(gpu, &variance);
    let dark = stage.on_ground(&values).filter(|(p, _)| p.x / on_ground - 4.0 < -3.5).map(|(_, v)| v);
    (error, dark.fold(0.0, f64::max))
}

#[test]
fn ratios_of_far_to_near_cost_what_the_range_costs() {
    let Some(mut gpu) = gpu() else { return };
    if !able(&gpu) {
        return;
    }
    let mut table = Table::new(
        "near_far",
        "A plate 1 m over the ground, 4 m below a spotlight: largest error of pcf_shadow at its edge, and what leaks under\nit through variance_shadow at its default minimum variance of 1e-6 ranges squared. Linear depth\nleaves the near plane without a cost; the far plane makes the gap smaller in ranges, and so does a near plane with z/w.",
        WEIGHTS,
        (1e-3, 0.0),
    );
    let ranges_of: [(f64, f64); 8] = [
        (1.0, 10.0),
        (0.1, 10.0),
        (0.01, 10.0),
        (0.001, 10.0),
        (0.001, 100.0),
        (0.1, 100.0),
        (0.001, 1000.0),
        (0.01, 10_000.0),
    ];
    for (near, far) in ranges_of {
        let (error, leak) = ranges(&mut gpu, near, far, "linear");
        let what = format!("near {near}, far {far} (1 : {:.0e})", far / near);
        table.row(format!("{what}: pcf_shadow"), "T4, whatever the range", error, Bound::Most(CLOSED_FORM));
        let gap = 1.0 / (far - near);
        // The variance of equal depths in single precision, after two blurs, is below 1e-7.
        let law = 1e-6 / (1e-6 + gap * gap);
        let noise = 1.1e-6 / (1.1e-6 + gap * gap) - law + 1e-5;
        table.wide(format!("{what}: variance_shadow"), "T10: e / (e + gap^2)", leak, Bound::Near(law, noise));
    }
    for near in [1.0, 0.1, 0.01, 0.001] {
        let (error, leak) = ranges(&mut gpu, near, 10.0, "zw");
        let what = format!("near {near}, far 10, z/w");
        table.row(format!("{what}: pcf_shadow"), "T4, whatever the range", error, Bound::Most(CLOSED_FORM));
        // At 3 m and 4 m from the light.
        let gap = 10.0 / (10.0 - near) * near * (1.0 / 3.0 - 1.0 / 4.0);
        let law = |gap: f64| 1e-6 / (1e-6 + gap * gap);
        // Depths near 1 are stored to 6e-8.
        let within = law(gap - 1.2e-7) - law(gap) + 1e-5;
        table.wide(format!("{what}: variance_shadow"), "T10 at the gap in z/w", leak, Bound::Near(law(gap), within));
    }
    table.check(&gpu);
}

/// Largest errors at the edge of a plate, in parallel light on a map of 2 m: of one comparison (texels from the edge at
/// which it still goes wrong), of filtered comparison, and of the variance bound.
pub(super) fn sizes(gpu: &mut Gpu, size: u32) -> [f64; 3] {
    let texel = 2.0 / f64::from(size);
    let stage = strip(4.3 * texel, 16.0 * texel, 1.0, (320, 2));
    let mut errors = |shadow: &str, params: &str, options: &str| {
        let lamp = "\"direction\": (0, -1, 0), \"radius\": 1";
        let options = format!("\"size\": \"{size}\"{options}");
        let values = stage.look(gpu, &visibility(&light("directional_light", lamp, shadow, params, &options)));
        stage.on_ground(&values).map(|(p, v)| (p.x / texel, v)).collect::<Vec<_>>()
    };
    let hard = errors("hard_shadow", "", "");
    let wrong = |(x, v): &(f64, f64)| if (*v > 0.5) == (*x > 4.3) { 0.0 } else { (x - 4.3).abs() };
    let kernel = kernel(Weights::Gaussian, 5);
    // The edge at 4.3 covers the texels up to 4.
    let off = |all: Vec<(f64, f64)>| {
        most(&all.iter().map(|(x, v)| (v - edge_visibility(&kernel, x - 4.0)).abs()).collect::<Vec<_>>())
    };
    let compared = off(errors("pcf_shadow", "", ", \"width\": \"5\", \"taps\": \"bilinear\""));
    let variance = off(errors(
        "variance_shadow",
        "\"bleeding_reduction\": 0",
        &format!(", \"width\": \"5\", \"slope_variance\": \"off\", {PLAIN}"),
    ));
    [most(&hard.iter().map(wrong).collect::<Vec<_>>()), compared, variance]
}

#[test]
fn maps_of_all_sizes_err_by_half_a_texel() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "map_sizes",
        "The edge of a plate 1 m over the ground on maps of 2 m: how far from the edge one comparison goes wrong, in texels,\nand the largest errors of filters of 5 texels against their ramp.",
        WEIGHTS,
        (1e-3, 0.0),
    );
    for size in [64, 128, 256, 512, 1024, 2048, 4096] {
        let [hard, compared, variance] = sizes(&mut gpu, size);
        // Positions are known to 1e-7 m or so, of which a texel has fewer and fewer.
        let rounding = CLOSED_FORM * f64::from(size).max(256.0) / 256.0;
        let pixel = 16.0 / 320.0;
        table.row(format!("{size}: hard_shadow"), "half a texel", hard, Bound::Most(0.5 + pixel));
        table.row(format!("{size}: pcf_shadow"), "T4", compared, Bound::Most(rounding));
        table.wide(format!("{size}: variance_shadow"), "T4, exact for one plane", variance, Bound::Most(rounding));
    }
    table.check(&gpu);
}
