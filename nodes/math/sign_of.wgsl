//! label: Sign
//! category: math
//! synonyms: signum, sign, direction, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! The sign of a value: -1, 0 or 1.

alias T = f32;

/// x (number): The value.
/// -> sign (number): -1 below zero, 0 at zero, 1 above.
fn sign_of(x: T) -> T {
    return sign(x);
}
