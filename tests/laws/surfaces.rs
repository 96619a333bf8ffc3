//! Where shadows must not be, and where they must: slopes, contacts, and the limits of a map.

use glam::{DMat4, DVec3};
use shadetree::compile::Compiled;
use shadetree::render::Gpu;
use shadetree::scene::Shape;

use crate::stage::{Item, Stage, View, gpu, grain, light, renders, skipped, visibility};

const SUN: (&str, &str) = ("directional_light", "\"direction\": (0, -1, 0), \"radius\": 1");
const SPOT: (&str, &str) = (
    "spot_light",
    "\"position\": (0, 4, 0), \"direction\": (0, -1, 0), \"outer_angle\": 30, \"inner_angle\": 20, \"near\": 0.5",
);

/// A plane through the origin that falls by `degrees` towards -x, seen along its normal around a point of it.
fn slope(degrees: f64, (u, v): (f64, f64), seen: f64) -> Stage {
    let turn = DMat4::from_rotation_z(degrees.to_radians());
    let target = turn.transform_point3(DVec3::new(u, 0.0, v));
    let position = target + turn.transform_vector3(DVec3::Y) * 0.5;
    let view = View { position, target, up: DVec3::NEG_Z, half_height: seen, size: (48, 48) };
    Stage::new(vec![Item::plane([12.0, 12.0], turn)], view)
}

/// The least visibility on lit slopes, from 0 to 80 degrees, from afar and from near.
fn darkest_slope(gpu: &mut Gpu, shader: &Compiled) -> (f64, String) {
    let mut darkest = (1.0, String::new());
    for degrees in [0.0, 5.0, 15.0, 30.0, 45.0, 60.0, 70.0, 75.0, 80.0] {
        for (at, seen) in [((0.0, 0.0), 1.0), ((0.31, 0.2), 0.2), ((0.31, 0.2), 0.01)] {
            let stage = slope(degrees, at, seen);
            let values = stage.look(gpu, shader);
            let least = values.iter().copied().fold(1.0, f64::min);
            if least < darkest.0 {
                let share = values.iter().filter(|v| **v < 1.0).count() as f64 / values.len() as f64;
                darkest = (least, format!("{degrees} degrees, {seen} seen: {least} at least, {share} of the pixels"));
            }
        }
    }
    darkest
}

#[test]
fn comparisons_do_not_darken_lit_slopes() {
    let Some(mut gpu) = gpu() else { return };
    let (mut failed, lit) = (Vec::new(), 1.0 - grain(&gpu));
    for (kind, lamp) in [SUN, SPOT] {
        let mut check = |shadow: &str, options: &str| {
            let shader = visibility(&light(kind, lamp, shadow, "", options));
            let (least, what) = darkest_slope(&mut gpu, &shader);
            // Weights that are summed twice may differ in the last bit.
            if least < lit {
                failed.push(format!("{kind} {shadow} {options}: {what}"));
            }
        };
        check("hard_shadow", "");
        check("hard_shadow", "\"size\": \"256\"");
        check("pcf_shadow", "");
        for metric in ["zw", "radial"] {
            check("hard_shadow", &format!("\"metric\": \"{metric}\""));
            check("hard_shadow", &format!("\"metric\": \"{metric}\", \"size\": \"256\""));
            check("pcf_shadow", &format!("\"metric\": \"{metric}\", \"size\": \"256\", \"width\": \"9\""));
        }
        check("pcss_shadow", "");
        check("pcss_shadow", "\"size\": \"256\", \"filter\": \"64\"");
        check("adaptive_pcf_shadow", "");
        for taps in ["nearest", "bilinear", "hardware"] {
            check("disc_shadow", &format!("\"size\": \"256\", \"taps\": \"{taps}\""));
            if taps != "nearest" {
                check("adaptive_pcf_shadow", &format!("\"size\": \"256\", \"taps\": \"{taps}\""));
            }
            for width in [1, 3, 5, 7, 9] {
                check("pcf_shadow", &format!("\"size\": \"256\", \"width\": \"{width}\", \"taps\": \"{taps}\""));
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// The mean over a plane is the plane, so that lit slopes are lit. Devices choose their own anisotropic kernel, and that of
/// lavapipe is not centred: by a fraction of a texel, which the variance of a blurred map hides but for 0.03 (of an
/// unblurred one but for 0.21).
#[test]
fn variance_hardly_darkens_lit_slopes() {
    let Some(mut gpu) = gpu() else { return };
    let (mut failed, lit) = (Vec::new(), 1.0 - grain(&gpu));
    // 16 bits add their rounding to what the kernel does.
    let anisotropic = if renders(&gpu, "rg32float") { 0.97 } else { 0.94 };
    for (kind, lamp) in [SUN, SPOT] {
        let mut check = |options: &str, bar: f64| {
            let shader = visibility(&light(kind, lamp, "variance_shadow", "", options));
            let (least, what) = darkest_slope(&mut gpu, &shader);
            if least < bar {
                failed.push(format!("{kind} {options}: {what}"));
            }
        };
        for slope in ["on", "off"] {
            for width in [1, 5, 11] {
                check(
                    &format!(
                        "\"size\": \"256\", \"width\": \"{width}\", \"anisotropy\": \"1\", \"slope_variance\": \"{slope}\""
                    ),
                    lit,
                );
            }
        }
        check("\"anisotropy\": \"1\"", lit);
        check("\"anisotropy\": \"1\", \"mips\": \"off\", \"filter\": \"linear\"", lit);
        check("", lit);
        // Software adapters take one mip level for four pixels, which interpolation in the shader cannot know.
        check("\"sampling\": \"manual\", \"mips\": \"off\"", lit);
        check("\"sampling\": \"hardware\"", anisotropic);
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// Exponentials need no bias: their mean over a slope is above the exponential of its middle. The falling warp and four
/// moments take a part of the kernel's slope for an occluder: at 0.008 per texel and 9 texels, a float64 model loses 0.031 to
/// the former, and 0.27 to the latter without a bias of half a kernel, with which they lose no more either.
#[test]
fn exponentials_and_moments_hardly_darken_lit_slopes() {
    let Some(mut gpu) = gpu() else { return };
    if !renders(&gpu, "rgba32float") {
        return skipped(&format!("{} has no maps of 32-bit floats", gpu.adapter()));
    }
    for (kind, lamp) in [SUN, SPOT] {
        for (shadow, options, bar) in [
            ("exponential_shadow", "", 1.0 - 2e-3),
            ("exponential_variance_shadow", "\"warps\": \"one\"", 1.0 - 2e-3),
            ("exponential_variance_shadow", "", 1.0 - 0.031),
            ("moment_shadow", "", 1.0 - 0.031),
            ("moment_shadow", "\"width\": \"11\"", 1.0 - 0.031),
        ] {
            let shader = visibility(&light(kind, lamp, shadow, "", options));
            let (least, what) = darkest_slope(&mut gpu, &shader);
            assert!(least >= bar, "{kind} {shadow} {options}: {what}");
        }
    }
}

/// Far away a pixel covers many texels, whose slope is as much of the filter's as that of the blur.
#[test]
fn moments_do_not_darken_lit_ground_up_to_the_horizon() {
    let Some(mut gpu) = gpu() else { return };
    if !renders(&gpu, "rgba32float") {
        return skipped(&format!("{} has no maps of 32-bit floats", gpu.adapter()));
    }
    let view = View {
        position: DVec3::new(0.6, 1.1, 40.0),
        target: DVec3::new(0.5, 0.0, 20.0),
        up: DVec3::Y,
        half_height: 0.04,
        size: (40, 20),
    };
    let stage = Stage::new(vec![Item::plane([60.0, 80.0], DMat4::IDENTITY)], view);
    let sun = "\"direction\": (1, -0.7, -0.15)";
    let values = stage.look(&mut gpu, &visibility(&light("directional_light", sun, "moment_shadow", "", "")));
    let least = values.into_iter().fold(1.0, f64::min);
    assert!(least >= 1.0 - 0.031, "{least}");
}

/// Every shadow node with its defaults.
const SHADOWS: [&str; 8] = [
    "hard_shadow",
    "pcf_shadow",
    "disc_shadow",
    "adaptive_pcf_shadow",
    "pcss_shadow",
    "variance_shadow",
    "exponential_variance_shadow",
    "moment_shadow",
];

/// Those whose maps an adapter can make as they are by default.
fn shadows(gpu: &Gpu) -> Vec<&'static str> {
    let (single, deep) = (renders(gpu, "rgba32float"), ["exponential_variance_shadow", "moment_shadow"]);
    if !single {
        skipped(&format!("{} has no maps of 32-bit floats for {}", gpu.adapter(), deep.join(" and ")));
    }
    SHADOWS.into_iter().filter(|s| single || !deep.contains(s)).collect()
}

/// A box on the ground, lit from the left at 45 degrees: the ground right behind it is dark up to the contact.
#[test]
fn no_light_leaks_in_at_a_contact() {
    let Some(mut gpu) = gpu() else { return };
    let sun = ("directional_light", "\"direction\": (1, -1, 0)");
    let spot = ("spot_light", "\"position\": (-4, 4, 0), \"direction\": (1, -1, 0), \"near\": 0.5");
    let cube = Shape::Box { size: [1.0; 3], bevel: 0.0 };
    let cube = Item::new(&cube, DMat4::from_translation(DVec3::Y * 0.5));
    let view = View {
        position: DVec3::new(3.0, 2.0, 0.0),
        target: DVec3::new(0.8, 0.0, 0.0),
        up: DVec3::Y,
        half_height: 0.15,
        size: (192, 192),
    };
    let stage = Stage::new(vec![Item::plane([8.0, 8.0], DMat4::IDENTITY), cube], view);
    for (kind, lamp) in [sun, spot] {
        for shadow in shadows(&gpu) {
            let values = stage.look(&mut gpu, &visibility(&light(kind, lamp, shadow, "", "")));
            let behind = |p: DVec3| p.x > 0.5005 && p.x < 1.3 && p.z.abs() < 0.35;
            let umbra: Vec<(DVec3, f64)> = stage.on_ground(&values).filter(|(p, _)| behind(*p)).collect();
            assert!(umbra.len() > 500 && umbra.iter().any(|(p, _)| p.x < 0.52), "{} pixels", umbra.len());
            let (at, most) = umbra.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1)).expect("some");
            assert!(most < 1.0 / 255.0, "{kind} {shadow}: {most} at {at}");
        }
    }
}

/// A plate 1 m above the whole ground, seen from below.
fn roofed() -> Stage {
    let ground = Item::plane([12.0, 12.0], DMat4::IDENTITY);
    let roof = Item::plane([12.0, 12.0], DMat4::from_translation(DVec3::Y));
    Stage::new(vec![ground, roof], View::down((0.0, 0.0), 0.9, 1.6, (64, 64)))
}

#[test]
fn what_a_map_does_not_cover_is_lit() {
    let Some(mut gpu) = gpu() else { return };
    for shadow in shadows(&gpu) {
        let small =
            visibility(&light("directional_light", "\"direction\": (0, -1, 0), \"radius\": 0.5", shadow, "", ""));
        let stage = roofed();
        let values = stage.look(&mut gpu, &small);
        for (point, value) in stage.on_ground(&values) {
            let beside = point.x.abs().max(point.z.abs()) - 0.5;
            if beside.abs() > 1e-3 {
                let expected = if beside > 0.0 { 1.0 } else { 0.0 };
                assert!((value - expected).abs() < 1e-4, "{shadow} at {point}: {value}");
            }
        }
        // The ground lies 4 m below the light.
        for (near, range, expected) in [(3.5, 12.0, 1.0), (4.5, 12.0, 1.0), (0.5, 12.0, 0.0), (0.5, 3.5, 0.0)] {
            let (kind, at) = SPOT;
            let at = at.replace("\"near\": 0.5", &format!("\"near\": {near}, \"range\": {range}"));
            let shader = visibility(&light(kind, &at, shadow, "", ""));
            let values = stage.look(&mut gpu, &shader);
            let off = values.iter().map(|v| (v - expected).abs()).fold(0.0, f64::max);
            assert!(off < 1e-4, "{shadow}, near {near}, range {range}: {off}");
            let mut open = roofed();
            open.items.pop();
            let lit = 1.0 - grain(&gpu);
            assert!(open.look(&mut gpu, &shader).iter().all(|v| *v >= lit), "{shadow}, near {near}, range {range}");
        }
    }
}

#[test]
fn objects_that_neither_cast_nor_receive_do_not() {
    let Some(mut gpu) = gpu() else { return };
    for (kind, lamp) in [SUN, SPOT] {
        for shadow in shadows(&gpu) {
            let shader = visibility(&light(kind, lamp, shadow, "", ""));
            let (mut stage, lit) = (roofed(), 1.0 - grain(&gpu));
            let middle = |values: Vec<f64>| values[32 * 64 + 32];
            assert!(middle(stage.look(&mut gpu, &shader)) < 1e-3, "{kind} {shadow}");
            stage.items[0].receives = false;
            assert!(stage.look(&mut gpu, &shader).iter().all(|v| *v == 1.0), "{kind} {shadow}: receives");
            stage.items[0].receives = true;
            stage.items[1].casts = false;
            // The mean of many equal depths may differ from them in the last bit.
            assert!(stage.look(&mut gpu, &shader).iter().all(|v| *v >= lit), "{kind} {shadow}: casts");
        }
    }
}
