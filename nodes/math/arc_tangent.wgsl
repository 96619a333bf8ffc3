//! label: Arc Tangent
//! category: math
//! synonyms: atan, arctan, inverse tangent, trigonometry, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! The angle that has a given tangent.

alias T = f32;

/// x (number): The tangent, a slope.
/// -> angle (number): In radians, from -pi/2 to pi/2.
fn arc_tangent(x: T) -> T {
    return atan(x);
}
