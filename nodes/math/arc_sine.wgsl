//! label: Arc Sine
//! category: math
//! synonyms: asin, arcsin, inverse sine, trigonometry, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! The angle that has a given sine.

alias T = f32;

/// x (number): The sine; it is held within -1..1.
/// -> angle (number): In radians, from -pi/2 to pi/2.
fn arc_sine(x: T) -> T {
    return asin(clamp(x, T(-1.0), T(1.0)));
}
