//! label: To Camera
//! category: geometry
//! synonyms: view direction, view vector, incoming, eye direction, view dir, camera vector
//! use: frames, unit_vectors
//! inline
//! The unit direction from the shaded point to the eye.
//! option frame: world | object | view = world - The frame that the direction is given in.

/// towards_eye (direction world unit; = @to_camera; hidden): The direction in world space.
//#if frame == object
/// world_to_object (matrix; = @world_to_object; hidden): The inverse of the object's matrix.
/// -> direction (direction object unit): Towards the eye, in object space.
//#elif frame == view
/// world_to_view (matrix; = @world_to_view; hidden): The camera's matrix.
/// -> direction (direction view unit): Towards the eye, in view space.
//#else
/// -> direction (direction world unit): Towards the eye, in world space.
//#end
//#if frame == object
fn to_camera(towards_eye: vec3f, world_to_object: mat4x4f) -> vec3f {
    return unit_or_zero(vector_through(world_to_object, towards_eye));
}
//#elif frame == view
fn to_camera(towards_eye: vec3f, world_to_view: mat4x4f) -> vec3f {
    return vector_through(world_to_view, towards_eye);
}
//#else
fn to_camera(towards_eye: vec3f) -> vec3f {
    return towards_eye;
}
//#end
