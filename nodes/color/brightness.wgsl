//! label: Brightness
//! category: color
//! synonyms: bright, lighten, darken, offset, lift, bright contrast, color correction
//! inline
//! Adds the same amount to all components of a colour.

/// color (color linear): The colour.
/// amount (scalar; = 0): What is added; negative darkens.
/// -> color (color linear): The changed colour, not below zero.
fn brightness(color: vec3f, amount: f32) -> vec3f {
    return max(color + amount, vec3f(0.0));
}
