//! label: Transform Point
//! category: geometry
//! synonyms: vector transform, convert space, object to world, world to local, mapping, transform position
//! use: frames
//! inline
//! Takes a point from one frame to another.
//! option route: object_to_world | world_to_object | world_to_view | view_to_world | object_to_view | view_to_object = object_to_world - From which frame to which.

//#if route == object_to_world | object_to_view
/// point (point object; = @position_object): The point in object space.
//#elif route == world_to_object | world_to_view
/// point (point world; = @position_world): The point in world space.
//#else
/// point (point view): The point in view space.
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
/// -> transformed (point world): The point in world space.
//#elif route == world_to_object | view_to_object
/// -> transformed (point object): The point in object space.
//#else
/// -> transformed (point view): The point in view space.
//#end
fn transform_point(
    point: vec3f,
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
    return point_through(object_to_world, point);
//#elif route == world_to_object
    return point_through(world_to_object, point);
//#elif route == world_to_view
    return point_through(world_to_view, point);
//#elif route == view_to_world
    return point_from_view(world_to_view, point);
//#elif route == object_to_view
    return point_through(world_to_view, point_through(object_to_world, point));
//#else
    return point_through(world_to_object, point_from_view(world_to_view, point));
//#end
}
