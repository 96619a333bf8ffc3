//! Angles as shares of a whole turn.

/// Whole turns in a radian.
const TURNS_PER_RADIAN: f32 = 0.15915494;

/// Angle of a vector from the first axis towards the second, -0.5..0.5 turns; 0 for the zero vector.
fn turns_around(v: vec2f) -> f32 {
    // atan2 is undefined at the origin.
    let at_origin = v.x == 0.0 && v.y == 0.0;
    return atan2(v.y, select(v.x, 1.0, at_origin)) * TURNS_PER_RADIAN;
}
