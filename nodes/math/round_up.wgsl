//! label: Ceil
//! category: math
//! synonyms: ceil, ceiling, round up, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! The least whole number that is not below the value.

alias T = f32;

/// x (number): The value.
/// -> whole (number): x, rounded up.
fn round_up(x: T) -> T {
    return ceil(x);
}
