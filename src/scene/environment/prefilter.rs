//! Rougher levels of an environment.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec2, Vec3, Vec4};

use super::Level;
use super::map::texcoord_of;

/// Directions taken per texel.
const SAMPLES: u32 = 48;

/// `base`, then `count` - 1 levels for the GGX roughness 1 / (count - 1) to 1, each half as large.
///
/// The split-sum prefilter of Karis (2013): the view is taken along the normal, half vectors are drawn from the GGX
/// distribution, samples weigh as their cosine. Each sample reads a box-filtered level that matches the solid angle
/// that it stands for (Colbert and Krivanek 2007), so few samples give no noise. Deterministic; a constant stays
/// constant.
pub(super) fn levels(base: Level, count: u32) -> Vec<Level> {
    let boxes = box_levels(base, count);
    let mut levels = vec![boxes[0].clone()];
    for (i, size) in boxes.iter().enumerate().skip(1) {
        let roughness = i as f64 / f64::from(count.max(2) - 1);
        let lobe = lobe(roughness, boxes[0].width);
        levels.push(Level::from_fn(size.width, size.height, |normal| filter(&boxes, &lobe, normal)));
    }
    levels
}

/// A direction about the normal (z), its weight, and the box level to read it from.
struct Sample {
    direction: DVec3,
    weight: f64,
    level: f32,
}

fn lobe(roughness: f64, width: u32) -> Vec<Sample> {
    let alpha2 = roughness.powi(4);
    let texel = 4.0 * PI / (f64::from(width) * f64::from(width / 2));
    let samples = (0..SAMPLES).filter_map(|i| {
        let turn = TAU * radical_inverse(i);
        let share = (f64::from(i) + 0.5) / f64::from(SAMPLES);
        let cos2 = (1.0 - share) / (1.0 + (alpha2 - 1.0) * share);
        let (cos, sin) = (cos2.sqrt(), (1.0 - cos2).max(0.0).sqrt());
        let half = DVec3::new(turn.cos() * sin, turn.sin() * sin, cos);
        let direction = 2.0 * cos * half - DVec3::Z;
        // Density of the reflected direction with view along the normal: D cos / (4 cos).
        let d = alpha2 / (PI * (cos2 * (alpha2 - 1.0) + 1.0).powi(2));
        let angle = 4.0 / (d * f64::from(SAMPLES));
        let level = (0.5 * (angle / texel).log2() + 0.5).max(0.0) as f32;
        (direction.z > 0.0).then_some(Sample { direction, weight: direction.z, level })
    });
    samples.collect()
}

fn filter(boxes: &[Level], lobe: &[Sample], normal: DVec3) -> DVec3 {
    let (tangent, bitangent) = normal.any_orthonormal_pair();
    let mut sum = Vec3::ZERO;
    let mut weights = 0.0;
    for sample in lobe {
        let d = sample.direction;
        let direction = tangent * d.x + bitangent * d.y + normal * d.z;
        sum += trilinear(boxes, texcoord_of(direction).as_vec2(), sample.level).truncate() * sample.weight as f32;
        weights += sample.weight;
    }
    sum.as_dvec3() / weights.max(1e-9)
}

fn trilinear(levels: &[Level], at: Vec2, level: f32) -> Vec4 {
    let last = levels.len() - 1;
    let level = level.min(last as f32);
    let lower = level as usize;
    let a = bilinear(&levels[lower], at);
    if lower == last { a } else { a.lerp(bilinear(&levels[lower + 1], at), level.fract()) }
}

/// Repeats along u and clamps along v.
fn bilinear(level: &Level, at: Vec2) -> Vec4 {
    let (width, height) = (level.width as i32, level.height as i32);
    let at = Vec2::new(at.x * width as f32, at.y * height as f32) - 0.5;
    let corner = at.floor();
    let part = at - corner;
    let texel = |dx: i32, dy: i32| {
        let x = (corner.x as i32 + dx).rem_euclid(width);
        let y = (corner.y as i32 + dy).clamp(0, height - 1);
        Vec4::from_array(level.pixels[(y * width + x) as usize])
    };
    texel(0, 0).lerp(texel(1, 0), part.x).lerp(texel(0, 1).lerp(texel(1, 1), part.x), part.y)
}

/// The base and its halves by averages of four texels, weighted by solid angle.
fn box_levels(base: Level, count: u32) -> Vec<Level> {
    let mut levels = vec![base];
    for _ in 1..count {
        let Some(last) = levels.last().filter(|l| l.width >= 2 && l.height >= 2) else {
            break;
        };
        let (width, height) = (last.width / 2, last.height / 2);
        let mut pixels = Vec::with_capacity((width * height) as usize);
        for y in 0..height {
            let weight = |row: u32| (PI * (f64::from(row) + 0.5) / f64::from(last.height)).sin() as f32;
            let (upper, lower) = (weight(2 * y), weight(2 * y + 1));
            for x in 0..width {
                let texel =
                    |dx: u32, dy: u32| Vec4::from_array(last.pixels[((2 * y + dy) * last.width + 2 * x + dx) as usize]);
                let sum = (texel(0, 0) + texel(1, 0)) * upper + (texel(0, 1) + texel(1, 1)) * lower;
                pixels.push((sum / (2.0 * (upper + lower))).to_array());
            }
        }
        levels.push(Level { width, height, pixels });
    }
    levels
}

/// Van der Corput sequence in base 2.
fn radical_inverse(i: u32) -> f64 {
    f64::from(i.reverse_bits()) / (f64::from(u32::MAX) + 1.0)
}

#[cfg(test)]
mod tests {
    use super::super::map::direction_of;
    use super::*;

    #[test]
    fn levels_halve_and_a_constant_stays_constant() {
        let base = Level::from_fn(64, 32, |_| DVec3::new(0.25, 1.0, 3.0));
        let levels = levels(base, 5);
        let widths: Vec<u32> = levels.iter().map(|l| l.width).collect();
        assert_eq!(widths, [64, 32, 16, 8, 4]);
        for pixel in levels.iter().flat_map(|l| &l.pixels) {
            assert!((Vec4::from_array(*pixel) - Vec4::new(0.25, 1.0, 3.0, 1.0)).length() < 1e-4, "{pixel:?}");
        }
    }

    #[test]
    fn rougher_levels_vary_less_and_keep_where_the_light_is() {
        let sun = DVec3::new(0.3, 0.5, -0.8).normalize();
        let base = Level::from_fn(128, 64, |d| DVec3::splat(d.dot(sun).max(0.0).powi(200) * 50.0));
        let levels = levels(base, 6);
        let mut peak = f32::INFINITY;
        for level in &levels {
            let brightest = level.texels().max_by(|a, b| a.2.x.total_cmp(&b.2.x)).unwrap();
            assert!((brightest.2.x as f32) < peak, "level {} is not smoother", level.width);
            peak = brightest.2.x as f32;
            let texel = std::f64::consts::PI / f64::from(level.height);
            assert!(brightest.0.angle_between(sun) < 1.5 * texel, "level {} moved", level.width);
        }
    }

    #[test]
    fn places_and_directions_are_inverse() {
        for i in 0..100 {
            let at = glam::DVec2::new((f64::from(i) * 0.618).fract(), (f64::from(i) + 0.5) / 100.0);
            assert!((texcoord_of(direction_of(at)) - at).length() < 1e-9);
        }
        assert!((direction_of(glam::DVec2::splat(0.5)) - DVec3::NEG_Z).length() < 1e-12);
        assert!((direction_of(glam::DVec2::new(0.75, 0.5)) - DVec3::X).length() < 1e-12);
    }
}
