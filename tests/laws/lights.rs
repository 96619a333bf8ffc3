//! Shadows of one light multiply, and lights add up.

use glam::{DMat4, DVec3, Vec4};
use shadetree::compile::{Compiled, Output};
use shadetree::render::{Surroundings, SurroundingsLevel};

use super::planar::worst;
use crate::stage::{Item, Stage, View, gpu, grain, visibility, woven};

const SUN: &str = "\"lamp\": (kind: \"directional_light\", params: {\"direction\": (1, -1, 0.3), \"radius\": 2})";
const SPOT: &str = "\"lamp\": (kind: \"spot_light\", params: {\"position\": (2, 3, 1), \"direction\": (-2, -3, -1), \"color\": (1, 0.6, 0.2)})";

fn graph(lamp: &str, shadows: &[(&str, &str)]) -> String {
    let nodes: String = shadows.iter().map(|(name, kind)| format!(", \"{name}\": (kind: \"{kind}\")")).collect();
    let names: Vec<&str> = std::iter::once("lamp").chain(shadows.iter().map(|(name, _)| *name)).collect();
    let links: Vec<String> = names.windows(2).map(|w| format!("\"{} -> {}\"", w[0], w[1])).collect();
    format!("Graph(version: 1, nodes: {{{lamp}{nodes}}}, links: [{}])", links.join(", "))
}

/// Two bars that cross over the ground, with grey light all around.
fn bars() -> Stage {
    let bar = |height: f64, turn: f64| {
        let turned = DMat4::from_rotation_y(turn);
        Item::plane([0.3, 3.0], DMat4::from_translation(DVec3::Y * height) * turned)
    };
    let view = View {
        position: DVec3::new(0.0, 3.0, 3.0),
        target: DVec3::ZERO,
        up: DVec3::Y,
        half_height: 0.4,
        size: (64, 64),
    };
    let mut stage = Stage::new(vec![Item::plane([12.0, 12.0], DMat4::IDENTITY), bar(0.6, 0.2), bar(0.9, 1.4)], view);
    let mut irradiance = [Vec4::ZERO; 9];
    irradiance[0] = Vec4::new(0.5, 0.4, 0.3, 0.0);
    let levels = vec![SurroundingsLevel { width: 1, height: 1, pixels: vec![[0.1; 4]] }];
    stage.surroundings = Some(Surroundings { levels, irradiance, background: true });
    stage
}

#[test]
fn shadows_of_one_light_multiply() {
    let Some(mut gpu) = gpu() else { return };
    let stage = bars();
    for lamp in [SUN, SPOT] {
        let mut look = |shadows: &[(&str, &str)]| stage.look(&mut gpu, &visibility(&graph(lamp, shadows)));
        let both = look(&[("a", "pcf_shadow"), ("b", "variance_shadow")]);
        let (a, b) = (look(&[("a", "pcf_shadow")]), look(&[("b", "variance_shadow")]));
        let product: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a * b).collect();
        assert!(worst(both.iter().copied().zip(product)) < 2.0 * grain(&gpu));
        let between = |all: &[f64]| all.iter().filter(|v| **v > 0.1 && **v < 0.9).count();
        assert!(between(&both) > 20 && worst(a.into_iter().zip(b)) > 0.05, "the shadows differ: {}", between(&both));
    }
}

#[test]
fn lights_add_up_and_the_surroundings_count_once() {
    let Some(mut gpu) = gpu() else { return };
    let stage = bars();
    let (sun, spot) = (graph(SUN, &[("a", "pcf_shadow")]), graph(SPOT, &[("b", "variance_shadow")]));
    // Three pictures are compared with one.
    let bar = 4.0 * grain(&gpu);
    let mut picture = |lights: &[(&str, &str)]| {
        let shader: Compiled = woven(lights, Output::Radiance);
        stage.frame(&mut gpu, &shader).pixels
    };
    let all = picture(&[("sun", &sun), ("spot", &spot)]);
    let (first, second) = (picture(&[("sun", &sun)]), picture(&[("spot", &spot)]));
    let none = picture(&[]);
    let ambient = none.iter().map(|p| p[0]).fold(0.0, f32::max);
    let brightest = all.iter().map(|p| p[0]).fold(0.0, f32::max);
    assert!(ambient > 0.05 && brightest > 4.0 * ambient, "{ambient} {brightest}");
    for (i, pixel) in all.iter().enumerate() {
        for channel in 0..3 {
            let sum = first[i][channel] + second[i][channel] - none[i][channel];
            assert!(
                f64::from((pixel[channel] - sum).abs()) < bar * f64::from(1.0 + sum),
                "pixel {i}: {} is not {sum}",
                pixel[channel]
            );
        }
    }
}
