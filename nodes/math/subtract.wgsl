//! label: Subtract
//! category: math
//! synonyms: minus, difference, -, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! The difference of two values.

alias T = f32;

/// a (number): What is taken from.
/// b (number; = 0): What is taken away.
/// -> difference (number): a - b.
fn subtract(a: T, b: T) -> T {
    return a - b;
}
