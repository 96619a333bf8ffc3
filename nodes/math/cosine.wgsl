//! label: Cosine
//! category: math
//! synonyms: cos, wave, oscillate, trigonometry, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! The cosine of an angle in radians.

alias T = f32;

/// x (number): The angle, in radians.
/// -> cosine (number): From -1 to 1.
fn cosine(x: T) -> T {
    return cos(x);
}
