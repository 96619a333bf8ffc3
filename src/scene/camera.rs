//! Where the picture is taken from. (interface)

use glam::{Mat4, Vec3};

/// A pinhole camera in world space, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Eye.
    pub position: Vec3,
    /// What it looks at.
    pub target: Vec3,
    /// Which way is up.
    pub up: Vec3,
    /// Vertical field of view, radians.
    pub fov_y: f32,
    /// Nearest visible distance.
    pub near: f32,
    /// Farthest visible distance.
    pub far: f32,
}

impl Camera {
    /// World to view space; the camera looks along -z.
    pub fn world_to_view(&self) -> Mat4 {
        glam::camera::rh::view::look_at_mat4(self.position, self.target, self.up)
    }
}
