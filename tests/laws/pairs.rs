//! Every light under every shadow, as they come: dark under a plate, lit beside it, and nothing but a number between.

use glam::{DMat4, DVec3};
use shadetree::render::RenderError;

use crate::stage::{Item, Stage, View, gpu, skipped, visibility};
use crate::support::kinds;

/// Kinds of lights with what puts them 4 m above the ground, shining down on 4 m of it; small, where they have a size.
const LIGHTS: [(&str, &str, &str); 6] = [
    (
        "spot_light",
        "\"position\": (0, 4, 0), \"direction\": (0, -1, 0), \"outer_angle\": 40, \"near\": 1, \"range\": 6, \"radius\": 0.05",
        "",
    ),
    (
        "spot_light",
        "\"position\": (0, 4, 0), \"direction\": (0, -1, 0), \"outer_angle\": 40, \"near\": 1, \"range\": 6, \"radius\": 0.05",
        "\"warp\": \"perspective\"",
    ),
    ("point_light", "\"position\": (0, 4, 0), \"near\": 1, \"range\": 6, \"radius\": 0.05", ""),
    (
        "rectangle_light",
        "\"position\": (0, 4, 0), \"direction\": (0, -1, 0), \"near\": 1, \"range\": 6, \"width\": 0.1, \"height\": 0.1",
        "",
    ),
    ("directional_light", "\"direction\": (0, -1, 0)", ""),
    ("directional_light", "\"direction\": (0, -1, 0)", "\"splits\": \"3\", \"blend\": \"on\""),
];

/// A ground of 6 m with a plate of 1 m, 1.5 m above it, seen from the side.
fn stage() -> Stage {
    let items = vec![
        Item::plane([6.0, 6.0], DMat4::IDENTITY),
        Item::plane([1.0, 1.0], DMat4::from_translation(DVec3::Y * 1.5)),
    ];
    let view = View {
        position: DVec3::new(0.0, 0.9, 4.0),
        target: DVec3::new(0.0, 0.0, 0.0),
        up: DVec3::Y,
        half_height: 0.2,
        size: (64, 32),
    };
    Stage::new(items, view)
}

#[test]
fn every_shadow_on_every_light_tells_light_from_dark() {
    let Some(mut gpu) = gpu() else { return };
    let mut pairs = 0;
    for (light, lamp, lamp_options) in LIGHTS {
        for shadow in kinds("shadow") {
            let name = format!("{light} {lamp_options} {shadow}");
            let shader = visibility(&format!(
                "Graph(version: 1, nodes: {{\"lamp\": (kind: \"{light}\", params: {{{lamp}}}, options: \
                 {{{lamp_options}}}), \"shadow\": (kind: \"{shadow}\", options: {{\"size\": \"512\"}})}}, links: \
                 [\"lamp -> shadow\"])"
            ));
            let stage = stage();
            let frame = match gpu.render(&stage.job(&shader)) {
                Ok(frame) => frame,
                Err(RenderError::Unsupported(why)) => {
                    skipped(&format!("{name}: {why}"));
                    continue;
                }
                Err(error) => panic!("{name}: {error}"),
            };
            let values: Vec<f64> = frame.pixels.iter().map(|p| f64::from(p[0])).collect();
            assert!(values.iter().all(|v| (0.0..=1.0).contains(v)), "{name}: {values:?}");
            // The shadow reaches 0.8 m to each side; penumbrae and filters of the sizes here take less than 0.3 m of it.
            let on_ground = |least: f64, most: f64| {
                let (mut sum, mut count) = (0.0, 0.0);
                for (point, value) in stage.on_ground(&values) {
                    let away = point.x.abs().max(point.z.abs());
                    if (least..most).contains(&away) && point.z < 2.0 {
                        sum += value;
                        count += 1.0;
                    }
                }
                assert!(count >= 16.0, "{name}: {count} pixels");
                sum / count
            };
            let (dark, lit) = (on_ground(0.0, 0.25), on_ground(1.2, 2.2));
            assert!(dark < 0.02, "{name}: {dark} in full shadow");
            assert!(lit > 0.98, "{name}: {lit} in full light");
            pairs += 1;
        }
    }
    println!("{pairs} pairs of light and shadow");
    assert!(pairs >= 40, "{pairs}");
}
