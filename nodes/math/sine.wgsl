//! label: Sine
//! category: math
//! synonyms: sin, wave, oscillate, trigonometry, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! The sine of an angle in radians.

alias T = f32;

/// x (number): The angle, in radians.
/// -> sine (number): From -1 to 1.
fn sine(x: T) -> T {
    return sin(x);
}
