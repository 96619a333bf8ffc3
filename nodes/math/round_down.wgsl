//! label: Floor
//! category: math
//! synonyms: floor, round down, integer part, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! The greatest whole number that is not above the value.

alias T = f32;

/// x (number): The value.
/// -> whole (number): x, rounded down.
fn round_down(x: T) -> T {
    return floor(x);
}
