//! Samples of a disc, turned from pixel to pixel: their mean is the exhaustive disc, and more of them are quieter.

use glam::DVec3;
use shadetree::reference::Layers;
use shadetree::render::Gpu;

use super::lamp::{Lamp, Plate, layers, under};
use crate::stage::gpu;

const RADIUS: f64 = 6.0;

/// Mean and variance over many pixels that all see one place, `x` texels beyond an edge at an angle, and where it is.
fn noise(gpu: &mut Gpu, lamp: Lamp, (angle, x): (f64, f64), options: &str) -> (f64, f64, Layers, (f64, f64)) {
    let plates = |edge: f64| [Plate { height: 1.0, edge, angle }];
    // Texels whose centres the edge runs through fall to either side: rasterisers keep places to 1/256 texel.
    let clear = |edge: &f64| {
        let at = lamp.at(beyond(lamp, (*edge, angle), x));
        layers(lamp, &plates(*edge)).margin(at.0, at.1, RADIUS as i64 + 1) > 0.004
    };
    let edge = (0..20).map(|i| 4.3 + 0.01 * f64::from(i)).find(clear).expect("an edge between centres of texels");
    let mut stage = under(lamp, &plates(edge), 0.004, (96, 96));
    // The view is moved off the edge; the picture spans less than a hundredth of a texel.
    let place = beyond(lamp, (edge, angle), x);
    stage.view.position += place - stage.view.target;
    stage.view.target = place;
    let shader = lamp.shadow("disc_shadow", &format!("\"radius\": {RADIUS}"), options);
    let values = stage.look(gpu, &shader);
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / count;
    (mean, variance, layers(lamp, &plates(edge)), lamp.at(place))
}

/// The place `x` texels beyond an edge that runs at an angle.
fn beyond(lamp: Lamp, (edge, angle): (f64, f64), x: f64) -> DVec3 {
    DVec3::new(angle.cos(), 0.0, -angle.sin()) * ((edge + x) * lamp.texel(0.0))
}

/// The places that are judged, by the edge's angle and the distance to it in texels.
const PLACES: [(f64, f64); 5] = [(0.0, 0.37), (0.3, -2.2), (-0.9, 1.6), (2.0, 3.9), (0.7, -4.6)];

/// The samples of a turn lie on rings of equal area, one on each: the mean over all turns is the midpoint rule over rings
/// for the lit share of each, whose error is at most half a ring times what that share varies by, which is at most one in
/// all for an occluder with a straight edge that is seen in steps of texels of 1/6 of the radius. What noise leaves after
/// 9216 pixels with turns that are more even than random ones is at most four standard errors of random ones.
#[test]
fn the_mean_over_pixels_is_the_exhaustive_disc() {
    let Some(mut gpu) = gpu() else { return };
    for lamp in Lamp::BOTH {
        for place in PLACES {
            for count in [8, 16, 32, 64] {
                let (mean, variance, truth, at) = noise(&mut gpu, lamp, place, &format!("\"count\": \"{count}\""));
                let exact = truth.lit_disc(at, RADIUS, 200);
                let bound = 0.5 / f64::from(count) + 4.0 * (variance / 9216.0).sqrt();
                assert!(
                    (mean - exact).abs() < bound,
                    "{lamp:?} {place:?} {count}: {mean} is not {exact} within {bound}"
                );
            }
        }
    }
}

/// Independent samples have the variance p (1 - p) / n. These are spread evenly, so theirs is less, and falls at least as fast.
#[test]
fn noise_falls_with_the_number_of_samples() {
    let Some(mut gpu) = gpu() else { return };
    for taps in ["nearest", "bilinear", "hardware"] {
        let mut before = f64::INFINITY;
        for count in [4, 8, 16, 32, 64] {
            let mut sum = 0.0;
            for place in PLACES {
                let options = format!("\"count\": \"{count}\", \"taps\": \"{taps}\"");
                let (mean, variance, ..) = noise(&mut gpu, Lamp::Spot, place, &options);
                let independent = mean * (1.0 - mean) / f64::from(count);
                assert!(variance < independent, "{taps} {place:?} {count}: {variance}, independent {independent}");
                sum += variance;
            }
            assert!(sum < 0.5 * before, "{taps} {count}: {sum} after {before}");
            before = sum;
        }
        assert!(before > 0.0);
    }
    let (_, variance, ..) = noise(&mut gpu, Lamp::Spot, PLACES[0], "\"turn\": \"off\"");
    assert!(variance < 1e-12, "without turning every pixel is the same: {variance}");
}
