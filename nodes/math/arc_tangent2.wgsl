//! label: Arc Tangent 2
//! category: math
//! synonyms: atan2, arctan2, polar angle, direction angle, trigonometry, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! The angle of the point (x, y) around the origin, in all four quadrants.

alias T = f32;

/// y (number): The point's height.
/// x (number; = 1): How far the point is to the right.
/// -> angle (number): In radians from the x axis, from -pi to pi; zero at the origin.
fn arc_tangent2(y: T, x: T) -> T {
    let at_origin = (x == T(0.0)) & (y == T(0.0));
    return atan2(y, select(x, T(1.0), at_origin));
}
