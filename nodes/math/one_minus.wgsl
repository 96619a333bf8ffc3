//! label: One Minus
//! category: math
//! synonyms: complement, invert, inverse, 1-x, flip mask, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! What is missing to one: turns a mask over.

alias T = f32;

/// x (number): The value.
/// -> complement (number): 1 - x.
fn one_minus(x: T) -> T {
    return T(1.0) - x;
}
