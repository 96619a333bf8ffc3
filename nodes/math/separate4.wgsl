//! label: Separate XYZW
//! category: math
//! synonyms: split, break vector, vec4, decompose, unpack, components, separate rgba, channels
//! The four components of a vector.

/// Components of a vector of four.
struct Components4 {
    x: f32,
    y: f32,
    z: f32,
    w: f32,
}

/// vector (number): The vector.
/// -> x (number): First component, or red.
/// -> y (number): Second component, or green.
/// -> z (number): Third component, or blue.
/// -> w (number): Fourth component, or cover.
fn separate4(vector: vec4f) -> Components4 {
    return Components4(vector.x, vector.y, vector.z, vector.w);
}
