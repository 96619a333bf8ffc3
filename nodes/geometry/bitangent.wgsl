//! label: Bitangent
//! category: geometry
//! synonyms: binormal, surface bitangent, cotangent, uv direction, geometry
//! use: frames, unit_vectors
//! inline
//! The direction along the surface in which the second texture coordinate grows, made unit length.
//! option frame: world | object | view = world - The frame that the bitangent is given in.

/// interpolated (direction world near; = @bitangent_world; hidden): The bitangent, from normal and tangent.
//#if frame == object
/// world_to_object (matrix; = @world_to_object; hidden): The inverse of the object's matrix.
/// -> bitangent (direction object unit): The bitangent in object space.
//#elif frame == view
/// world_to_view (matrix; = @world_to_view; hidden): The camera's matrix.
/// -> bitangent (direction view unit): The bitangent as the camera sees it.
//#else
/// -> bitangent (direction world unit): The bitangent in world space.
//#end
//#if frame == object
fn bitangent(interpolated: vec3f, world_to_object: mat4x4f) -> vec3f {
    return unit_or_zero(vector_through(world_to_object, interpolated));
}
//#elif frame == view
fn bitangent(interpolated: vec3f, world_to_view: mat4x4f) -> vec3f {
    return unit_or_zero(vector_through(world_to_view, interpolated));
}
//#else
fn bitangent(interpolated: vec3f) -> vec3f {
    return unit_or_zero(interpolated);
}
//#end
