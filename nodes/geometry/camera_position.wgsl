//! label: Camera Position
//! category: geometry
//! synonyms: eye position, camera location, viewer, view position, eye point
//! use: frames
//! inline
//! Where the eye is.
//! option frame: world | object = world - The frame that the position is given in.

/// eye (point world; = @camera_position; hidden): The eye in world space.
//#if frame == object
/// world_to_object (matrix; = @world_to_object; hidden): The inverse of the object's matrix.
/// -> position (point object): The eye in the shaded object's space.
fn camera_position(eye: vec3f, world_to_object: mat4x4f) -> vec3f {
    return point_through(world_to_object, eye);
}
//#else
/// -> position (point world): The eye in world space.
fn camera_position(eye: vec3f) -> vec3f {
    return eye;
}
//#end
