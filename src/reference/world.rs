//! Meshes as rays meet them: what is seen, and what stands in the light.

use glam::{DVec3, Mat4};

use super::bvh::Bvh;
use super::ray::Ray;
use crate::scene::Mesh;

/// A mesh in its place.
#[derive(Clone, Copy, Debug)]
pub struct Body<'a> {
    /// Its triangles.
    pub mesh: &'a Mesh,
    /// Where it stands.
    pub object_to_world: Mat4,
    /// Whether it stands in the light. If not, only the eye sees it.
    pub casts: bool,
    /// Whether shadows fall on it.
    pub receives: bool,
}

/// Bodies in world space, metres, in float64: exactly what float32 meshes and transforms say.
#[derive(Clone, Debug)]
pub struct World {
    corners: Vec<[DVec3; 3]>,
    /// Per triangle: which body it belongs to.
    owners: Vec<u32>,
    casts: Vec<bool>,
    receives: Vec<bool>,
    all: Bvh,
    /// Those that stand in the light, with their numbers in `corners`; none if all do.
    casters: Option<(Bvh, Vec<u32>)>,
    boxes: Vec<[DVec3; 8]>,
    epsilon: f64,
}

/// A point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Where it is.
    pub position: DVec3,
    /// Unit normal of its triangle, on the side that counter-clockwise corners face.
    pub normal: DVec3,
    /// Its triangle.
    pub triangle: u32,
    /// Whether shadows fall on it.
    pub receives: bool,
}

impl World {
    /// Puts bodies in their places.
    pub fn new(bodies: &[Body<'_>]) -> Self {
        let (mut corners, mut owners, mut boxes) = (Vec::new(), Vec::new(), Vec::new());
        for (index, body) in bodies.iter().enumerate() {
            let place = body.object_to_world.as_dmat4();
            let positions: Vec<DVec3> = body.mesh.positions.iter().map(|p| p.as_dvec3()).collect();
            let placed: Vec<DVec3> = positions.iter().map(|p| place.transform_point3(*p)).collect();
            let finite = || positions.iter().copied().filter(|p| p.is_finite());
            if let Some(low) = finite().reduce(DVec3::min) {
                let high = finite().fold(low, DVec3::max);
                let ends = [low, high];
                let corner = |i: usize| DVec3::new(ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2].z);
                boxes.push(std::array::from_fn(|i| place.transform_point3(corner(i))));
            }
            for triangle in body.mesh.indices.chunks_exact(3) {
                let corner = |i: usize| placed.get(triangle[i] as usize).copied().unwrap_or(DVec3::NAN);
                corners.push([corner(0), corner(1), corner(2)]);
                owners.push(u32::try_from(index).unwrap_or(u32::MAX));
            }
        }
        let casts: Vec<bool> = bodies.iter().map(|b| b.casts).collect();
        let casters = casts.contains(&false).then(|| {
            let numbers: Vec<u32> = (0..).zip(&owners).filter(|(_, o)| casts[**o as usize]).map(|(n, _)| n).collect();
            let only: Vec<_> = numbers.iter().map(|n| corners[*n as usize]).collect();
            (Bvh::new(&only), numbers)
        });
        let farthest = corners.iter().flatten().filter(|p| p.is_finite()).map(|p| p.abs().max_element());
        let size = farthest.fold(0.0, f64::max);
        let receives = bodies.iter().map(|b| b.receives).collect();
        Self { all: Bvh::new(&corners), corners, owners, casts, receives, casters, boxes, epsilon: size * 1e-9 }
    }

    /// The length, in metres, below which nothing is told apart: a part in 10^9 of the greatest coordinate. Float64
    /// leaves hit points off their triangles by some parts in 10^15 of it, and by 10^6 times as much where a ray grazes.
    pub fn epsilon(&self) -> f64 {
        self.epsilon
    }

    /// What an eye sees along a ray, with its distance.
    pub fn seen(&self, ray: &Ray) -> Option<(f64, Point)> {
        let (distance, triangle) = self.all.nearest(ray)?;
        let receives = self.receives[self.owners[triangle as usize] as usize];
        Some((distance, Point { position: ray.at(distance), normal: self.normal(triangle), triangle, receives }))
    }

    /// What stands in the light first along a ray from it: the distance and the triangle.
    pub fn first_caster(&self, ray: &Ray) -> Option<(f64, u32)> {
        match &self.casters {
            Some((tree, numbers)) => tree.nearest(ray).map(|(t, n)| (t, numbers[n as usize])),
            None => self.all.nearest(ray),
        }
    }

    /// Whether anything stands in the light along a ray.
    pub fn is_blocked(&self, ray: &Ray) -> bool {
        self.casters.as_ref().map_or(&self.all, |c| &c.0).meets(ray)
    }

    /// Whether the body of a triangle stands in the light.
    pub fn casts(&self, triangle: u32) -> bool {
        self.casts[self.owners[triangle as usize] as usize]
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.corners[triangle as usize]
    }

    /// The unit normal of a triangle; zero if it has no area.
    pub fn normal(&self, triangle: u32) -> DVec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a).normalize_or_zero()
    }

    /// The boxes around the bodies, by their corners: the bits of a corner's number tell its end along each axis.
    pub fn boxes(&self) -> &[[DVec3; 8]] {
        &self.boxes
    }

    /// A ball around the boxes around the bodies: the middle of all their corners' bounds, and the distance of the
    /// farthest corner. This is what a parallel light covers that fits the scene. A world of nothing has the unit ball.
    pub fn ball(&self) -> (DVec3, f64) {
        let all = || self.boxes.iter().flatten().copied();
        let Some(low) = all().reduce(DVec3::min) else { return (DVec3::ZERO, 1.0) };
        let center = (low + all().fold(low, DVec3::max)) / 2.0;
        (center, all().map(|c| c.distance(center)).fold(0.0, f64::max))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Shape;
    use glam::Vec3;

    fn ray(origin: [f64; 3], direction: [f64; 3]) -> Ray {
        Ray { origin: origin.into(), direction: direction.into(), near: 0.0, far: f64::INFINITY }
    }

    #[test]
    fn what_does_not_cast_is_seen_but_does_not_stand_in_the_light() {
        let plane = Shape::Plane { size: [2.0, 2.0], segments: [1, 1] }.mesh().expect("a plane");
        let at = |y: f32, casts: bool| Body {
            mesh: &plane,
            object_to_world: Mat4::from_translation(Vec3::Y * y),
            casts,
            receives: casts,
        };
        let world = World::new(&[at(0.0, true), at(1.0, false), at(2.0, false)]);
        let down = ray([0.3, 5.0, 0.2], [0.0, -1.0, 0.0]);
        let (distance, point) = world.seen(&down).expect("a plane");
        assert_eq!((distance, point.receives, point.normal), (3.0, false, DVec3::Y));
        let (distance, triangle) = world.first_caster(&down).expect("the lowest");
        assert_eq!((distance, world.casts(triangle)), (5.0, true));
        assert!(world.normal(triangle).abs_diff_eq(DVec3::Y, 1e-15));
        assert!(!world.is_blocked(&Ray { far: 4.9, ..down }) && world.is_blocked(&Ray { far: 5.1, ..down }));
        assert_eq!(world.ball(), (DVec3::Y, 3_f64.sqrt()));
        assert_eq!(World::new(&[]).ball(), (DVec3::ZERO, 1.0));
    }

    #[test]
    fn bodies_stand_where_their_transforms_say() {
        let ball = Shape::Sphere { radius: 1.0, segments: 64 }.mesh().expect("a ball");
        let place = Mat4::from_translation(Vec3::new(3.0, 0.0, 0.0)) * Mat4::from_scale(Vec3::splat(0.5));
        let world = World::new(&[Body { mesh: &ball, object_to_world: place, casts: true, receives: true }]);
        let (distance, point) = world.seen(&ray([3.0, 0.1, 9.0], [0.0, 0.0, -2.0])).expect("the ball");
        // A ball of 64 segments lies within 1 - cos(pi / 32) of the true one.
        let truth = (9.0 - (0.25_f64 - 0.01).sqrt()) / 2.0;
        assert!((distance - truth).abs() < 0.005, "{distance} {truth}");
        assert!(point.normal.z > 0.9 && (point.normal.length() - 1.0).abs() < 1e-12);
        assert_eq!(world.seen(&ray([0.0, 0.0, 9.0], [0.0, 0.0, -1.0])), None);
    }
}
