//! label: Multiply
//! category: math
//! synonyms: times, product, *, scale, math
//! inline
//! commutative
//! generic T: f32 | vec2f | vec3f | vec4f
//! The product of two values, component by component.

alias T = f32;

/// a (number): First factor.
/// b (number; = 1): Second factor.
/// -> product (number): a * b.
fn multiply(a: T, b: T) -> T {
    return a * b;
}
