//! Shadows that search for occluders and filter as wide as the penumbra that these make (Fernando 2005), as their nodes do.

use glam::DVec2;

use super::filter::disc;
use super::texels::{Plane, Texels};
use crate::reference::{Projection, Source};

/// The light as a receiver sees it on the map.
struct Shape {
    /// Its half axes for a reach of 1, in texels.
    axes: [DVec2; 2],
    /// An ellipse, or else a parallelogram.
    round: bool,
}

impl Shape {
    fn new(source: &Source, plane: &Plane, map: &Texels<'_>) -> Self {
        let view = map.looked().view;
        let perspective = view.projection == Projection::Perspective;
        let [low, high] = view.window;
        let texels = DVec2::splat(f64::from(map.side())) / (high - low) * DVec2::new(1.0, -1.0);
        let even = |half: f64| [DVec2::X * half * texels.x, DVec2::Y * half * texels.y];
        match source {
            Source::Point { .. } => Self { axes: [DVec2::ZERO; 2], round: true },
            // A ball is stretched away from the middle of the map, as it faces the receiver and not the map.
            Source::Ball { radius, .. } if perspective => {
                let off = (plane.place - 0.5) * (high - low);
                let outwards = off.normalize_or(DVec2::X);
                let first = outwards * (1.0 + off.length_squared()).sqrt() * *radius;
                Self { axes: [first * texels.abs(), outwards.perp() * *radius * texels.abs()], round: true }
            }
            Source::Ball { radius, .. } | Source::Disc { radius, .. } => Self { axes: even(*radius), round: true },
            Source::Distant { angle, .. } => Self { axes: even(angle.tan()), round: true },
            Source::Rectangle { half, .. } => {
                Self { axes: half.map(|axis| (view.rotation * axis).truncate() * texels), round: false }
            }
        }
    }

    /// A sample of it, from a sample of the unit disc.
    fn at(&self, place: DVec2) -> DVec2 {
        let place = if self.round { place } else { on_square(place) };
        self.axes[0] * place.x + self.axes[1] * place.y
    }
}

/// From the unit disc to the square [-1, 1] x [-1, 1], equal areas to equal areas (Shirley and Chiu 1997).
fn on_square(place: DVec2) -> DVec2 {
    let (radius, quarter) = (place.length(), std::f64::consts::FRAC_PI_4);
    if place.x.abs() >= place.y.abs() {
        let along = radius * place.x.signum();
        DVec2::new(along, if place.x == 0.0 { 0.0 } else { along * (place.y / place.x).atan() / quarter })
    } else {
        let along = radius * place.y.signum();
        DVec2::new(along * (place.x / place.y).atan() / quarter, along)
    }
}

/// Visibility, with so many samples for the search and for the filter, turned by a part of a circle.
pub(super) fn searched(
    (search, filter): (u32, u32),
    source: &Source,
    turn: f64,
    plane: &Plane,
    map: &mut Texels<'_>,
) -> f64 {
    let side = f64::from(map.side());
    let looked = *map.looked();
    let perspective = looked.view.projection == Projection::Perspective;
    let shape = Shape::new(source, plane, map);
    let nearest = looked.range.0.max(if perspective { 0.25 * plane.distance } else { f64::NEG_INFINITY });
    let at = plane.place * side;
    let inside = |place: DVec2| place.clamp(DVec2::splat(0.5), DVec2::splat(side - 0.5));
    let depth_at = |place: DVec2| looked.depth(plane.distance_at(place / side)).clamp(0.0, 1.0);
    let (mut total, mut found) = (0.0, 0.0);
    for place in disc(search, turn) {
        let center = inside((at + shape.at(place) * plane.reach(nearest)).floor() + 0.5);
        let texel = map.at(center.x.floor() as i64, center.y.floor() as i64);
        if texel.depth < depth_at(center) - plane.margin(map.side(), (center - at).length()) {
            total += texel.distance;
            found += 1.0;
        }
    }
    if found < 0.5 {
        return 1.0;
    }
    let wide = plane.reach((total / found).max(nearest));
    let longest = shape.axes[0].length().max(shape.axes[1].length()) * wide;
    let margin = plane.margin(map.side(), longest * if shape.round { 1.0 } else { std::f64::consts::SQRT_2 } + 1.0);
    // A sampler compares four texels with one depth: that of a texel away, where the plane is nearest to the light.
    let nearer = -plane.slope(map.side()).map(|s| if s == 0.0 { 0.0 } else { s.signum() });
    let mut lit = 0.0;
    for place in disc(filter, turn + 0.5) {
        let there = inside(at + shape.at(place) * wide);
        let depth = depth_at(there + nearer) - margin;
        let corner = there - 0.5;
        let (first, part) = (corner.floor(), corner - corner.floor());
        for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let share = |part: f64, far: i64| if far == 0 { 1.0 - part } else { part };
            let texel = map.at(first.x as i64 + x, first.y as i64 + y);
            lit += if texel.depth < depth { 0.0 } else { share(part.x, x) * share(part.y, y) };
        }
    }
    lit / f64::from(filter)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn discs_become_squares_of_equal_parts() {
        let all: Vec<DVec2> = disc(4000, 0.3).map(on_square).collect();
        assert!(all.iter().all(|p| p.abs().max_element() <= 1.0));
        for (low, high) in [(-1.0, -0.5), (-0.5, 0.0), (0.0, 0.5), (0.5, 1.0)] {
            for of in [|p: &DVec2| p.x, |p: &DVec2| p.y] {
                let share = all.iter().filter(|p| (low..high).contains(&of(p))).count() as f64 / all.len() as f64;
                assert!((share - 0.25).abs() < 0.01, "{low} {share}");
            }
        }
        assert_eq!(on_square(DVec2::ZERO), DVec2::ZERO);
    }
}
