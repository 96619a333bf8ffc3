//! label: Combine XY
//! category: math
//! synonyms: make vector, vec2, compose, append, join, pack
//! inline
//! Two numbers as one vector.

/// x (number; = 0): First component.
/// y (number; = 0): Second component.
/// -> vector (number): (x, y).
fn combine2(x: f32, y: f32) -> vec2f {
    return vec2f(x, y);
}
