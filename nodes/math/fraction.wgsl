//! label: Fraction
//! category: math
//! synonyms: fract, frac, fractional part, repeat, sawtooth, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! What a value is above its floor: a sawtooth from 0 to 1.

alias T = f32;

/// x (number): The value.
/// -> fraction (number): x - floor(x).
fn fraction(x: T) -> T {
    return fract(x);
}
