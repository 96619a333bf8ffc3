//! Visibility by rays from the receiver to the source.

use super::ray::Ray;
use super::source::{Source, hash, spread};
use super::view::View;
use super::world::{Point, World};

/// Groups of samples whose means are compared to tell how far off their common mean may be.
pub const GROUPS: u32 = 16;

/// A value that is known up to chance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The value.
    pub mean: f64,
    /// Standard error of the mean: it is off by less with a chance of about two in three. Zero also where all samples
    /// happen to agree.
    pub error: f64,
}

impl Estimate {
    /// A value that is known.
    pub const fn exact(mean: f64) -> Self {
        Self { mean, error: 0.0 }
    }
}

/// The share of a source that a point sees past what stands in the light. Nothing in front of the near plane of `view`,
/// if there is one, stands in the light.
///
/// The surface of the point itself does not stand in its light, whichever side the light is on: which side shines back is
/// for the surface to say. Rays start [`World::epsilon`] off it, along its normal, on the side of the sample. `samples`
/// are rounded up to a multiple of [`GROUPS`], and `seed` chooses them; a sharp source takes one.
pub fn visibility(
    world: &World,
    source: &Source,
    view: Option<&View>,
    point: &Point,
    samples: u32,
    seed: u64,
) -> Estimate {
    let lit = |index: u32, scramble: u64| {
        let towards = source.towards(point.position, spread(index, scramble));
        let side = if point.normal.dot(towards) < 0.0 { -1.0 } else { 1.0 };
        let origin = point.position + point.normal * (side * world.epsilon());
        let mut far = if source.is_near() { 1.0 } else { f64::INFINITY };
        if let Some(view) = view {
            // z falls along the ray; behind this distance it is less than near.
            let (here, change) = (view.point(point.position).z, (view.rotation * towards).z);
            if change < 0.0 {
                far = far.min((view.near - here) / change);
            }
        }
        !world.is_blocked(&Ray { origin, direction: towards, near: 0.0, far })
    };
    let share = |is_lit: bool| f64::from(u8::from(is_lit));
    if source.is_sharp() {
        return Estimate::exact(share(lit(0, seed)));
    }
    // The groups are independent of each other, the samples of a group are spread; so the spread of their means tells
    // the error, and their mean has less of it than as many independent samples.
    let each = samples.div_ceil(GROUPS).max(1);
    let mean_of = |group: u32| {
        let scramble = hash(seed, u64::from(group));
        (0..each).map(|i| share(lit(i, scramble))).sum::<f64>() / f64::from(each)
    };
    let means: Vec<f64> = (0..GROUPS).map(mean_of).collect();
    let count = f64::from(GROUPS);
    let mean = means.iter().sum::<f64>() / count;
    let variance = means.iter().map(|m| (m - mean).powi(2)).sum::<f64>() / (count - 1.0);
    Estimate { mean, error: (variance / count).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::super::world::Body;
    use super::*;
    use crate::scene::Shape;
    use glam::{DVec3, Mat4, Vec3};

    /// A ground at y = 0 and a half plane at y = 1 that covers x < 0.
    fn half_plane() -> World {
        let plane = Shape::Plane { size: [200.0, 200.0], segments: [1, 1] }.mesh().expect("a plane");
        let body = |x: f32, y: f32| Body {
            mesh: &plane,
            object_to_world: Mat4::from_translation(Vec3::new(x, y, 0.0)),
            casts: true,
            receives: true,
        };
        World::new(&[body(0.0, 0.0), body(-100.0, 1.0)])
    }

    fn ground(x: f64) -> Point {
        Point { position: DVec3::new(x, 0.0, 0.1), normal: DVec3::Y, triangle: 0, receives: true }
    }

    const HEIGHT: f64 = 4.0;
    const RADIUS: f64 = 0.25;

    /// The part of the light, in half widths from its middle, beyond which a ground point at `x` sees it past the edge.
    fn hidden_up_to(x: f64) -> f64 {
        // The line from (x, 0) over the edge at (0, 1) meets the height of the light at x - x * HEIGHT.
        (x - x * HEIGHT) / RADIUS
    }

    fn rectangle() -> Source {
        Source::Rectangle { center: DVec3::Y * HEIGHT, half: [DVec3::X * RADIUS, DVec3::Z * 0.4] }
    }

    fn disc() -> Source {
        Source::Disc { center: DVec3::Y * HEIGHT, normal: DVec3::NEG_Y, radius: RADIUS }
    }

    /// A ramp of width L (d_r - d_b) / d_b: law T4 for area lights.
    fn ramp(x: f64) -> f64 {
        let (to_occluder, to_receiver) = (HEIGHT - 1.0, HEIGHT);
        let width = 2.0 * RADIUS * (to_receiver - to_occluder) / to_occluder;
        (0.5 + x / width).clamp(0.0, 1.0)
    }

    /// The area of a circle beyond a chord.
    fn segment(x: f64) -> f64 {
        let h = hidden_up_to(x).clamp(-1.0, 1.0);
        (h.acos() - h * (1.0 - h * h).sqrt()) / std::f64::consts::PI
    }

    fn places() -> impl Iterator<Item = f64> {
        (-60..=60).map(|i| f64::from(i) * 0.0021 + 0.0003)
    }

    #[test]
    fn a_rectangle_past_a_half_plane_is_a_ramp() {
        let world = half_plane();
        for x in places() {
            assert!((ramp(x) - ((1.0 - hidden_up_to(x)) / 2.0).clamp(0.0, 1.0)).abs() < 1e-12, "two ways to say it");
            let found = visibility(&world, &rectangle(), None, &ground(x), 1024, 5);
            // Each group has one of its 64 samples in each 64th of the width, so no group is off by more than that.
            assert!((found.mean - ramp(x)).abs() <= 1.0 / 64.0, "{x}: {found:?} {}", ramp(x));
            // Within five standard errors; where the groups agree by chance, within what they could not tell apart.
            assert!((found.mean - ramp(x)).abs() <= 5.0 * found.error + 0.5 / 64.0, "{x}: {found:?} {}", ramp(x));
        }
    }

    #[test]
    fn a_disc_past_a_half_plane_is_a_segment_and_its_error_is_honest() {
        let world = half_plane();
        let (mut within, mut count) = (0, 0);
        for (seed, x) in (0..).zip(places()) {
            let found = visibility(&world, &disc(), None, &ground(x), 1024, seed);
            let off = (found.mean - segment(x)).abs();
            assert!(off < 5.0 * found.error + 0.5 / 64.0, "{x}: {found:?} {}", segment(x));
            if segment(x) > 0.02 && segment(x) < 0.98 {
                count += 1;
                within += usize::from(off < 2.0 * found.error);
            }
        }
        // Two standard errors of 16 groups hold 94% (Student's t); of some 75 places fewer than 85% is a chance of 1 in 500.
        assert!(count > 70 && within as f64 > 0.85 * f64::from(count), "{within} of {count}");
    }

    /// At least as fast as independent samples: 64 times as many leave at most an eighth of the error.
    #[test]
    fn more_samples_bring_the_error_down() {
        let world = half_plane();
        for (source, truth) in [(rectangle(), ramp as fn(f64) -> f64), (disc(), segment)] {
            let rms = |samples: u32| {
                let squares = (0..).zip(places()).map(|(seed, x)| {
                    (visibility(&world, &source, None, &ground(x), samples, seed).mean - truth(x)).powi(2)
                });
                (squares.sum::<f64>() / 121.0).sqrt()
            };
            let errors = [64, 256, 1024, 4096].map(rms);
            assert!(errors[3] < errors[0] / 8.0, "{errors:?}");
            for (error, samples) in errors.iter().zip([64_f64, 256.0, 1024.0, 4096.0]) {
                assert!(*error < 0.5 / samples.sqrt(), "worse than independent samples: {errors:?}");
            }
        }
    }

    #[test]
    fn a_sun_past_a_half_plane_is_a_segment_of_its_disc() {
        let world = half_plane();
        let angle = 0.02_f64;
        let sun = Source::Distant { direction: DVec3::NEG_Y, angle };
        for x in [-0.03, -0.015, -0.004, 0.0, 0.007, 0.018, 0.03] {
            let found = visibility(&world, &sun, None, &ground(x), 4096, 1);
            let h = (-x / angle).clamp(-1.0, 1.0);
            let truth = (h.acos() - h * (1.0 - h * h).sqrt()) / std::f64::consts::PI;
            // The cap is flat to within the square of its angle.
            assert!((found.mean - truth).abs() < 5.0 * found.error + 1e-3, "{x}: {found:?} {truth}");
        }
        let sharp = Source::Distant { direction: DVec3::NEG_Y, angle: 0.0 };
        assert_eq!(visibility(&world, &sharp, None, &ground(-0.001), 64, 0), Estimate::exact(0.0));
        assert_eq!(visibility(&world, &sharp, None, &ground(0.001), 64, 0), Estimate::exact(1.0));
    }

    /// Points far out on a ground, seen at all angles from both sides, do not stand in their own light.
    #[test]
    fn surfaces_do_not_shadow_themselves() {
        let ball = Shape::Sphere { radius: 50.0, segments: 64 }.mesh().expect("a ball");
        let body = Body { mesh: &ball, object_to_world: Mat4::IDENTITY, casts: true, receives: true };
        let world = World::new(&[body]);
        for i in 0..2000 {
            let t = f64::from(i) * 0.618;
            let eye = DVec3::new(t.cos() * 90.0, (t * 1.7).sin() * 90.0, (t * 0.3).sin() * 120.0);
            let aim = DVec3::new((t * 3.1).sin(), (t * 2.3).cos(), (t * 1.3).sin()) * 30.0;
            let eye = if eye.length() < 55.0 { eye.normalize() * 55.0 } else { eye };
            let ray = Ray { origin: eye, direction: (aim - eye).normalize(), near: 0.0, far: f64::INFINITY };
            let (_, point) = world.seen(&ray).expect("the ball");
            // A light above the facet's plane sees all of it, as the ball is convex.
            let up =
                (point.normal + (eye.normalize() - point.normal * point.normal.dot(eye.normalize())) * 3.0).normalize();
            let lamp = Source::Point { position: point.position + up * 70.0 };
            assert_eq!(visibility(&world, &lamp, None, &point, 1, 0).mean, 1.0, "{i}");
            let behind = Source::Point { position: point.position - up * 300.0 };
            assert_eq!(visibility(&world, &behind, None, &point, 1, 0).mean, 0.0, "{i}: through the ball");
        }
    }

    #[test]
    fn nothing_in_front_of_the_near_plane_stands_in_the_light() {
        let world = half_plane();
        let lamp = Source::Point { position: DVec3::Y * HEIGHT };
        let view = |near: f64| View::perspective(DVec3::Y * HEIGHT, DVec3::NEG_Y, 0.7, near);
        let lit = |near: f64| visibility(&world, &lamp, Some(&view(near)), &ground(-0.5), 1, 0).mean;
        assert_eq!((lit(2.9), lit(3.1)), (0.0, 1.0));
    }
}
