//! label: Vector 2
//! category: math
//! synonyms: vec2, xy, constant vector, two numbers, float2
//! inline
//! Two numbers to set by hand.

/// vector (number; = (0, 0)): The numbers.
/// -> vector (number): The same numbers.
fn vector2(vector: vec2f) -> vec2f {
    return vector;
}
