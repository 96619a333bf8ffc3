//! label: Round
//! category: math
//! synonyms: round, nearest integer, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! The whole number that is nearest; halves go to the even neighbour.

alias T = f32;

/// x (number): The value.
/// -> whole (number): x, rounded.
fn round_nearest(x: T) -> T {
    return round(x);
}
