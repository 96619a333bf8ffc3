//! Weights of the primaries of Rec. ITU-R BT.709, which sRGB shares.

/// Relative luminance of a linear colour.
fn luminance_rec709(color: vec3f) -> f32 {
    return dot(color, vec3f(0.2126, 0.7152, 0.0722));
}
