//! label: Multiply Add
//! category: math
//! synonyms: mad, fma, scale and offset, linear, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! A value times a factor plus a term.

alias T = f32;

/// x (number): The value.
/// factor (number; = 1): What it is multiplied by.
/// term (number; = 0): What is then added.
/// -> result (number): x * factor + term.
fn multiply_add(x: T, factor: T, term: T) -> T {
    return x * factor + term;
}
