//! label: Linear Ramp
//! category: procedural
//! synonyms: gradient, blend, fade
//! use: ramps
//! A blend from one colour to another along one texture coordinate.
//! option axis: u | v = u - The texture coordinate that is followed.
//! option falloff: linear | smooth = linear - A straight blend, or one that starts and ends flat.
//! cheaper: constant - The mean of the pattern.

/// texcoord (texcoord; = @texcoord): Where to look the ramp up.
/// start (scalar; = 0): Coordinate of the first colour.
/// end (scalar; = 1): Coordinate of the last colour.
/// start_color (color; = (0, 0, 0); 0..; srgb): First colour.
/// end_color (color; = (1, 1, 1); 0..; srgb): Last colour.
/// -> color (color): The blend, in linear light.
/// -> value (scalar): How far along the ramp, 0..1.
fn ramp_linear(texcoord: vec2f, start: f32, end: f32, start_color: vec3f, end_color: vec3f) -> LinearRampPoint {
//#if axis == u
    let along = ramp_share(texcoord.x, start, end);
//#else
    let along = ramp_share(texcoord.y, start, end);
//#end
//#if falloff == linear
    let value = along;
//#else
    let value = along * along * (3.0 - 2.0 * along);
//#end
    return LinearRampPoint(mix(start_color, end_color, value), value);
}

struct LinearRampPoint {
    color: vec3f,
    value: f32,
}
