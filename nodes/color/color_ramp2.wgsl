//! label: Color Ramp
//! category: color
//! synonyms: gradient, colorramp, two stops, color map, lookup, tint mask
//! Colours a number: one colour below, one above, and a course between them.
//! option interpolation: linear | smooth | constant = linear - Straight, smoothstep, or a jump at the second stop.
//! cheaper: constant - The mean of the colours.

/// factor (number): Where on the ramp.
/// low (color; = (0, 0, 0); srgb): The colour at and before the first stop.
/// high (color; = (1, 1, 1); srgb): The colour at and after the second stop.
/// start (scalar; = 0): Where the first stop is.
/// end (scalar; = 1): Where the second stop is.
/// -> color (color): The colour there.
fn color_ramp2(factor: f32, low: vec3f, high: vec3f, start: f32, end: f32) -> vec3f {
//#if interpolation == constant
    return select(low, high, factor >= end);
//#else
    let span = select(end - start, 1e-6, end == start);
    let t = clamp((factor - start) / span, 0.0, 1.0);
//#if interpolation == smooth
    return mix(low, high, t * t * (3.0 - 2.0 * t));
//#else
    return mix(low, high, t);
//#end
//#end
}
