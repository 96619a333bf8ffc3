//! label: Distance
//! category: math
//! synonyms: distance, length of difference, proximity, vector math
//! inline
//! commutative
//! generic T: f32 | vec2f | vec3f | vec4f
//! The distance between two points.

alias T = f32;

/// a (number): First point.
/// b (number; = 0): Second point.
/// -> distance (number): The length of their difference.
fn distance_between(a: T, b: T) -> f32 {
    return distance(a, b);
}
