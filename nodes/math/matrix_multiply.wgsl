//! label: Matrix Multiply
//! category: math
//! synonyms: matrix product, combine transforms, concatenate, mat4
//! inline
//! The product of two matrices: a transform that does the second one first.

/// a (matrix): The matrix on the left.
/// b (matrix): The matrix on the right.
/// -> product (matrix): a times b.
fn matrix_multiply(a: mat4x4f, b: mat4x4f) -> mat4x4f {
    return a * b;
}
