//! label: Luminance
//! category: color
//! synonyms: rgb to bw, grayscale, greyscale, brightness, luma, intensity, color to float
//! use: rec709
//! inline
//! How bright a linear colour looks: its relative luminance by the weights of Rec. ITU-R BT.709.
//! The hue is lost: this is the way from a colour to one number.

/// color (color linear): The colour.
/// -> luminance (scalar): 0.2126 of red, 0.7152 of green and 0.0722 of blue; 1 for white.
fn luminance(color: vec3f) -> f32 {
    return luminance_rec709(color);
}
