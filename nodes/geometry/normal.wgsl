//! label: Normal
//! category: geometry
//! synonyms: shading normal, vertex normal, smooth normal, world normal, surface direction, geometry
//! use: frames, unit_vectors
//! inline
//! The interpolated surface normal, made unit length.
//! option frame: world | object | view = world - The frame that the normal is given in.

//#if frame == object
/// interpolated (normal object near; = @normal_object; hidden): The vertex normals, interpolated.
/// -> normal (normal object unit): The shading normal in object space.
//#elif frame == view
/// interpolated (normal world near; = @normal_world; hidden): The vertex normals, interpolated.
/// world_to_view (matrix; = @world_to_view; hidden): The camera's matrix.
/// -> normal (normal view unit): The shading normal as the camera sees it.
//#else
/// interpolated (normal world near; = @normal_world; hidden): The vertex normals, interpolated.
/// -> normal (normal world unit): The shading normal in world space.
//#end
//#if frame == view
fn normal(interpolated: vec3f, world_to_view: mat4x4f) -> vec3f {
    return unit_or_zero(vector_through(world_to_view, interpolated));
}
//#else
fn normal(interpolated: vec3f) -> vec3f {
    return unit_or_zero(interpolated);
}
//#end
