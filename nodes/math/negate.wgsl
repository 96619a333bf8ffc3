//! label: Negate
//! category: math
//! synonyms: negative, minus, opposite, flip sign, reverse direction, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! A value with the opposite sign.

alias T = f32;

/// x (number): The value.
/// -> negated (number): -x.
fn negate(x: T) -> T {
    return -x;
}
