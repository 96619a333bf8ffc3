//! label: Separate XYZ
//! category: math
//! synonyms: split, break vector, vec3, decompose, unpack, components, separate rgb, channels
//! The three components of a vector or colour.

/// Components of a vector of three.
struct Components3 {
    x: f32,
    y: f32,
    z: f32,
}

/// vector (number): The vector.
/// -> x (number): First component, or red.
/// -> y (number): Second component, or green.
/// -> z (number): Third component, or blue.
fn separate3(vector: vec3f) -> Components3 {
    return Components3(vector.x, vector.y, vector.z);
}
