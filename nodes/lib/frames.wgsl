//! Ways between object, world and view space; the camera's matrix is taken to be a rotation and a translation.

/// A point through a matrix without a projective part.
fn point_through(transform: mat4x4f, p: vec3f) -> vec3f {
    return (transform * vec4f(p, 1.0)).xyz;
}

/// A displacement through a matrix: the translation does not move it.
fn vector_through(transform: mat4x4f, v: vec3f) -> vec3f {
    return (transform * vec4f(v, 0.0)).xyz;
}

/// A displacement through the transposed matrix, which takes normals the way that is opposite to the matrix, and
/// undoes a rotation.
fn vector_through_transposed(transform: mat4x4f, v: vec3f) -> vec3f {
    return (vec4f(v, 0.0) * transform).xyz;
}

/// A point from view to world space.
fn point_from_view(world_to_view: mat4x4f, p: vec3f) -> vec3f {
    return vector_through_transposed(world_to_view, p - world_to_view[3].xyz);
}
