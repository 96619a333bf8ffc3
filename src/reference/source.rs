//! What shines: sources of light as sets of points or directions, and well spread samples of them.

use glam::{DVec2, DVec3};

/// A source that shines evenly: each part of its surface, or of the sky that it fills, gives the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// A point.
    Point {
        /// Where it is.
        position: DVec3,
    },
    /// A ball, as bright from everywhere: a disc that faces whoever looks.
    Ball {
        /// Its middle.
        center: DVec3,
        /// Its radius, metres.
        radius: f64,
    },
    /// A disc.
    Disc {
        /// Its middle.
        center: DVec3,
        /// What it faces; any length.
        normal: DVec3,
        /// Its radius, metres.
        radius: f64,
    },
    /// A rectangle, or any parallelogram.
    Rectangle {
        /// Its middle.
        center: DVec3,
        /// From the middle to the middle of two neighbouring sides.
        half: [DVec3; 2],
    },
    /// So far away that its direction is the same everywhere.
    Distant {
        /// The way that its light travels; any length.
        direction: DVec3,
        /// Half the angle that it is seen under, radians: 0.00465 for the sun.
        angle: f64,
    },
}

impl Source {
    /// Whether every sample of it is the same.
    pub fn is_sharp(&self) -> bool {
        match *self {
            Self::Point { .. } => true,
            Self::Ball { radius, .. } | Self::Disc { radius, .. } => radius == 0.0,
            Self::Rectangle { half, .. } => half == [DVec3::ZERO; 2],
            Self::Distant { angle, .. } => angle == 0.0,
        }
    }

    /// From a point to the part of the source that belongs to a place in the unit square; equal areas to equal areas. To
    /// a near source it reaches from the point to the source; to a distant one its length is one.
    pub fn towards(&self, point: DVec3, place: DVec2) -> DVec3 {
        match *self {
            Self::Point { position } => position - point,
            Self::Ball { center, radius } => {
                let axis = center - point;
                let distance = axis.length();
                // From inside there is no outline; what is nearer than the middle stands in the light.
                let Some(unit) = axis.try_normalize().filter(|_| distance > radius) else { return axis };
                let ray = cap(unit, (radius / distance).asin(), place);
                // To the plane through the middle that faces the point.
                ray * (distance / ray.dot(unit))
            }
            Self::Disc { center, normal, radius } => {
                let [x, y] = beside(normal.normalize_or(DVec3::Y));
                let at = disc(place) * radius;
                center + x * at.x + y * at.y - point
            }
            Self::Rectangle { center, half: [u, v] } => {
                let at = place * 2.0 - 1.0;
                center + u * at.x + v * at.y - point
            }
            Self::Distant { direction, angle } => cap(-direction.normalize_or(DVec3::NEG_Y), angle, place),
        }
    }

    /// Whether rays to it end somewhere.
    pub fn is_near(&self) -> bool {
        !matches!(self, Self::Distant { .. })
    }
}

/// A unit vector within an angle (radians) of another: equal areas of the unit square to equal areas of the cap.
fn cap(axis: DVec3, angle: f64, place: DVec2) -> DVec3 {
    let [x, y] = beside(axis);
    // 1 - cosine grows with the square of the radius, as areas do on both; 1 - cos a = 2 sin^2(a / 2).
    let at = disc(place);
    let lost = at.length_squared() * 2.0 * (angle / 2.0).sin().powi(2);
    let sine = (lost * (2.0 - lost)).max(0.0).sqrt();
    let around = at.normalize_or_zero() * sine;
    axis * (1.0 - lost) + x * around.x + y * around.y
}

/// Two unit vectors at right angles to a unit vector and to each other.
fn beside(axis: DVec3) -> [DVec3; 2] {
    let x = axis.any_orthonormal_vector();
    [x, axis.cross(x)]
}

/// The unit square to the unit disc, equal areas to equal areas, neighbours to neighbours (Shirley and Chiu 1997, "A Low
/// Distortion Map Between Disk and Square").
fn disc(place: DVec2) -> DVec2 {
    let at = place * 2.0 - 1.0;
    let eighth = std::f64::consts::FRAC_PI_4;
    let (radius, angle) = if at == DVec2::ZERO {
        return at;
    } else if at.x.abs() > at.y.abs() {
        (at.x, eighth * at.y / at.x)
    } else {
        (at.y, 2.0 * eighth - eighth * at.x / at.y)
    };
    DVec2::from_angle(angle) * radius
}

/// Place number `index` of a sequence that fills the unit square evenly: the first two dimensions of Sobol' (1967), each
/// with its digits flipped by a part of `scramble` (Kollig and Keller 2002, "Efficient Multidimensional Sampling",
/// section 3.2). Over all scrambles each place is equally likely, so a mean over samples is right on average.
pub(super) fn spread(index: u32, scramble: u64) -> DVec2 {
    let mut second = 0_u32;
    let (mut bits, mut column) = (index, 1_u32 << 31);
    while bits != 0 {
        if bits & 1 == 1 {
            second ^= column;
        }
        bits >>= 1;
        column ^= column >> 1;
    }
    let unit = |x: u32| (f64::from(x) + 0.5) / 4_294_967_296.0;
    DVec2::new(unit(index.reverse_bits() ^ (scramble >> 32) as u32), unit(second ^ scramble as u32))
}

/// A number without pattern from two others (the finaliser of SplitMix64; Steele, Lea and Flood 2014).
pub(super) fn hash(a: u64, b: u64) -> u64 {
    let mut x = a.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(b).wrapping_add(0x9e37_79b9_7f4a_7c15);
    for (shift, factor) in [(30, 0xbf58_476d_1ce4_e5b9), (27, 0x94d0_49bb_1331_11eb)] {
        x = (x ^ (x >> shift)).wrapping_mul(factor);
    }
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_fill_strips_and_squares_evenly() {
        for scramble in [0, hash(1, 2), hash(3, 4)] {
            let places: Vec<DVec2> = (0..64).map(|i| spread(i, scramble)).collect();
            for (columns, rows) in [(64, 1), (1, 64), (8, 8), (4, 16), (32, 2)] {
                let cell = |p: &DVec2| ((p.x * f64::from(columns)) as u32, (p.y * f64::from(rows)) as u32);
                let cells: std::collections::BTreeSet<_> = places.iter().map(cell).collect();
                assert_eq!(cells.len(), 64, "{columns} x {rows}");
            }
            assert!(places.iter().all(|p| p.min_element() > 0.0 && p.max_element() < 1.0));
        }
    }

    #[test]
    fn discs_and_caps_are_covered_evenly() {
        let count = 4096;
        let places: Vec<DVec2> = (0..count).map(|i| disc(spread(i, 0))).collect();
        for (radius, angle) in [(0.5, 1.0), (0.8, 2.0), (1.0, 0.5)] {
            // A sector between two radii: its share of the disc.
            let within = |p: &&DVec2| p.length() < radius && p.y.atan2(p.x).abs() < angle;
            let share = places.iter().filter(within).count() as f64 / f64::from(count);
            let truth = radius * radius * angle / std::f64::consts::PI;
            assert!((share - truth).abs() < 0.005, "{share} {truth}");
        }
        let sun = Source::Distant { direction: DVec3::new(1.0, -2.0, 0.5), angle: 0.3 };
        let axis = -DVec3::new(1.0, -2.0, 0.5).normalize();
        let cosines: Vec<f64> = (0..count).map(|i| sun.towards(DVec3::ONE, spread(i, 0)).dot(axis)).collect();
        assert!(cosines.iter().all(|c| *c >= 0.3_f64.cos() - 1e-12 && *c <= 1.0 + 1e-12));
        // Areas of caps are proportional to 1 - cosine.
        let half = 1.0 - (1.0 - 0.3_f64.cos()) / 2.0;
        let share = cosines.iter().filter(|c| **c > half).count() as f64 / f64::from(count);
        assert!((share - 0.5).abs() < 0.005, "{share}");
    }

    #[test]
    fn sources_lie_where_they_are_said_to() {
        let point = DVec3::new(0.5, 0.0, -1.0);
        let center = DVec3::new(1.0, 3.0, 2.0);
        let rectangle = Source::Rectangle { center, half: [DVec3::X * 0.5, DVec3::Z * 0.25] };
        assert_eq!(rectangle.towards(point, DVec2::new(1.0, 0.0)) + point, center + DVec3::new(0.5, 0.0, -0.25));
        let disc = Source::Disc { center, normal: DVec3::Y, radius: 0.5 };
        for i in 0..100 {
            let at = disc.towards(point, spread(i, 7)) + point - center;
            assert!(at.y.abs() < 1e-12 && at.length() <= 0.5 + 1e-12);
        }
        let ball = Source::Ball { center, radius: 0.5 };
        let distance = point.distance(center);
        for i in 0..100 {
            // Every ray touches or cuts the ball, and ends beside its middle.
            let ray = ball.towards(point, spread(i, 9));
            let along = ray.normalize().dot(center - point);
            assert!((distance * distance - along * along).max(0.0).sqrt() <= 0.5 + 1e-9);
            assert!(((point + ray - center).dot(center - point)).abs() < 1e-9);
        }
        let inside = ball.towards(center + DVec3::X * 0.1, DVec2::splat(0.3));
        assert!(inside.abs_diff_eq(DVec3::X * -0.1, 1e-12), "{inside}");
        assert!(Source::Point { position: center }.is_sharp() && !disc.is_sharp() && !rectangle.is_sharp());
    }
}
