//! label: Truncate
//! category: math
//! synonyms: trunc, integer part, round towards zero, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! A value without its fraction: rounded towards zero.

alias T = f32;

/// x (number): The value.
/// -> whole (number): x, rounded towards zero.
fn truncate(x: T) -> T {
    return trunc(x);
}
