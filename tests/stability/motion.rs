//! Shadows of what stands still, seen by a camera that moves.

use glam::{DMat4, DVec3};
use shadetree::render::Gpu;

use super::table::{Bound, Table};
use crate::stage::{Item, Stage, View, gpu, light, visibility};

/// Pixels on a side.
const SIDE: u32 = 96;
/// Metres across a pixel: half a texel of the map or less, and exact in binary.
const PIXEL: f64 = 1.0 / 64.0;

/// The ground from above, and over the camera plates that shadow it, off the middle by whole pixels, and turned by right
/// angles.
fn stage(moved: (i32, i32), turns: u32, height: f64) -> Stage {
    let above = height + 0.1;
    let at = |x: f64, z: f64| {
        // Against the light's direction.
        DMat4::from_translation(DVec3::new(x + above / 2.0, above, z - above / 4.0)) * DMat4::from_rotation_y(0.3)
    };
    let items = vec![
        Item::plane([16.0, 16.0], DMat4::IDENTITY),
        Item::plane([0.31, 1.3], at(-0.3, 0.1)),
        Item::plane([0.2, 0.2], at(0.3, -0.35)),
        Item::plane([0.07, 1.5], at(0.55, 0.0)),
    ];
    let (x, z) = (f64::from(moved.0) * PIXEL, f64::from(moved.1) * PIXEL);
    let mut view = View::down((x, z), height, f64::from(SIDE) * PIXEL, (SIDE, SIDE));
    view.up = [DVec3::NEG_Z, DVec3::X, DVec3::Z, DVec3::NEG_X][turns as usize % 4];
    Stage::new(items, view)
}

/// The largest change of a pixel that sees the same point of the ground, and the share of pixels that change, as the
/// camera moves by pixels, each less than a texel, and turns.
pub(super) fn change(gpu: &mut Gpu, fit: &str, shadow: &str) -> (f64, f64) {
    let splits =
        if fit == "none" { String::new() } else { format!("options: {{\"splits\": \"3\", \"fit\": \"{fit}\"}}, ") };
    // Along the longest footprint, devices may take one sample more or less by a rounding of the gradients.
    let single = if shadow == "variance_shadow" { ", \"anisotropy\": \"1\"" } else { "" };
    let options = format!("\"size\": \"256\"{single}");
    let graph = light("directional_light", "\"direction\": (-1, -2, 0.5)", shadow, "", &options);
    let graph = graph.replacen("params:", &format!("{splits}params:"), 1);
    let shader = visibility(&graph);
    let (mut most, mut changed, mut compared) = (0.0_f64, 0, 0);
    // In the first, second and third part of the view.
    for height in [0.35, 6.0, 12.0] {
        let mut look = |moved, turns| stage(moved, turns, height).look(gpu, &shader);
        let before = look((0, 0), 0);
        let mut compare = |after: Vec<f64>, source: &dyn Fn(i32, i32) -> (i32, i32)| {
            let side = SIDE as i32;
            for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
                let (from_x, from_y) = source(x, y);
                if (0..side).contains(&from_x) && (0..side).contains(&from_y) {
                    let off = (after[(y * side + x) as usize] - before[(from_y * side + from_x) as usize]).abs();
                    most = most.max(off);
                    changed += usize::from(off > 1.0 / 255.0);
                    compared += 1;
                }
            }
        };
        for moved in [(1, 0), (0, 1), (3, 2), (-5, 7), (11, -4)] {
            compare(look(moved, 0), &|x, y| (x + moved.0, y + moved.1));
        }
        // With +x up, the picture's right is +z.
        compare(look((0, 0), 1), &|x, y| (SIDE as i32 - 1 - y, x));
        compare(look((0, 0), 2), &|x, y| (SIDE as i32 - 1 - x, SIDE as i32 - 1 - y));
    }
    (most, f64::from(u32::try_from(changed).unwrap_or(u32::MAX)) / compared as f64)
}

#[test]
fn stable_splits_do_not_shimmer() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "shimmer",
        "Plates that stand still over the ground, seen from above by a camera that moves by whole pixels and turns by right\nangles, so that pixels see the same points again: their largest change, and the share that changes by 1/255 or more.\nParallel light with three splits, that fit tightly or stably, or without splits.",
        (1e-3, "points are known to some 1e-7 m, which decides comparisons at the border of two texels"),
        (2e-3, 0.0),
    );
    for shadow in ["hard_shadow", "pcf_shadow", "variance_shadow"] {
        for fit in ["none", "stable"] {
            let (most, share) = change(&mut gpu, fit, shadow);
            // Filters weigh by the place within a texel, which is known to 1e-4 of a texel.
            let bound = if shadow == "hard_shadow" { 0.0 } else { 1e-3 };
            table.wide(format!("{shadow}, {fit}: most"), "T17: none", most, Bound::Most(bound));
            table.wide(format!("{shadow}, {fit}: share"), "T17: none", share, Bound::Most(0.0));
        }
        let (most, share) = change(&mut gpu, "tight", shadow);
        table.row(format!("{shadow}, tight: most"), "edges crawl", most, Bound::Least(0.05));
        table.row(format!("{shadow}, tight: share"), "edges crawl", share, Bound::Least(0.002));
    }
    table.check(&gpu);
}
