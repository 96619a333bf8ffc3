//! label: Matrix Transpose
//! category: math
//! synonyms: transpose, flip matrix, inverse rotation, mat4
//! inline
//! A matrix with rows and columns exchanged; for a pure rotation, its inverse.

/// transform (matrix): The matrix.
/// -> transposed (matrix): Its transpose.
fn matrix_transpose(transform: mat4x4f) -> mat4x4f {
    return transpose(transform);
}
