//! label: Stripes
//! category: procedural
//! synonyms: bars, lines, zebra
//! use: box_filter
//! Straight stripes of two colours on texture coordinates, averaged exactly over each pixel.
//! cheaper: constant - The mean of the pattern.

/// texcoord (texcoord; = @texcoord): Where to look the pattern up.
/// scale (scalar; = 8): Pairs of stripes per unit of the texture coordinate.
/// rotation (angle; = 0; in deg): Turns the direction across the stripes from the first axis towards the second.
/// share (scalar; = 0.5; 0..1): Share of the first colour.
/// color_a (color reflectance; = (0.9, 0.9, 0.9); 0..1; srgb): First colour.
/// color_b (color reflectance; = (0.2, 0.2, 0.2); 0..1; srgb): Second colour.
/// -> color (color reflectance): Colour of the pattern.
/// -> mask (scalar): 1 in stripes of the first colour, 0 in the others.
fn stripes(texcoord: vec2f, scale: f32, rotation: f32, share: f32, color_a: vec3f, color_b: vec3f) -> StripePoint {
    let across = dot(texcoord, vec2f(cos(rotation), sin(rotation))) * scale;
    let mask = filtered_pulse(across, clamp(share, 0.0, 1.0), pixel_width1(across));
    return StripePoint(mix(color_b, color_a, mask), mask);
}

struct StripePoint {
    color: vec3f,
    mask: f32,
}
