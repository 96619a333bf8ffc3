//! label: Maximum
//! category: math
//! synonyms: max, greater, larger, lightest, union, math
//! inline
//! commutative
//! generic T: f32 | vec2f | vec3f | vec4f
//! The greater of two values, component by component.

alias T = f32;

/// a (number): First value.
/// b (number; = 0): Second value.
/// -> maximum (number): The greater one.
fn maximum(a: T, b: T) -> T {
    return max(a, b);
}
