//! label: To Degrees
//! category: math
//! synonyms: degrees, radians to degrees, convert angle, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! Radians as degrees.

alias T = f32;

/// x (number): In radians.
/// -> angle (number): In degrees.
fn to_degrees(x: T) -> T {
    return degrees(x);
}
