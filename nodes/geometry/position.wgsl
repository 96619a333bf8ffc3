//! label: Position
//! category: geometry
//! synonyms: point, world position, local position, fragment position, geometry, object coordinates, vertex
//! use: frames
//! inline
//! Where the shaded point lies, in the frame of your choice.
//! option frame: world | object | view = world - The frame that the position is given in.

//#if frame == object
/// point (point object; = @position_object; hidden): The shaded point in object space.
/// -> position (point object): The shaded point in object space: it sticks to the object when that moves.
//#elif frame == view
/// point (point world; = @position_world; hidden): The shaded point in world space.
/// world_to_view (matrix; = @world_to_view; hidden): The camera's matrix.
/// -> position (point view): The shaded point seen from the camera at the origin.
//#else
/// point (point world; = @position_world; hidden): The shaded point in world space.
/// -> position (point world): The shaded point in world space.
//#end
//#if frame == view
fn position(point: vec3f, world_to_view: mat4x4f) -> vec3f {
    return point_through(world_to_view, point);
}
//#else
fn position(point: vec3f) -> vec3f {
    return point;
}
//#end
