//! label: Rotate about Axis
//! category: math
//! synonyms: axis angle, vector rotate, rodrigues, spin, turn, 3d rotation
//! use: unit_vectors
//! Turns a point around an axis through a centre, counter-clockwise as seen from the axis' tip (Rodrigues' formula).

/// vector (number): The point or direction.
/// axis (number; = (0, 1, 0)): Where the axis points; any length but zero, which turns nothing.
/// angle (angle; = 45; in deg): How far.
/// center (number; = (0, 0, 0)): A point on the axis; keep it zero for directions.
/// -> rotated (number): The turned point.
fn rotate_about_axis(vector: vec3f, axis: vec3f, angle: f32, center: vec3f) -> vec3f {
    let along = unit_or_zero(axis);
    let arm = vector - center;
    let on_axis = along * dot(along, arm);
    let turned = on_axis + (arm - on_axis) * cos(angle) + cross(along, arm) * sin(angle);
    return center + select(turned, arm, dot(along, along) < 0.5);
}
