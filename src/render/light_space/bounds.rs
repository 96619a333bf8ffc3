//! How far a scene reaches, as seen from a light.

use glam::{Mat4, Vec3, Vec4};

use super::Eye;

/// Boxes around the objects of a scene, as their corners in world space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bounds {
    pub(super) corners: Vec<[Vec3; 8]>,
}

impl Bounds {
    /// Adds the box around `positions` (object space), placed by `object_to_world`.
    pub fn add(&mut self, positions: &[Vec3], object_to_world: Mat4) {
        let finite = || positions.iter().copied().filter(|p| p.is_finite());
        let Some(low) = finite().reduce(Vec3::min) else {
            return;
        };
        let high = finite().fold(low, Vec3::max);
        let corners: [Vec3; 8] = std::array::from_fn(|i| {
            let pick = |axis: usize| {
                if i >> axis & 1 == 1 { high[axis] } else { low[axis] }
            };
            object_to_world.transform_point3(Vec3::new(pick(0), pick(1), pick(2)))
        });
        if corners.iter().all(|c| c.is_finite()) {
            self.corners.push(corners);
        }
    }

    /// A ball around everything: centre and radius. A scene without anything has the unit ball.
    pub fn ball(&self) -> (Vec3, f32) {
        let all = || self.corners.iter().flatten().copied();
        let Some(low) = all().reduce(Vec3::min) else {
            return (Vec3::ZERO, 1.0);
        };
        let center = (low + all().fold(low, Vec3::max)) * 0.5;
        (center, all().map(|c| c.distance(center)).fold(0.0, f32::max))
    }

    /// Least and greatest z, in a frame, of what lies in the column |x|, |y| <= `radius` of that frame. Both are 0 where
    /// the column is empty.
    pub(super) fn depth_in_column(&self, world_to_frame: Mat4, radius: f32) -> (f32, f32) {
        let sides = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y].map(|side| side.extend(radius));
        range(self.boxes(|c| world_to_frame.transform_point3(c)).flat_map(|corners| clipped(&corners, &sides)))
            .unwrap_or_default()
    }

    /// Least and greatest distance along the eye's axis of the boxes' parts that it sees. None where it sees nothing.
    pub(super) fn seen(&self, eye: &Eye) -> Option<(f32, f32)> {
        let (half_width, half_height) = eye.half;
        let sides = [
            Vec4::new(-1.0, 0.0, half_width, 0.0),
            Vec4::new(1.0, 0.0, half_width, 0.0),
            Vec4::new(0.0, -1.0, half_height, 0.0),
            Vec4::new(0.0, 1.0, half_height, 0.0),
            Vec4::new(0.0, 0.0, 1.0, -eye.range.0),
            Vec4::new(0.0, 0.0, -1.0, eye.range.1),
        ];
        let boxes = self.boxes(|c| {
            let offset = c - eye.position;
            Vec3::new(offset.dot(eye.right), offset.dot(eye.up), offset.dot(eye.forward))
        });
        range(boxes.flat_map(|corners| {
            // What is in a box around the eye may lie anywhere in it.
            let nearest = around_origin(&corners).then_some(eye.range.0);
            clipped(&corners, &sides).into_iter().chain(nearest)
        }))
    }

    /// The corners of each box in another frame.
    fn boxes(&self, to_frame: impl Fn(Vec3) -> Vec3) -> impl Iterator<Item = [Vec3; 8]> {
        self.corners.iter().map(move |corners| corners.map(&to_frame))
    }
}

/// Least and greatest of some numbers.
fn range(numbers: impl Iterator<Item = f32>) -> Option<(f32, f32)> {
    numbers.map(|z| (z, z)).reduce(|(low, high), (z, _)| (low.min(z), high.max(z)))
}

/// The z of the corners of what `sides` leave of a box's faces.
fn clipped(corners: &[Vec3; 8], sides: &[Vec4]) -> Vec<f32> {
    FACES.iter().flat_map(|face| clip(face.iter().map(|i| corners[*i]).collect(), sides)).map(|p| p.z).collect()
}

/// Whether a box holds the origin.
fn around_origin(corners: &[Vec3; 8]) -> bool {
    let origin = corners[0];
    [1, 2, 4].iter().all(|i| {
        let edge = corners[*i] - origin;
        let along = -origin.dot(edge);
        along > 0.0 && along < edge.length_squared()
    })
}

/// The faces of a box by the numbers of their corners, around each face.
const FACES: [[usize; 4]; 6] = [[0, 2, 6, 4], [1, 3, 7, 5], [0, 1, 5, 4], [2, 3, 7, 6], [0, 1, 3, 2], [4, 5, 7, 6]];

/// The part of a convex polygon where (x, y, z, 1) times each of `sides` is not negative (Sutherland and Hodgman 1974).
fn clip(mut polygon: Vec<Vec3>, sides: &[Vec4]) -> Vec<Vec3> {
    for side in sides {
        let inside = |p: Vec3| p.extend(1.0).dot(*side);
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (i, &from) in polygon.iter().enumerate() {
            let to = polygon[(i + 1) % polygon.len()];
            let (a, b) = (inside(from), inside(to));
            if a >= 0.0 {
                kept.push(from);
            }
            if (a >= 0.0) != (b >= 0.0) {
                kept.push(from.lerp(to, a / (a - b)));
            }
        }
        polygon = kept;
    }
    polygon
}
