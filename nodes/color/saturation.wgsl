//! label: Saturation
//! category: color
//! synonyms: desaturate, vibrance, grayscale, greyscale, colorfulness, black and white
//! use: rec709
//! Moves a colour away from or towards the grey of equal luminance.

/// color (color linear): The colour.
/// amount (scalar; = 1; 0..): 0 is grey, 1 leaves the colour as it is, more makes it more vivid.
/// -> color (color linear): The changed colour; its luminance is kept until a component reaches zero.
fn saturation(color: vec3f, amount: f32) -> vec3f {
    return max(mix(vec3f(luminance_rec709(color)), color, amount), vec3f(0.0));
}
