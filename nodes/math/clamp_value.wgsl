//! label: Clamp
//! category: math
//! synonyms: clamp, saturate, limit, constrain, 0 to 1, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! Keeps a value within a range.

alias T = f32;

/// x (number): The value.
/// low (number; = 0): The least result.
/// high (number; = 1): The greatest result; it wins where it is below the least.
/// -> clamped (number): x, or the end of the range that it passed.
fn clamp_value(x: T, low: T, high: T) -> T {
    return min(max(x, low), high);
}
