//! label: Invert
//! category: color
//! synonyms: negative, complement, one minus, inverse color, invert color
//! inline
//! Turns a colour into its complement to white.

/// color (color): The colour.
/// amount (scalar; = 1; 0..1): 0 leaves the colour as it is, 1 inverts it fully.
/// -> color (color): Between the colour and white minus the colour; not below zero.
fn invert(color: vec3f, amount: f32) -> vec3f {
    return max(mix(color, vec3f(1.0) - color, amount), vec3f(0.0));
}
