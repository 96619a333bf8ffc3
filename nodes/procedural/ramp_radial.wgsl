//! label: Radial Ramp
//! category: procedural
//! synonyms: gradient, spot, vignette, circle
//! use: ramps
//! A blend from one colour in the middle of a circle on the texture plane to another on its rim and beyond.
//! option falloff: linear | smooth = linear - A straight blend, or one that starts and ends flat.
//! cheaper: constant - The mean of the pattern.

/// texcoord (texcoord; = @texcoord): Where to look the ramp up.
/// center (texcoord; = (0.5, 0.5)): Middle of the circle.
/// radius (scalar; = 0.5; 0..): Radius of the circle in texture coordinates.
/// start_color (color; = (1, 1, 1); 0..; srgb): Colour in the middle.
/// end_color (color; = (0, 0, 0); 0..; srgb): Colour on the rim.
/// -> color (color): The blend, in linear light.
/// -> value (scalar): 0 in the middle, 1 on the rim and beyond.
fn ramp_radial(texcoord: vec2f, center: vec2f, radius: f32, start_color: vec3f, end_color: vec3f) -> RadialRampPoint {
    let along = ramp_share(length(texcoord - center), 0.0, radius);
//#if falloff == linear
    let value = along;
//#else
    let value = along * along * (3.0 - 2.0 * along);
//#end
    return RadialRampPoint(mix(start_color, end_color, value), value);
}

struct RadialRampPoint {
    color: vec3f,
    value: f32,
}
