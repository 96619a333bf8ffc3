//! label: Absolute
//! category: math
//! synonyms: abs, magnitude, modulus, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! A value without its sign.

alias T = f32;

/// x (number): The value.
/// -> absolute (number): x where x is positive, else -x.
fn absolute(x: T) -> T {
    return abs(x);
}
