//! Lights with a size: how much of them shows above a straight edge, what they send to a point, and the share of a disc
//! that a map holds.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Layers;

/// A shining surface as an occluder's edge meets it. Sizes are halves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Emitter {
    /// A disc of this radius.
    Disc(f64),
    /// A rectangle that reaches this far along each of its axes, `x` and `y`.
    Rectangle(f64, f64),
}

impl Emitter {
    /// The share of the source on the side of a line where `x cos(angle) + y sin(angle)` is less than `distance`: a
    /// circular segment, or a cut rectangle.
    pub fn share_below(self, distance: f64, angle: f64) -> f64 {
        match self {
            Self::Disc(radius) => {
                let x = (distance / radius).clamp(-1.0, 1.0);
                (FRAC_PI_2 + x.asin() + x * (1.0 - x * x).sqrt()) / PI
            }
            Self::Rectangle(half_x, half_y) => {
                // Projected onto the line's normal, a rectangle is two boxes, convolved.
                let (a, b) = (half_x * angle.cos().abs(), half_y * angle.sin().abs());
                let (wide, narrow) = (a.max(b), a.min(b));
                if narrow < 1e-12 * wide {
                    return (0.5 + distance / (2.0 * wide)).clamp(0.0, 1.0);
                }
                // The second integral of the wide box, differenced over the narrow one.
                let ramp = |t: f64| {
                    let t = t.max(-wide);
                    if t < wide { (t + wide).powi(2) / (4.0 * wide) } else { t }
                };
                (ramp(distance + narrow) - ramp(distance - narrow)) / (2.0 * narrow)
            }
        }
    }
}

/// How much larger than its source a penumbra is: on a receiver at `receiver` from the light behind an edge at `edge`,
/// both along the axis of the light, its full width is that of the source times (receiver - edge) / edge.
pub fn penumbra_scale(receiver: f64, edge: f64) -> f64 {
    (receiver - edge) / edge
}

/// Irradiance per radiance, as a vector, that a shining rectangle with these half sizes, in the plane z = 0 around the
/// origin and shining along +z, sends to a point: the integral of direction towards the source over solid angle,
/// by the midpoint rule on `steps` by `steps` patches. Its product with a normal that sees all of the source is the
/// irradiance there (Lambert 1760).
pub fn rectangle_irradiance((half_x, half_y): (f64, f64), point: [f64; 3], steps: u32) -> [f64; 3] {
    let mut sum = [0.0; 3];
    let patch = 4.0 * half_x * half_y / f64::from(steps).powi(2);
    let at = |i: u32, half: f64| ((f64::from(i) + 0.5) / f64::from(steps) * 2.0 - 1.0) * half;
    for (i, j) in (0..steps).flat_map(|i| (0..steps).map(move |j| (i, j))) {
        let way = [at(i, half_x) - point[0], at(j, half_y) - point[1], -point[2]];
        let squared = way.iter().map(|w| w * w).sum::<f64>();
        // The solid angle of a patch is its area times the cosine at the source over the square of the distance.
        let weight = patch * (point[2] / squared.sqrt()).max(0.0) / squared;
        for (sum, way) in sum.iter_mut().zip(way) {
            *sum += weight * way / squared.sqrt();
        }
    }
    sum
}

impl Layers {
    /// The lit share of the disc of a radius in texels around a position, every texel counted by the area of the disc that
    /// it holds: what samples of the disc approach. By strips of `1 / steps` texel, whose error is below 1 / steps.
    pub fn lit_disc(&self, (x, y): (f64, f64), radius: f64, steps: u32) -> f64 {
        let receives = |column: i64, row: i64| self.depth(column, row) >= self.receiver;
        let rows = (2.0 * radius * f64::from(steps)).ceil().max(1.0);
        let (mut lit, mut area) = (0.0, 0.0);
        let height = 2.0 * radius / rows;
        for i in 0..rows as i64 {
            let v = y - radius + (i as f64 + 0.5) * height;
            let half = (radius * radius - (v - y).powi(2)).max(0.0).sqrt();
            area += 2.0 * half;
            let (low, high) = (x - half, x + half);
            for column in low.floor() as i64..=high.floor() as i64 {
                let part = high.min(column as f64 + 1.0) - low.max(column as f64);
                if receives(column, v.floor() as i64) {
                    lit += part;
                }
            }
        }
        lit / area
    }
}

#[cfg(test)]
mod tests {
    use super::super::Layer;
    use super::*;

    /// The share of a source below a line, counted.
    fn counted(emitter: Emitter, distance: f64, angle: f64) -> f64 {
        let steps = 400;
        let at = |i: i32, half: f64| ((f64::from(i) + 0.5) / f64::from(steps) * 2.0 - 1.0) * half;
        let (half_x, half_y) = match emitter {
            Emitter::Disc(radius) => (radius, radius),
            Emitter::Rectangle(x, y) => (x, y),
        };
        let (mut inside, mut below) = (0.0, 0.0);
        for (i, j) in (0..steps).flat_map(|i| (0..steps).map(move |j| (i, j))) {
            let (x, y) = (at(i, half_x), at(j, half_y));
            if matches!(emitter, Emitter::Rectangle(..)) || x * x + y * y <= half_x * half_x {
                inside += 1.0;
                below += if x * angle.cos() + y * angle.sin() < distance { 1.0 } else { 0.0 };
            }
        }
        below / inside
    }

    #[test]
    fn shares_of_sources_are_areas() {
        for source in [Emitter::Disc(0.7), Emitter::Rectangle(0.5, 0.2), Emitter::Rectangle(0.3, 0.9)] {
            for angle in [0.0, 0.4, FRAC_PI_2, 2.5] {
                for distance in [-2.0, -0.6, -0.31, 0.0, 0.13, 0.45, 2.0] {
                    let (a, b) = (source.share_below(distance, angle), counted(source, distance, angle));
                    assert!((a - b).abs() < 0.006, "{source:?} {distance} {angle}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn a_small_source_follows_the_inverse_square() {
        let [x, y, z] = rectangle_irradiance((0.01, 0.02), [3.0, 0.0, 4.0], 8);
        // Area times the cosine at the source over the square of the distance, towards the source.
        let size = 4.0 * 0.01 * 0.02 * 0.8 / 25.0;
        assert!((x + size * 0.6).abs() < 1e-4 * size && y.abs() < 1e-12 && (z + size * 0.8).abs() < 1e-4 * size);
    }

    #[test]
    fn a_disc_over_a_straight_edge_is_a_segment() {
        let scene = Layers { receiver: 0.8, layers: vec![Layer { depth: 0.3, sides: vec![[1.0, 0.0, 10.0]] }] };
        for x in [5.0, 8.1, 10.0, 11.7, 16.0] {
            let lit = scene.lit_disc((x, 3.3), 4.0, 400);
            let exact = Emitter::Disc(4.0).share_below(x - 10.0, 0.0);
            assert!((lit - exact).abs() < 2e-4, "{x}: {lit} {exact}");
        }
    }
}
