//! What an object is made of, before it becomes triangles.

use super::{FileReference, Mesh, primitive};

/// Smallest number of segments around a round shape.
pub const MIN_SEGMENTS: u32 = 3;
/// Largest number of segments along any side of a shape: bounds the memory that a scene can ask for.
pub const MAX_SEGMENTS: u32 = 1024;

/// A shape in object space, metres, centred on the origin, y up.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A rectangle in the plane y = 0 that faces +y; u along +x, v along +z.
    Plane {
        /// Extent along x and z.
        size: [f64; 2],
        /// Quads along x and z.
        segments: [u32; 2],
    },
    /// A box; each face has texture coordinates 0..1.
    Box {
        /// Extent along x, y and z.
        size: [f64; 3],
        /// Radius of its rounded edges; 0 for sharp ones. At most half of the shortest extent.
        bevel: f64,
    },
    /// A ball; u around the y axis, v from the north pole to the south pole.
    Sphere {
        /// Its radius.
        radius: f64,
        /// Quads around; half as many from pole to pole.
        segments: u32,
    },
    /// A cylinder around the y axis.
    Cylinder {
        /// Its radius.
        radius: f64,
        /// Extent along y.
        height: f64,
        /// Whether its ends are closed. An open one has no inside: its back faces are seen through the ends.
        capped: bool,
        /// Quads around.
        segments: u32,
    },
    /// A ring around the y axis.
    Torus {
        /// From the centre to the middle of the tube.
        major: f64,
        /// Radius of the tube; less than `major`.
        minor: f64,
        /// Quads around the ring; half as many around the tube.
        segments: u32,
    },
    /// A Wavefront OBJ file.
    Obj(FileReference),
}

impl Shape {
    /// Segments of a ball if the file does not say.
    pub const SPHERE_SEGMENTS: u32 = 64;
    /// Segments of a cylinder if the file does not say.
    pub const CYLINDER_SEGMENTS: u32 = 48;
    /// Segments of a ring if the file does not say.
    pub const TORUS_SEGMENTS: u32 = 64;

    /// The triangles; none for a file, whose text the caller reads and gives to [`super::from_obj`].
    ///
    /// Segment counts are taken within [`MIN_SEGMENTS`] and [`MAX_SEGMENTS`].
    pub fn mesh(&self) -> Option<Mesh> {
        let round = |n: u32| n.clamp(MIN_SEGMENTS, MAX_SEGMENTS);
        Some(match *self {
            Self::Plane { size, segments } => primitive::plane(size, segments.map(|n| n.clamp(1, MAX_SEGMENTS))),
            Self::Box { size, bevel } => primitive::cuboid(size, bevel),
            Self::Sphere { radius, segments } => primitive::sphere(radius, round(segments)),
            Self::Cylinder { radius, height, capped, segments } => {
                primitive::cylinder(radius, height, capped, round(segments))
            }
            Self::Torus { major, minor, segments } => primitive::torus(major, minor, round(segments)),
            Self::Obj(_) => return None,
        })
    }

    /// The name that scene files use.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Plane { .. } => "Plane",
            Self::Box { .. } => "Box",
            Self::Sphere { .. } => "Sphere",
            Self::Cylinder { .. } => "Cylinder",
            Self::Torus { .. } => "Torus",
            Self::Obj(_) => "Obj",
        }
    }
}
