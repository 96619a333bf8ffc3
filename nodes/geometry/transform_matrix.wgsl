//! label: Transform Matrix
//! category: geometry
//! synonyms: object matrix, model matrix, view matrix, world matrix, projection
//! inline
//! One of the matrices between the frames of the scene, for the matrix nodes.
//! option which: object_to_world | world_to_object | world_to_view | world_to_clip = object_to_world - From which frame to which.

//#if which == object_to_world
/// transform (matrix; = @object_to_world; hidden): Object to world.
/// -> matrix (matrix): Takes columns in object space to world space.
//#elif which == world_to_object
/// transform (matrix; = @world_to_object; hidden): World to object.
/// -> matrix (matrix): Takes columns in world space to object space.
//#elif which == world_to_view
/// transform (matrix; = @world_to_view; hidden): World to view.
/// -> matrix (matrix): Takes columns in world space to view space.
//#else
/// transform (matrix; = @world_to_clip; hidden): World to clip.
/// -> matrix (matrix): Takes columns in world space to clip space, before the division by w.
//#end
fn transform_matrix(transform: mat4x4f) -> mat4x4f {
    return transform;
}
