//! label: Add
//! category: math
//! synonyms: plus, sum, +, offset, math
//! inline
//! commutative
//! generic T: f32 | vec2f | vec3f | vec4f
//! The sum of two values.

alias T = f32;

/// a (number): First term.
/// b (number; = 0): Second term.
/// -> sum (number): a + b.
fn add(a: T, b: T) -> T {
    return a + b;
}
