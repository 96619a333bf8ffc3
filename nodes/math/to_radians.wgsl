//! label: To Radians
//! category: math
//! synonyms: radians, degrees to radians, convert angle, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! Degrees as radians.

alias T = f32;

/// x (number): In degrees.
/// -> angle (number): In radians.
fn to_radians(x: T) -> T {
    return radians(x);
}
