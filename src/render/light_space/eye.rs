//! The camera as the views of lights need it.

use glam::Vec3;

use crate::scene::Camera;

/// Where the scene is seen from, and how wide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// Its place.
    pub position: Vec3,
    /// Unit vector of the viewing axis.
    pub forward: Vec3,
    /// Unit vector to the right of the picture.
    pub right: Vec3,
    /// Unit vector to the top of the picture.
    pub up: Vec3,
    /// Half width and half height of what is seen at distance 1.
    pub half: (f32, f32),
    /// Nearest and farthest visible distance along the axis.
    pub range: (f32, f32),
}

impl Eye {
    /// The eye of a camera whose picture has these columns and rows.
    pub fn new(camera: &Camera, (columns, rows): (u32, u32)) -> Self {
        let forward = (camera.target - camera.position).normalize_or(Vec3::NEG_Z);
        let right = forward.cross(camera.up).normalize_or(Vec3::X);
        let half_height = (camera.fov_y / 2.0).tan();
        #[allow(clippy::cast_precision_loss, reason = "pictures have far fewer than 2^24 columns")]
        let aspect = columns.max(1) as f32 / rows.max(1) as f32;
        Self {
            position: camera.position,
            forward,
            right,
            up: right.cross(forward),
            half: (half_height * aspect, half_height),
            range: (camera.near, camera.far),
        }
    }

    /// The corners of what is seen between two distances along the axis: four near ones, four far ones.
    pub(super) fn corners(&self, near: f32, far: f32) -> [Vec3; 8] {
        std::array::from_fn(|i| {
            let sign = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
            let distance = if i < 4 { near } else { far };
            let across = self.right * (sign(0) * self.half.0) + self.up * (sign(1) * self.half.1);
            self.position + (self.forward + across) * distance
        })
    }

    /// Distance along the axis.
    pub(super) fn depth(&self, point: Vec3) -> f32 {
        (point - self.position).dot(self.forward)
    }
}
