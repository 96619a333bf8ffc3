//! label: Length
//! category: math
//! synonyms: length, magnitude, norm, vector length, vector math
//! inline
//! generic T: vec2f | vec3f | vec4f
//! The length of a vector.

alias T = vec2f;

/// vector (number): The vector.
/// -> length (number): The square root of the sum of its squared components.
fn vector_length(vector: T) -> f32 {
    return length(vector);
}
