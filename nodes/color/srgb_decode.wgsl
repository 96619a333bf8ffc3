//! label: sRGB Decode
//! category: color
//! synonyms: srgb to linear, gamma decode, convert colorspace, linearize, degamma
//! Decodes sRGB components to linear light, exactly (IEC 61966-2-1: a straight piece near black, then a power).

/// encoded (number): The encoded components, whatever they are declared as.
/// -> color (color linear): Linear light.
fn srgb_decode(encoded: vec3f) -> vec3f {
    let curved = pow((max(encoded, vec3f(0.04045)) + 0.055) / 1.055, vec3f(2.4));
    return select(curved, encoded / 12.92, encoded <= vec3f(0.04045));
}
