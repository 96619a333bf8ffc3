//! label: Combine XYZ
//! category: math
//! synonyms: make vector, vec3, compose, append, join, pack, combine rgb
//! inline
//! Three numbers as one vector or colour.

/// x (number; = 0): First component, or red.
/// y (number; = 0): Second component, or green.
/// z (number; = 0): Third component, or blue.
/// -> vector (number): (x, y, z).
fn combine3(x: f32, y: f32, z: f32) -> vec3f {
    return vec3f(x, y, z);
}
