//! Triangles with everything a module may read per vertex. (interface)

use glam::{Vec2, Vec3, Vec4};

/// A triangle mesh in object space, metres, counter-clockwise seen from outside. All vertex lists have equal length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Positions.
    pub positions: Vec<Vec3>,
    /// Unit normals.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, v down.
    pub texcoords: Vec<Vec2>,
    /// Unit tangents along +u; w is the sign of the bitangent cross(normal, tangent) * w, which points along +v (down).
    pub tangents: Vec<Vec4>,
    /// Linear colours.
    pub colors: Vec<Vec4>,
    /// Three per triangle.
    pub indices: Vec<u32>,
}
