//! label: Transform Normal
//! category: geometry
//! synonyms: vector transform, convert space, normal matrix, inverse transpose, object to world normal
//! use: frames, unit_vectors
//! inline
//! Takes a normal from one frame to another, so that it stays upright on objects that are stretched.
//! Normals go by the transposed inverse of the matrix that points go by; between world and view, where the matrix is a
//! rotation, that is the same.
//! option route: object_to_world | world_to_object | world_to_view | view_to_world | object_to_view | view_to_object = object_to_world - From which frame to which.

//#if route == object_to_world | object_to_view
/// normal (normal object; = @normal_object): The normal in object space.
//#elif route == world_to_object | world_to_view
/// normal (normal world; = @normal_world): The normal in world space.
//#else
/// normal (normal view): The normal in view space.
//#end
//#if route == object_to_world | object_to_view
/// world_to_object (matrix; = @world_to_object; hidden): The inverse of the object's matrix.
//#elif route == world_to_object | view_to_object
/// object_to_world (matrix; = @object_to_world; hidden): The object's matrix.
//#end
//#if route == world_to_view | view_to_world | object_to_view | view_to_object
/// world_to_view (matrix; = @world_to_view; hidden): The camera's matrix.
//#end
//#if route == object_to_world | view_to_world
/// -> transformed (normal world unit): The normal in world space.
//#elif route == world_to_object | view_to_object
/// -> transformed (normal object unit): The normal in object space.
//#else
/// -> transformed (normal view unit): The normal in view space.
//#end
fn transform_normal(
    normal: vec3f,
//#if route == object_to_world | object_to_view
    world_to_object: mat4x4f,
//#elif route == world_to_object | view_to_object
    object_to_world: mat4x4f,
//#end
//#if route == world_to_view | view_to_world | object_to_view | view_to_object
    world_to_view: mat4x4f,
//#end
) -> vec3f {
//#if route == object_to_world
    return unit_or_zero(vector_through_transposed(world_to_object, normal));
//#elif route == world_to_object
    return unit_or_zero(vector_through_transposed(object_to_world, normal));
//#elif route == world_to_view
    return unit_or_zero(vector_through(world_to_view, normal));
//#elif route == view_to_world
    return unit_or_zero(vector_through_transposed(world_to_view, normal));
//#elif route == object_to_view
    return unit_or_zero(vector_through(world_to_view, vector_through_transposed(world_to_object, normal)));
//#else
    return unit_or_zero(vector_through_transposed(object_to_world, vector_through_transposed(world_to_view, normal)));
//#end
}
