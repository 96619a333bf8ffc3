//! label: Vector 4
//! category: math
//! synonyms: vec4, xyzw, constant vector, four numbers, float4
//! inline
//! Four numbers to set by hand.

/// vector (number; = (0, 0, 0, 0)): The numbers.
/// -> vector (number): The same numbers.
fn vector4(vector: vec4f) -> vec4f {
    return vector;
}
