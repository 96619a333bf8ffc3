//! Geometry, camera, objects and lights in space.

mod camera;
mod mesh;

pub use camera::Camera;
pub use mesh::Mesh;
