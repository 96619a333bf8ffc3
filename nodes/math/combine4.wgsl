//! label: Combine XYZW
//! category: math
//! synonyms: make vector, vec4, compose, append, join, pack, combine rgba
//! inline
//! Four numbers as one vector.

/// x (number; = 0): First component, or red.
/// y (number; = 0): Second component, or green.
/// z (number; = 0): Third component, or blue.
/// w (number; = 1): Fourth component, or cover.
/// -> vector (number): (x, y, z, w).
fn combine4(x: f32, y: f32, z: f32, w: f32) -> vec4f {
    return vec4f(x, y, z, w);
}
