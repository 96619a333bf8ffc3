//! label: Color Ramp 3
//! category: color
//! synonyms: gradient, colorramp, three stops, color map, lookup, heat map
//! Colours a number by a ramp of three stops.
//! option interpolation: linear | smooth | constant = linear - Straight, smoothstep, or a jump at each stop.
//! cheaper: constant - The mean of the colours.

/// factor (number): Where on the ramp.
/// low (color; = (0.02, 0.05, 0.3); srgb): The colour at and before the first stop.
/// middle (color; = (0.85, 0.3, 0.3); srgb): The colour at the second stop.
/// high (color; = (1, 0.95, 0.7); srgb): The colour at and after the third stop.
/// start (scalar; = 0): Where the first stop is.
/// center (scalar; = 0.5): Where the second stop is, between the others.
/// end (scalar; = 1): Where the third stop is.
/// -> color (color): The colour there.
fn color_ramp3(
    factor: f32,
    low: vec3f,
    middle: vec3f,
    high: vec3f,
    start: f32,
    center: f32,
    end: f32,
) -> vec3f {
//#if interpolation == constant
    return select(select(low, middle, factor >= center), high, factor >= end);
//#else
    let rise = clamp((factor - start) / max(center - start, 1e-6), 0.0, 1.0);
    let fall = clamp((factor - center) / max(end - center, 1e-6), 0.0, 1.0);
//#if interpolation == smooth
    let first = rise * rise * (3.0 - 2.0 * rise);
    let second = fall * fall * (3.0 - 2.0 * fall);
    return mix(mix(low, middle, first), high, second);
//#else
    return mix(mix(low, middle, rise), high, fall);
//#end
//#end
}
