//! label: Rotate 2D
//! category: math
//! synonyms: rotate uv, rotator, spin, turn, mapping rotation
//! Turns a point of the plane around a centre.

/// vector (number): The point, or texture coordinates.
/// angle (angle; = 45; in deg): How far, from the first axis towards the second.
/// center (number; = (0.5, 0.5)): The point that stays where it is.
/// -> rotated (number): The turned point.
fn rotate2d(vector: vec2f, angle: f32, center: vec2f) -> vec2f {
    let arm = vector - center;
    let c = cos(angle);
    let s = sin(angle);
    return center + vec2f(c * arm.x - s * arm.y, s * arm.x + c * arm.y);
}
