//! label: Tangent
//! category: geometry
//! synonyms: surface tangent, vertex tangent, anisotropy direction, uv direction, geometry
//! use: frames, unit_vectors
//! inline
//! The direction along the surface in which the first texture coordinate grows, made unit length.
//! option frame: world | object | view = world - The frame that the tangent is given in.

//#if frame == object
/// interpolated (direction object near; = @tangent_object; hidden): The vertex tangents, interpolated.
/// -> tangent (direction object unit): The tangent in object space.
//#elif frame == view
/// interpolated (direction world near; = @tangent_world; hidden): The vertex tangents, interpolated.
/// world_to_view (matrix; = @world_to_view; hidden): The camera's matrix.
/// -> tangent (direction view unit): The tangent as the camera sees it.
//#else
/// interpolated (direction world near; = @tangent_world; hidden): The vertex tangents, interpolated.
/// -> tangent (direction world unit): The tangent in world space.
//#end
//#if frame == view
fn tangent(interpolated: vec3f, world_to_view: mat4x4f) -> vec3f {
    return unit_or_zero(vector_through(world_to_view, interpolated));
}
//#else
fn tangent(interpolated: vec3f) -> vec3f {
    return unit_or_zero(interpolated);
}
//#end
