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
mod read;
mod read_parts;
mod shape;
mod transform;
mod write;

#[cfg(test)]
mod tests;

pub use bounds::{Ball, Bounds};
pub use camera::Camera;
pub use document::{CameraSettings, FileReference, LightInstance, Object, Scene, Setting, Settings, Unknown};
pub use environment::Environment;
pub use mesh::Mesh;
pub use obj::{MAX_OBJ_ELEMENTS, from_obj};
pub use read::read;
pub use shape::{MAX_SEGMENTS, MIN_SEGMENTS, Shape};
pub use transform::Transform;
pub use write::write;

/// The version of the file format that is written.
pub const VERSION: u32 = 1;
/// Most objects, and most lights, of a scene.
pub const MAX_ITEMS: usize = 20_000;

/// What each code of this module means, for `shadetree explain`.
pub const CODES: &[(&str, &str)] = &[
    ("ST0400", "The file does not hold a `Scene(...)`."),
    ("ST0401", "The scene does not say `version: 1`, or says something that is not a version."),
    ("ST0402", "The scene was written by a newer version of shadetree."),
    ("ST0403", "The scene has no camera, so there is nowhere to see it from."),
    ("ST0404", "A number of the scene is outside the range that makes sense there."),
    ("ST0405", "The camera cannot see: it looks at its own place, or straight along its up direction."),
    ("ST0406", "The far distance of the camera is not greater than the near distance."),
    ("ST0407", "An object has no size: an extent, radius or scale is 0 or less."),
    ("ST0408", "The shape or environment is not one that is known."),
    ("ST0409", "A shape or environment has a field that it does not have here."),
    ("ST0410", "The scene has no objects, so its picture shows the environment alone."),
    ("ST0411", "A light or an object has an empty name or path."),
    ("ST0412", "A scene sets a value by something that is not `node.port`."),
    ("ST0413", "A value in `set` is neither a truth value, nor numbers, nor a text."),
    ("ST0414", "The scene has more lights or objects than are handled."),
    ("ST0415", "The scene has too many mistakes to list them all."),
    ("ST0420", "A line of an OBJ file lacks numbers, or holds something that is not a finite number."),
    ("ST0421", "A face of an OBJ file refers to a position, texture coordinate or normal that does not exist."),
    ("ST0422", "A face of an OBJ file has fewer than 3 or more than 1024 corners."),
    ("ST0423", "The OBJ file is larger than is handled."),
    ("ST0424", "The OBJ file has no face with an area."),
    ("ST0425", "The environment picture cannot be read."),
];
