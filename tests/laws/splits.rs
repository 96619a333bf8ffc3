//! Splitting a wide view: as many texels, less error; and no seams between the parts.

use glam::{DMat4, DVec3};
use shadetree::compile::Compiled;
use shadetree::render::Gpu;
use shadetree::scene::Shape;

use crate::stage::{Item, Stage, View, gpu, visibility};

/// The way the light travels.
const SUN: DVec3 = DVec3::new(1.0, -0.7, -0.15);
const POST: DVec3 = DVec3::new(0.3, 1.4, 0.3);

/// Feet of a row of posts that runs away from the eye.
fn feet() -> impl Iterator<Item = DVec3> {
    (0..16).map(|i| DVec3::new(-0.8, 0.0, -1.0 - 2.5 * f64::from(i)))
}

/// A ground of 80 m with the posts, seen along its surface.
fn long_ground(size: (u32, u32)) -> Stage {
    let mut items = vec![Item::plane([60.0, 80.0], DMat4::from_translation(DVec3::new(0.0, 0.0, -36.0)))];
    let bar = Shape::Box { size: POST.to_array(), bevel: 0.0 };
    items.extend(feet().map(|foot| Item::new(&bar, DMat4::from_translation(foot + DVec3::Y * POST.y / 2.0))));
    let view = View {
        position: DVec3::new(0.6, 1.1, 2.5),
        target: DVec3::new(0.15, 0.0, -7.0),
        up: DVec3::Y,
        half_height: 0.32,
        size,
    };
    Stage::new(items, view)
}

/// Whether a segment of the ray meets the box around a post.
fn meets(origin: DVec3, ray: DVec3, foot: DVec3) -> bool {
    let half = DVec3::new(POST.x / 2.0, POST.y / 2.0, POST.z / 2.0);
    let middle = foot + DVec3::Y * half.y;
    let (a, b) = ((middle - half - origin) / ray, (middle + half - origin) / ray);
    let (near, far) = (a.min(b).max_element(), a.max(b).min_element());
    far > near.max(0.0)
}

/// The share of a pixel's ground that the sun sees, in float64, and whether the pixel sees nothing but ground.
fn truth(stage: &Stage, pixel: (u32, u32), side: u32) -> Option<f64> {
    let fine = View { size: (stage.view.size.0 * side, stage.view.size.1 * side), ..stage.view };
    let mut lit = 0;
    for y in 0..side {
        for x in 0..side {
            let point = fine.point((pixel.0 * side + x, pixel.1 * side + y), DVec3::ZERO, DVec3::Y);
            let beyond = point.z < -50.0 || point.z > stage.view.position.z;
            if beyond || feet().any(|foot| meets(fine.position, point - fine.position, foot)) {
                return None;
            }
            lit += u32::from(!feet().any(|foot| meets(point, -SUN, foot)));
        }
    }
    Some(f64::from(lit) / f64::from(side * side))
}

fn sun(lamp_options: &str, kind: &str, params: &str, options: &str) -> Compiled {
    let [x, y, z] = SUN.to_array();
    visibility(&format!(
        "Graph(version: 1, nodes: {{\"lamp\": (kind: \"directional_light\", params: {{\"direction\": ({x}, {y}, {z})}}, \
         options: {{{lamp_options}}}), \"shadow\": (kind: \"{kind}\", params: {{{params}}}, options: {{{options}}})}}, \
         links: [\"lamp -> shadow\"])"
    ))
}

/// Root mean square error over the pixels that see only ground.
fn error(stage: &Stage, truth: &[Option<f64>], gpu: &mut Gpu, shader: &Compiled) -> f64 {
    let frame = stage.frame(gpu, shader);
    let pairs = truth.iter().zip(&frame.pixels).filter_map(|(t, p)| Some((t.as_ref()?, f64::from(p[0]))));
    let squares: Vec<f64> = pairs.map(|(t, v)| (t - v).powi(2)).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// Root mean square errors of shadows over the long ground: options of the light, kind and options of the shadow.
pub(crate) fn on_long_ground(gpu: &mut Gpu, shadows: &[(&str, &str, &str)]) -> Vec<f64> {
    let stage = long_ground((160, 90));
    let pixels = (0..90).flat_map(|y| (0..160).map(move |x| (x, y)));
    let truth: Vec<Option<f64>> = pixels.map(|p| truth(&stage, p, 8)).collect();
    assert!(truth.iter().flatten().filter(|v| **v < 1.0).count() > 200, "there are shadows");
    shadows.iter().map(|(lamp, kind, options)| error(&stage, &truth, gpu, &sun(lamp, kind, "", options))).collect()
}

/// The four pictures of the poster (Lauritzen 2007) with equal numbers of texels.
pub(crate) const POSTER: [(&str, &str, &str); 4] = [
    ("", "hard_shadow", "\"size\": \"1024\""),
    ("", "variance_shadow", "\"size\": \"1024\", \"width\": \"3\""),
    ("\"splits\": \"4\"", "hard_shadow", "\"size\": \"512\""),
    ("\"splits\": \"4\"", "variance_shadow", "\"size\": \"512\", \"width\": \"3\""),
];

/// Parts cure magnification, filtering cures aliasing, and only both together cure both (claim C15): the error is the least
/// of the four, though blurs are as wide in metres in every part, and the truth has no blur.
#[test]
fn split_and_filtered_beats_split_or_filtered_at_equal_texels() {
    let Some(mut gpu) = gpu() else { return };
    let [plain, variance, split, both] = on_long_ground(&mut gpu, &POSTER)[..] else { unreachable!() };
    println!("root mean square error: plain {plain:.4}, variance {variance:.4}, split {split:.4}, both {both:.4}");
    assert!(both < 0.95 * split.min(variance).min(plain), "{both} is not below {split}, {variance}, {plain}");
}

/// What a shadow looks like does not depend on how many parts there are, where the filter is not wider than a texel of
/// any: far from edges each part says the same.
#[test]
fn parts_agree_away_from_edges() {
    let Some(mut gpu) = gpu() else { return };
    let stage = long_ground((96, 54));
    let pixels = (0..54).flat_map(|y| (0..96).map(move |x| (x, y)));
    let truth: Vec<Option<f64>> = pixels.map(|p| truth(&stage, p, 3)).collect();
    for fit in ["tight", "stable"] {
        for choice in ["pixel", "quad"] {
            for splits in ["2", "3", "4"] {
                let blend = if splits == "3" { "on" } else { "off" };
                let lamp = format!(
                    "\"splits\": \"{splits}\", \"fit\": \"{fit}\", \"choice\": \"{choice}\", \"blend\": \"{blend}\""
                );
                let shader = sun(&lamp, "pcf_shadow", "", "\"size\": \"1024\", \"width\": \"3\"");
                let values = stage.frame(&mut gpu, &shader).pixels;
                let lit = |i: usize| truth.get(i).copied().flatten() == Some(1.0);
                for y in 3..51 {
                    for x in 3..93 {
                        let around = (y - 3..=y + 3).all(|v| (x - 3..=x + 3).all(|u| lit(v * 96 + u)));
                        let value = values[y * 96 + x][0];
                        assert!(!around || value > 0.999, "{fit} {choice} {splits}: {value} at {x}, {y}");
                    }
                }
            }
        }
    }
}

/// Light-space perspective (Wimmer, Scherzer and Purgathofer 2004) and variance shadow maps combine (claim M19): the
/// warped map is better than the flat one of the same size, and shadows nothing that is lit.
#[test]
fn a_warped_map_is_better_than_a_flat_one_where_the_view_is_long() {
    let Some(mut gpu) = gpu() else { return };
    let stage = long_ground((160, 90));
    let pixels = (0..90).flat_map(|y| (0..160).map(move |x| (x, y)));
    let truth: Vec<Option<f64>> = pixels.map(|p| truth(&stage, p, 8)).collect();
    let methods = [
        // Without filtering over the pixel, what is far away stays rough whatever the map.
        ("hard_shadow", "\"size\": \"1024\"", 0.9),
        ("pcf_shadow", "\"size\": \"1024\", \"width\": \"3\"", 0.9),
        ("variance_shadow", "\"size\": \"1024\", \"width\": \"3\"", 0.75),
    ];
    for (kind, options, gain) in methods {
        let mut of = |lamp: &str| error(&stage, &truth, &mut gpu, &sun(lamp, kind, "", options));
        let (flat, warped) = (of(""), of("\"warp\": \"perspective\""));
        println!("{kind}: flat {flat:.4}, warped {warped:.4}");
        assert!(warped < gain * flat, "{kind}: {warped} is not below {flat}");
    }
}
