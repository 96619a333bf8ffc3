//! label: Levels
//! category: color
//! synonyms: color levels, black point, white point, remap color, midtones, curves, histogram
//! Stretches the tones between a black and a white point to a new range, with a bend of the middle tones.

/// color (color): The colour.
/// black (scalar; = 0): The input that becomes the lower end.
/// white (scalar; = 1): The input that becomes the upper end.
/// gamma (scalar; = 1; 0.01..): Bend of the middle tones: above 1 brightens them.
/// low (scalar; = 0): Lower end of the result.
/// high (scalar; = 1): Upper end of the result.
/// -> color (color): The stretched colour, within the two ends.
fn levels(color: vec3f, black: f32, white: f32, gamma: f32, low: f32, high: f32) -> vec3f {
    let span = select(white - black, 1e-6, white == black);
    let t = clamp((color - black) / span, vec3f(0.0), vec3f(1.0));
    let bent = pow(max(t, vec3f(1e-30)), vec3f(1.0 / max(gamma, 0.01)));
    return mix(vec3f(low), vec3f(high), select(bent, vec3f(0.0), t <= vec3f(0.0)));
}
