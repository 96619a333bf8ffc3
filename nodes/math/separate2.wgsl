//! label: Separate XY
//! category: math
//! synonyms: split, break vector, vec2, decompose, unpack, components
//! The two components of a vector.

/// Components of a vector of two.
struct Components2 {
    x: f32,
    y: f32,
}

/// vector (number): The vector.
/// -> x (number): First component.
/// -> y (number): Second component.
fn separate2(vector: vec2f) -> Components2 {
    return Components2(vector.x, vector.y);
}
