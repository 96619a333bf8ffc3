//! Geometry, camera, objects and lights in space.
//!
//! A scene is data: [`Shape::mesh`] and [`from_obj`] make triangles of it, [`environment::Map`] makes a picture of its
//! surroundings, [`Bounds`] and [`Ball`] say how far it reaches. Files are read by the caller.

mod assemble;
mod bounds;
mod camera;
#[cfg(test)]
mod checks;
mod document;
pub mod environment;
mod mesh;
mod obj;
mod primitive;
mod shape;
mod transform;

pub use bounds::{Ball, Bounds};
pub use camera::Camera;
pub use document::{CameraSettings, FileReference, LightInstance, Object, Scene, Setting, Settings};
pub use environment::Environment;
pub use mesh::Mesh;
pub use obj::{MAX_OBJ_ELEMENTS, from_obj};
pub use shape::{MAX_SEGMENTS, MIN_SEGMENTS, Shape};
pub use transform::Transform;
