//! The camera in float64.

use glam::{DVec2, DVec3};

use crate::scene::Camera;

/// A camera and how wide its picture is.
pub(super) struct Eye {
    pub(super) position: DVec3,
    /// Unit vectors.
    pub(super) right: DVec3,
    pub(super) up: DVec3,
    pub(super) forward: DVec3,
    /// Half width and half height of what is seen at distance 1.
    pub(super) half: DVec2,
    /// Nearest and farthest visible distance along the axis.
    pub(super) range: (f64, f64),
}

impl Eye {
    /// The camera of a picture of these columns and rows.
    pub(super) fn new(camera: &Camera, (columns, rows): (u32, u32)) -> Self {
        let position = camera.position.as_dvec3();
        let forward = (camera.target.as_dvec3() - position).normalize_or(DVec3::NEG_Z);
        let right = forward.cross(camera.up.as_dvec3()).normalize_or(DVec3::X);
        let high = (f64::from(camera.fov_y) / 2.0).tan();
        Self {
            position,
            right,
            up: right.cross(forward),
            forward,
            half: DVec2::new(high * f64::from(columns.max(1)) / f64::from(rows.max(1)), high),
            range: (f64::from(camera.near), f64::from(camera.far)),
        }
    }

    /// The way to a place of the picture (-1 to 1, y up), as far as distance 1 along the axis.
    pub(super) fn towards(&self, place: DVec2) -> DVec3 {
        let across = place * self.half;
        self.forward + self.right * across.x + self.up * across.y
    }

    /// The world point at a place of the picture at a distance along the axis.
    pub(super) fn at(&self, place: DVec2, distance: f64) -> DVec3 {
        self.position + self.towards(place) * distance
    }

    /// How far a world point is to the right, up, and along the axis.
    pub(super) fn seen(&self, point: DVec3) -> DVec3 {
        let offset = point - self.position;
        DVec3::new(offset.dot(self.right), offset.dot(self.up), offset.dot(self.forward))
    }
}
