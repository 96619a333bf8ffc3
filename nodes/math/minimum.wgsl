//! label: Minimum
//! category: math
//! synonyms: min, smaller, lesser, darkest, intersection, math
//! inline
//! commutative
//! generic T: f32 | vec2f | vec3f | vec4f
//! The smaller of two values, component by component.

alias T = f32;

/// a (number): First value.
/// b (number; = 1): Second value.
/// -> minimum (number): The smaller one.
fn minimum(a: T, b: T) -> T {
    return min(a, b);
}
