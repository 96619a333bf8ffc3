//! Where an object stands.

use glam::{DMat4, DQuat, DVec3, EulerRot, Mat4};

/// Scale, then rotation, then translation, in this order, from object to world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// Metres.
    pub translate: [f64; 3],
    /// Degrees about x, y and z. The rotation about x is applied first, then y, then z, all about the fixed world
    /// axes; the matrix is Rz * Ry * Rx. Positive turns counter-clockwise seen from the axis's tip.
    pub rotate: [f64; 3],
    /// Factors along the object's own axes, greater than 0.
    pub scale: [f64; 3],
}

impl Default for Transform {
    fn default() -> Self {
        Self { translate: [0.0; 3], rotate: [0.0; 3], scale: [1.0; 3] }
    }
}

impl Transform {
    /// Object to world space.
    pub fn matrix(&self) -> Mat4 {
        let [x, y, z] = self.rotate.map(f64::to_radians);
        // Fixed axes x, y, z are moving axes z, y, x.
        let rotation = DQuat::from_euler(EulerRot::ZYX, z, y, x);
        let (scale, translate) = (DVec3::from_array(self.scale), DVec3::from_array(self.translate));
        DMat4::from_scale_rotation_translation(scale, rotation, translate).as_mat4()
    }
}
