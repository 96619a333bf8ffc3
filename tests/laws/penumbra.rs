//! T4, last sentence: an edge between a light of width L and a receiver makes a ramp of width L (d_r - d_b) / d_b.

use glam::{DMat4, DVec3};
use shadetree::reference::{Emitter, penumbra_scale};
use shadetree::render::Gpu;

use crate::stage::{Item, Stage, View, gpu, light, visibility};

/// Height of the light above the ground; its map is 2 * 1024 texels wide at half the opening of 25 degrees.
const HEIGHT: f64 = 4.0;

/// A light of which the map and the shape are known.
struct Lamp {
    kind: &'static str,
    params: String,
    emitter: Emitter,
    /// Full width of the penumbra on the ground that an edge at a height casts, for a source of width 2; and where the
    /// edge's shadow is, for an edge at 1.
    scale: fn(f64) -> (f64, f64),
    /// Metres per texel on the ground.
    texel: f64,
}

fn from_above(height: f64) -> (f64, f64) {
    (penumbra_scale(HEIGHT, HEIGHT - height), HEIGHT / (HEIGHT - height))
}

fn lamps() -> Vec<Lamp> {
    let above = "\"position\": (0, 4, 0), \"direction\": (0, -1, 0), \"outer_angle\": 25, \"near\": 1, \"range\": 5";
    let texel = 2.0 * HEIGHT * 25.0_f64.to_radians().tan() / 1024.0;
    let rectangle = |width: f64, height: f64| Lamp {
        kind: "rectangle_light",
        params: format!("{above}, \"width\": {width}, \"height\": {height}"),
        emitter: Emitter::Rectangle(width / 2.0, height / 2.0),
        scale: from_above,
        texel,
    };
    let ball = Emitter::Disc(0.2);
    vec![
        Lamp {
            kind: "spot_light",
            params: format!("{above}, \"radius\": 0.2"),
            emitter: ball,
            scale: from_above,
            texel,
        },
        Lamp {
            kind: "point_light",
            params: "\"position\": (0, 4, 0), \"near\": 1, \"range\": 5, \"radius\": 0.2".into(),
            emitter: ball,
            scale: from_above,
            texel: 2.0 * HEIGHT * 1.0625 / 1024.0,
        },
        Lamp {
            kind: "directional_light",
            params: "\"direction\": (0, -1, 0), \"radius\": 2, \"angle\": 5".into(),
            emitter: Emitter::Disc(5.0_f64.to_radians().tan()),
            scale: |height| (height, 1.0),
            texel: 4.0 / 1024.0,
        },
        rectangle(0.4, 0.1),
        rectangle(0.1, 0.5),
    ]
}

/// Mean visibility by the distance to the edge's shadow, across the penumbra and a little beyond, with the number of pixels
/// that each is the mean of.
fn profile(gpu: &mut Gpu, lamp: &Lamp, height: f64, angle: f64, options: &str) -> (Vec<(f64, f64)>, f64) {
    let (scale, moved) = (lamp.scale)(height);
    let edge = 0.12;
    let half = match lamp.emitter {
        Emitter::Disc(radius) => radius,
        Emitter::Rectangle(x, y) => x * angle.cos().abs() + y * angle.sin().abs(),
    } * scale;
    let plate = DMat4::from_rotation_y(angle) * DMat4::from_translation(DVec3::new(edge - 4.0, height, 0.0));
    let across = DVec3::new(angle.cos(), 0.0, -angle.sin());
    let middle = across * (edge * moved);
    let mut view = View::down((middle.x, middle.z), 0.75 * height, 2.6 * half, (80, 80));
    // Columns run along the edge.
    view.up = DVec3::new(-angle.sin(), 0.0, -angle.cos());
    let stage = Stage::new(vec![Item::plane([16.0, 16.0], DMat4::IDENTITY), Item::plane([8.0, 16.0], plate)], view);
    let shader =
        visibility(&light(lamp.kind, &lamp.params, "pcss_shadow", "", &format!("\"size\": \"1024\", {options}")));
    let values = stage.look(gpu, &shader);
    let points: Vec<_> = stage.on_ground(&values).collect();
    let column = |x: usize| points.iter().skip(x).step_by(80);
    let mean = |x: usize| column(x).map(|(_, v)| v).sum::<f64>() / 80.0;
    ((0..80).map(|x| (points[x].0.dot(across) - edge * moved, mean(x))).collect(), half)
}

/// Lights of every projection and both shapes, near and far edges, along and across the map.
///
/// What a mean over 80 pixels may be off by: half a ring of the samples, 1/128, as for any disc; as much again for noise, of
/// which even turns leave less than half a sample; and an edge that texels shift by up to half a texel, and that blended
/// samples spread over one: 3/4 of a texel, in a ramp whose steepest part is 2 / pi per half width (disc; 1/2 for a
/// rectangle along its axes).
#[test]
fn penumbrae_are_as_wide_as_similar_triangles_say() {
    let Some(mut gpu) = gpu() else { return };
    let mut wrong = Vec::new();
    for lamp in lamps() {
        for (height, angle) in [(0.5, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 0.5), (1.0, std::f64::consts::FRAC_PI_2)] {
            let (profile, half) = profile(&mut gpu, &lamp, height, angle, "\"search\": \"32\", \"filter\": \"64\"");
            let (scale, _) = (lamp.scale)(height);
            let bound = 2.0 / 128.0 + 0.75 * lamp.texel / half * (2.0 / std::f64::consts::PI);
            let mut most = (0.0, 0.0);
            for (x, value) in &profile {
                // The part of the light that shows above the edge, as far beyond the edge's shadow as scaled.
                let exact = lamp.emitter.share_below(x / scale, angle);
                if (value - exact).abs() > most.0 {
                    most = ((value - exact).abs(), x / half);
                }
            }
            if most.0 > bound {
                wrong.push(format!("{} {height} {angle}: {most:?}, bound {bound}", lamp.kind));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
