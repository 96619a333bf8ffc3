//! label: Matrix Times Vector
//! category: math
//! synonyms: transform, multiply vector, apply matrix, mat4, projection
//! A vector through a matrix.
//! option vector_is: point | direction | column = point - A point (w is 1; divided by the w that comes out), a direction (w is 0), or all four components.

/// transform (matrix): The matrix.
/// vector (number): The vector, a column to the right of the matrix.
/// -> transformed (number): The matrix times the vector.
//#if vector_is == point
fn matrix_vector(transform: mat4x4f, vector: vec3f) -> vec3f {
    let column = transform * vec4f(vector, 1.0);
    return column.xyz / select(column.w, 1.0, column.w == 0.0);
}
//#elif vector_is == direction
fn matrix_vector(transform: mat4x4f, vector: vec3f) -> vec3f {
    return (transform * vec4f(vector, 0.0)).xyz;
}
//#else
fn matrix_vector(transform: mat4x4f, vector: vec4f) -> vec4f {
    return transform * vector;
}
//#end
