//! A light's map as float64 rays know it: the depth at the centre of each texel, found where it is asked for.

use glam::{DVec2, DVec3};

use crate::hash::HashMap;
use crate::reference::{Point, Projection, View, World};

/// Most texels that are kept: some 100 MiB. Beyond, all are forgotten.
const MOST: usize = 1 << 21;
/// Steepest surface whose plane is followed beyond the shaded point, and whose slope counts as variance within a texel:
/// metres of depth per metre across. Those of the shadow nodes.
const STEEPEST: f64 = 8.0;
/// What of the angle between facets, and of grazing light, comparisons forgive: as the shadow nodes do.
const FOLD: f64 = 0.125;
const FOLD_DEPTH: f64 = 8.0;

/// A view of a light with the range of its depths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Looked {
    /// How the light looks at the scene.
    pub view: View,
    /// Distances along its axis that become depth 0 and 1, metres.
    pub range: (f64, f64),
}

impl Looked {
    /// Depth (0 at the near plane, 1 at the far one) of a distance along the axis.
    pub fn depth(&self, distance: f64) -> f64 {
        (distance - self.range.0) / (self.range.1 - self.range.0).max(1e-12)
    }

    /// Metres across per texel of a map of `side`, at a distance along the axis.
    pub fn texel(&self, side: u32, distance: f64) -> DVec2 {
        let [low, high] = self.view.window;
        let across = if self.view.projection == Projection::Perspective { distance } else { 1.0 };
        (high - low) * across / f64::from(side)
    }
}

/// One texel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texel {
    /// Distance of the nearest occluder along the axis, metres; infinite where there is none up to the far plane.
    pub distance: f64,
    /// Its depth, from 0 to 1; 1 where there is none.
    pub depth: f64,
    /// Variance of depth that the slope of the occluder makes within the texel: (dx^2 + dy^2) / 12, of a box.
    pub slope: f64,
}

/// A map of one view.
pub struct Texels<'a> {
    world: &'a World,
    looked: Looked,
    side: u32,
    known: HashMap<(u32, u32), Texel>,
}

impl<'a> Texels<'a> {
    /// Nothing is known yet.
    pub fn new(world: &'a World, looked: Looked, side: u32) -> Self {
        Self { world, looked, side: side.max(1), known: HashMap::default() }
    }

    /// How it looks at the scene.
    pub fn looked(&self) -> &Looked {
        &self.looked
    }

    /// Texels on a side.
    pub fn side(&self) -> u32 {
        self.side
    }

    /// The texel in this column and row; beyond the border that at the border.
    pub fn at(&mut self, column: i64, row: i64) -> Texel {
        let last = i64::from(self.side) - 1;
        let inside = |i: i64| u32::try_from(i.clamp(0, last)).unwrap_or_default();
        let key = (inside(column), inside(row));
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        if self.known.len() >= MOST {
            self.known.clear();
        }
        let texel = self.found(key);
        self.known.insert(key, texel);
        texel
    }

    fn found(&self, (column, row): (u32, u32)) -> Texel {
        let place = DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5) / f64::from(self.side);
        let ray = self.looked.view.ray(place);
        let hit = self.world.first_caster(&ray).filter(|(distance, _)| *distance <= self.looked.range.1);
        let Some((distance, triangle)) = hit else { return Texel { distance: f64::INFINITY, depth: 1.0, slope: 0.0 } };
        let normal = self.looked.view.rotation * self.world.normal(triangle);
        let plane = Plane::new(&self.looked, self.looked.view.point(ray.at(distance)), normal);
        let (slope, texel) = (plane.slope(self.side), self.looked.texel(self.side, distance));
        let bounded = slope.clamp(-texel * STEEPEST, texel * STEEPEST) / (self.looked.range.1 - self.looked.range.0);
        Texel { distance, depth: self.looked.depth(distance).max(0.0), slope: bounded.length_squared() / 12.0 }
    }
}

/// The plane of a receiver as a view sees it.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    looked: Looked,
    /// In the frame of the view.
    normal: DVec3,
    offset: f64,
    /// Place on the map, from (0, 0) to (1, 1).
    pub place: DVec2,
    /// Distance of the point along the axis, metres.
    pub distance: f64,
}

impl Plane {
    /// The plane through a point with a normal, both in the frame of the view.
    pub fn new(looked: &Looked, position: DVec3, normal: DVec3) -> Self {
        let place = looked.view.place(position);
        let toward = looked.view.line(place).1;
        // A plane that is seen edge on has no depth at other places; as the shadow nodes do, it is turned a little.
        let facing = normal.dot(toward);
        let least = 1e-3 * toward.length();
        let normal = if facing.abs() >= least {
            normal
        } else {
            let sign = if facing < 0.0 { -1.0 } else { 1.0 };
            normal + toward.normalize_or_zero() * (sign * least - facing) / toward.length().max(1e-12)
        };
        Self { looked: *looked, normal, offset: normal.dot(position), place, distance: position.z }
    }

    /// The plane of a point of a surface.
    pub fn of(looked: &Looked, point: &Point) -> Self {
        Self::new(looked, looked.view.point(point.position), looked.view.rotation * point.normal)
    }

    /// Distance along the axis at which the light's ray through a place of the map meets the plane, within the bounds that
    /// shadow nodes set.
    pub fn distance_at(&self, place: DVec2) -> f64 {
        let (start, direction) = self.looked.view.line(place);
        let facing = self.normal.dot(direction);
        let meets = (self.offset - self.normal.dot(start)) / facing;
        let perspective = self.looked.view.projection == Projection::Perspective;
        let bounded = if !perspective {
            meets
        } else if meets <= 0.0 || !meets.is_finite() {
            4.0 * self.distance
        } else {
            meets.min(4.0 * self.distance)
        };
        let [low, high] = self.looked.view.window;
        let scale = if perspective { self.distance } else { 1.0 };
        let across = ((place - self.place) * (high - low)).length() * scale;
        bounded.min(self.distance + STEEPEST * across)
    }

    /// Change of distance per texel of a map of `side`, along its columns and rows, metres.
    pub fn slope(&self, side: u32) -> DVec2 {
        let direction = self.looked.view.line(self.place).1;
        let facing = self.normal.dot(direction);
        let [low, high] = self.looked.view.window;
        let scale = if self.looked.view.projection == Projection::Perspective { self.distance } else { 1.0 };
        let rise = -self.normal.truncate() * scale / facing;
        rise * (high - low) / f64::from(side) * DVec2::new(1.0, -1.0)
    }

    /// Rise in depth to one texel farther along columns and rows, neither steeper than shadow nodes follow.
    pub fn depth_slope(&self, side: u32) -> DVec2 {
        let most = self.looked.texel(side, self.distance) * STEEPEST;
        self.slope(side).abs().min(most) / (self.looked.range.1 - self.looked.range.0).max(1e-12)
    }

    /// What an occluder at a distance along the axis makes of the light's half size on the map, by similar triangles: in rays
    /// per metre of source (perspective) or metres per tangent (parallel). 0 where it lies behind the point.
    pub fn reach(&self, occluder: f64) -> f64 {
        let reach = match self.looked.view.projection {
            Projection::Perspective => 1.0 / occluder.max(1e-6) - 1.0 / self.distance.max(1e-6),
            Projection::Parallel => self.distance - occluder,
        };
        reach.max(0.0)
    }

    /// By how much depth an occluder must be nearer than the plane, for filters that reach so many texels: what rounding
    /// and the facets of curved surfaces ask for.
    pub fn margin(&self, side: u32, texels: f64) -> f64 {
        let slope = self.depth_slope(side);
        let texel = self.looked.texel(side, self.distance).max_element();
        let steep = self.slope(side).length_squared() / (texel * texel).max(1e-300);
        let fold = FOLD * (1.0 + steep).min(FOLD_DEPTH) * texels * texel / (self.looked.range.1 - self.looked.range.0);
        (slope.x + slope.y) / 64.0 + 1e-6 + fold
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::Body;
    use crate::scene::Shape;
    use glam::{Mat4, Vec3};

    /// A ground at y = 0 and a plate of 2 m at y = 1, from straight above.
    pub(in super::super) fn plates() -> World {
        let plane = Shape::Plane { size: [1.0, 1.0], segments: [1, 1] }.mesh().expect("a plane");
        let body = |y: f32, size: f32| Body {
            mesh: &plane,
            object_to_world: Mat4::from_translation(Vec3::Y * y) * Mat4::from_scale(Vec3::splat(size)),
            casts: true,
            receives: true,
        };
        World::new(&[body(0.0, 20.0), body(1.0, 2.0)])
    }

    #[test]
    fn texels_hold_the_depth_of_what_the_light_sees() {
        let world = plates();
        let looked = Looked { view: View::perspective(DVec3::Y * 5.0, DVec3::NEG_Y, 0.7, 1.0), range: (1.0, 9.0) };
        let mut map = Texels::new(&world, looked, 64);
        assert_eq!((map.at(31, 31).distance, map.at(31, 31).depth), (4.0, 3.0 / 8.0));
        assert_eq!((map.at(1, 40).distance, map.at(-3, 40).distance), (5.0, 5.0));
        assert!(map.at(5, 5).slope < 1e-20, "plates across the axis have no slope");
        let looked = Looked { range: (1.0, 4.5), ..looked };
        let mut shallow = Texels::new(&world, looked, 64);
        assert_eq!(shallow.at(1, 40).depth, 1.0, "behind the far plane nothing is drawn");
    }

    #[test]
    fn planes_meet_rays_where_texels_of_them_lie() {
        let tilted = Shape::Plane { size: [6.0, 6.0], segments: [1, 1] }.mesh().expect("a plane");
        let turned = Mat4::from_rotation_x(0.4) * Mat4::from_rotation_z(0.2);
        let world = World::new(&[Body { mesh: &tilted, object_to_world: turned, casts: true, receives: true }]);
        for view in [
            View::perspective(DVec3::Y * 5.0, DVec3::NEG_Y, 0.4, 1.0),
            View::parallel(DVec3::ZERO, DVec3::new(0.2, -1.0, 0.1), 2.0, -9.0),
        ] {
            let looked = Looked { view, range: (-9.0, 9.0) };
            let mut map = Texels::new(&world, looked, 128);
            let point = world.seen(&view.ray(DVec2::new(0.4, 0.55))).expect("the plane").1;
            let plane = Plane::of(&looked, &point);
            for (column, row) in [(40, 80), (60, 70), (51, 70)] {
                let place = DVec2::new(column as f64 + 0.5, row as f64 + 0.5) / 128.0;
                assert!((map.at(column, row).distance - plane.distance_at(place)).abs() < 1e-9);
            }
            let step = plane.distance_at(plane.place + DVec2::new(1.0 / 128.0, 0.0)) - plane.distance;
            assert!((step - plane.slope(128).x).abs() < 0.03 * step.abs(), "{step} {}", plane.slope(128));
            let step = plane.distance_at(plane.place + DVec2::new(0.0, 1.0 / 128.0)) - plane.distance;
            assert!((step - plane.slope(128).y).abs() < 0.03 * step.abs(), "{step} {}", plane.slope(128));
        }
    }
}
