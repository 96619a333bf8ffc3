//! label: sRGB Encode
//! category: color
//! synonyms: linear to srgb, gamma encode, convert colorspace, display encoding
//! Encodes linear light as sRGB, exactly (IEC 61966-2-1: a straight piece near black, then a power).
//! The result counts as plain numbers, so that nothing decodes it again on its way.

/// color (color linear): Linear light.
/// -> encoded (number): The encoded components.
fn srgb_encode(color: vec3f) -> vec3f {
    let curved = 1.055 * pow(max(color, vec3f(0.0031308)), vec3f(1.0 / 2.4)) - 0.055;
    return select(curved, 12.92 * color, color <= vec3f(0.0031308));
}
