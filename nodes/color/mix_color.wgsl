//! label: Mix Color
//! category: color
//! synonyms: mix, mixrgb, lerp, blend, crossfade, interpolate, colour
//! inline
//! Goes from one colour to another in a straight line, in linear light.

/// a (color): The colour at factor 0.
/// b (color; = (1, 1, 1); srgb): The colour at factor 1.
/// factor (scalar; = 0.5; 0..1): Where between the two.
/// -> color (color): a + (b - a) * factor.
fn mix_color(a: vec3f, b: vec3f, factor: f32) -> vec3f {
    return mix(a, b, factor);
}
