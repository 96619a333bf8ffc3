//! label: Transform Direction
//! category: geometry
//! synonyms: vector transform, convert space, rotate vector, object to world, world to local
//! use: frames, unit_vectors
//! inline
//! Takes a direction from one frame to another and makes it unit length again.
//! For normals use Transform Normal: on an object that is stretched they go another way.
//! option route: object_to_world | world_to_object | world_to_view | view_to_world | object_to_view | view_to_object = object_to_world - From which frame to which.

//#if route == object_to_world | object_to_view
/// direction (direction object): The direction in object space.
//#elif route == world_to_object | world_to_view
/// direction (direction world): The direction in world space.
//#else
/// direction (direction view): The direction in view space.
//#end
//#if route == object_to_world | object_to_view
/// object_to_world (matrix; = @object_to_world; hidden): The object's matrix.
//#elif route == world_to_object | view_to_object
/// world_to_object (matrix; = @world_to_object; hidden): The inverse of the object's matrix.
//#end
//#if route == world_to_view | view_to_world | object_to_view | view_to_object
/// world_to_view (matrix; = @world_to_view; hidden): The camera's matrix.
//#end
//#if route == object_to_world | view_to_world
/// -> transformed (direction world unit): The direction in world space.
//#elif route == world_to_object | view_to_object
/// -> transformed (direction object unit): The direction in object space.
//#else
/// -> transformed (direction view unit): The direction in view space.
//#end
fn transform_direction(
    direction: vec3f,
//#if route == object_to_world | object_to_view
    object_to_world: mat4x4f,
//#elif route == world_to_object | view_to_object
    world_to_object: mat4x4f,
//#end
//#if route == world_to_view | view_to_world | object_to_view | view_to_object
    world_to_view: mat4x4f,
//#end
) -> vec3f {
//#if route == object_to_world
    return unit_or_zero(vector_through(object_to_world, direction));
//#elif route == world_to_object
    return unit_or_zero(vector_through(world_to_object, direction));
//#elif route == world_to_view
    return unit_or_zero(vector_through(world_to_view, direction));
//#elif route == view_to_world
    return unit_or_zero(vector_through_transposed(world_to_view, direction));
//#elif route == object_to_view
    return unit_or_zero(vector_through(world_to_view, vector_through(object_to_world, direction)));
//#else
    return unit_or_zero(vector_through(world_to_object, vector_through_transposed(world_to_view, direction)));
//#end
}
