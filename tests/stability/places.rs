//! Lights and receivers in awkward places: inside a caster, behind the light, at grazing angles.

use glam::{DMat4, DVec3};
use shadetree::compile::Output;
use shadetree::render::Gpu;
use shadetree::scene::Shape;

use super::bench::{SHADOWS, least, most, shadows, single_precision};
use super::table::{Bound, Table};
use crate::stage::{Item, Stage, View, gpu, light, visibility, woven};

const BULB: (&str, &str) = ("point_light", "\"position\": (0, 2, 0)");
const SPOT: (&str, &str) = ("spot_light", "\"position\": (0, 2, 0), \"direction\": (0, -1, 0)");

#[test]
fn a_light_inside_a_caster_lights_what_its_near_plane_lets_out() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "inside_caster",
        "A light in a ball of 0.5 m above the ground. Maps begin at `near`: a ball beyond it keeps all light in, a ball\nnearer than it is not there.",
        (1.0 / 1024.0, "pictures may be made in 16 bits"),
        (1e-3, 0.0),
    );
    let ball = Item::new(&Shape::Sphere { radius: 0.5, segments: 64 }, DMat4::from_translation(DVec3::Y * 2.0));
    let stage =
        Stage::new(vec![Item::plane([8.0, 8.0], DMat4::IDENTITY), ball], View::down((0.0, 0.0), 1.2, 1.6, (32, 32)));
    for (kind, at) in [BULB, SPOT] {
        for shadow in shadows(&gpu) {
            let mut look = |near: f64| {
                let lamp = format!("{at}, \"near\": {near}");
                stage.look(&mut gpu, &visibility(&light(kind, &lamp, shadow, "", "\"size\": \"512\"")))
            };
            let (closed, open) = (most(&look(0.05)), least(&look(0.7)));
            let what = format!("{kind}, {shadow}");
            // The ball is 1.5 m above the ground, 1/8 of the range. What is not reduced leaks as much as that allows.
            let gap = 1.5 / 11.95;
            let (law, most_of) = match shadow {
                "exponential_shadow" => ("T6: e^(-c gap)", (-80.0_f64 * gap).exp() * 1.01),
                "exponential_variance_shadow" => ("T10 in the rising warp", 1e-8 * 6400.0 * 1.01),
                _ => ("T10, reduced: dark", 1e-6),
            };
            table.row(format!("{what}, near 0.05: brightest"), law, closed, Bound::Most(most_of));
            table.wide(format!("{what}, near 0.7: darkest"), "lit", open, Bound::Least(1.0 - 1e-6));
        }
    }
    table.check(&gpu);
}

#[test]
fn what_lies_behind_a_light_has_no_shadow_and_no_light() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "behind_light",
        "A spotlight 1 m above the ground that looks up, or along it, with a plate above the light: visibility and light on\nthe ground behind, and pixels of the whole ground that are no numbers.",
        (0.0, ""),
        (1e-6, 0.0),
    );
    let plate = Item::plane([4.0, 4.0], DMat4::from_translation(DVec3::Y * 2.0));
    let view = View::down((0.0, 0.0), 0.9, 3.0, (48, 48));
    let stage = Stage::new(vec![Item::plane([16.0, 16.0], DMat4::IDENTITY), plate], view);
    for (way, direction) in [("up", "(0, 1, 0)"), ("along", "(1, 0, 0)")] {
        let behind = |p: DVec3| way == "up" || p.x < 0.0;
        for shadow in shadows(&gpu) {
            let lamp = format!("\"position\": (0, 1, 0), \"direction\": {direction}, \"outer_angle\": 60");
            let graph = light("spot_light", &lamp, shadow, "", "\"size\": \"256\"");
            let seen = stage.frame(&mut gpu, &visibility(&graph)).pixels;
            let values: Vec<f64> = seen.iter().map(|p| f64::from(p[0])).collect();
            let strange = values.iter().filter(|v| !(0.0..=1.0).contains(*v)).count();
            let back: Vec<f64> = stage.on_ground(&values).filter(|(p, _)| behind(*p)).map(|(_, v)| v).collect();
            let what = format!("looks {way}, {shadow}");
            table.row(format!("{what}: no numbers in [0, 1]"), "none", strange as f64, Bound::Most(0.0));
            table.row(format!("{what}: darkest behind"), "the map does not know", least(&back), Bound::Least(1.0));
            let lit = stage.frame(&mut gpu, &woven(&[("light", &graph)], Output::Radiance)).pixels;
            let lit: Vec<f64> = lit.iter().map(|p| p[..3].iter().map(|x| f64::from(x.abs())).sum()).collect();
            let light: Vec<f64> = stage.on_ground(&lit).filter(|(p, _)| behind(*p)).map(|(_, v)| v).collect();
            table.row(format!("{what}: light behind"), "none", most(&light), Bound::Most(0.0));
        }
    }
    table.check(&gpu);
}

/// A wall of half a metre across a long ground, lit from `degrees` above the horizon: the darkest pixel of the ground
/// before the wall, and how far the end of the shadow is from where it belongs, in texels as they lie on the ground.
pub(super) fn grazing(gpu: &mut Gpu, shadow: &str, degrees: f64) -> (f64, f64) {
    const RADIUS: f64 = 32.0;
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let wall =
        DMat4::from_translation(DVec3::new(-16.0, 0.25, 0.0)) * DMat4::from_rotation_z(std::f64::consts::FRAC_PI_2);
    let items = vec![Item::plane([256.0, 16.0], DMat4::IDENTITY), Item::plane([0.5, 8.0], wall)];
    let lamp = format!("\"direction\": ({cosine}, {}, 0), \"radius\": {RADIUS}", -sine);
    let shader = visibility(&light("directional_light", &lamp, shadow, "", "\"size\": \"2048\""));
    let texel = 2.0 * RADIUS / 2048.0 / sine;
    // So far away that no kernel reaches the wall.
    let before = Stage::new(items.clone(), View::down((-17.2 - 8.0 * texel, 0.0), 2.0, 2.0, (64, 64)));
    let darkest = least(&before.look(gpu, &shader));
    let end = -16.0 + 0.5 * cosine / sine;
    let seen = 24.0 * texel;
    let around = Stage::new(items, View::down((end, 0.0), seen, seen, (960, 2)));
    let values = around.look(gpu, &shader);
    // Where the ground is half lit.
    let dark = around.on_ground(&values).filter(|(p, v)| p.z > 0.0 && *v < 0.5).map(|(p, _)| p.x);
    (darkest, (dark.fold(f64::NEG_INFINITY, f64::max) - end).abs() / texel)
}

#[test]
fn grazing_light_leaves_the_ground_lit_and_shadows_where_they_belong() {
    let Some(mut gpu) = gpu() else { return };
    let mut table = Table::new(
        "grazing",
        "A wall across the ground in parallel light at an angle above the horizon: the darkest pixel before the wall, and\nthe distance of the shadow's end from its place, in texels of 1/32 m over the sine of the angle.",
        (0.03, "differences between pixels, and so footprints, are the device's own"),
        (2e-2, 0.0),
    );
    // Moments of 16 bits move edges by what their rounding is worth.
    let fine = single_precision(&gpu);
    for shadow in SHADOWS.into_iter().filter(|s| *s != "variance_shadow" || fine) {
        for degrees in [45.0, 20.0, 10.0, 5.0, 2.0, 1.0] {
            let (darkest, off) = grazing(&mut gpu, shadow, degrees);
            let what = format!("{shadow}, {degrees} degrees");
            let lit = if shadow == "variance_shadow" { 0.99 } else { 1.0 - 1e-6 };
            table.wide(format!("{what}: darkest"), "T8, T9: lit", darkest, Bound::Least(lit));
            // The edge lies within half a texel of where it is sampled, and the bleeding reduction moves half light.
            table.row(format!("{what}: off by"), "T4: half a texel and the pixel", off, Bound::Most(1.0));
        }
    }
    table.check(&gpu);
}
