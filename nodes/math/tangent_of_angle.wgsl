//! label: Tangent of Angle
//! category: math
//! synonyms: tan, slope, trigonometry, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! The tangent of an angle in radians: the slope of a line at that angle.

alias T = f32;

/// x (number): The angle, in radians.
/// -> tangent (number): Sine over cosine; without bound near a quarter turn.
fn tangent_of_angle(x: T) -> T {
    return tan(x);
}
