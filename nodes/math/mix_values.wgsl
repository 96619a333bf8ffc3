//! label: Mix
//! category: math
//! synonyms: mix, lerp, linear interpolation, interpolate, blend, crossfade, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! Goes from one value to another in a straight line.

alias T = f32;

/// a (number): The value at factor 0.
/// b (number; = 1): The value at factor 1.
/// factor (scalar; = 0.5): Where between the two; outside 0..1 the line goes on.
/// -> mixed (number): a + (b - a) * factor.
fn mix_values(a: T, b: T, factor: f32) -> T {
    return mix(a, b, factor);
}
