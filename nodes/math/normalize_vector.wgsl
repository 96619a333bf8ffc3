//! label: Normalize
//! category: math
//! synonyms: normalize, unit vector, direction, vector math
//! generic T: vec2f | vec3f | vec4f
//! A vector made unit length; a zero vector stays zero.

alias T = vec2f;

/// vector (number): The vector.
/// -> unit (number): The same direction, length one.
fn normalize_vector(vector: T) -> T {
    return vector * inverseSqrt(max(dot(vector, vector), 1e-36));
}
