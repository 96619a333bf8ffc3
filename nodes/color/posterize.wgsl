//! label: Posterize
//! category: color
//! synonyms: quantize, banding, toon, cel, steps, reduce colors
//! Cuts each component of a colour to a few even steps.

/// color (color): The colour; it is held within 0..1.
/// steps (scalar; = 4; 2..): How many values a component can have, rounded to a whole number.
/// -> color (color): The colour in steps; black and white stay.
fn posterize(color: vec3f, steps: f32) -> vec3f {
    let count = max(round(steps), 2.0);
    let band = floor(clamp(color, vec3f(0.0), vec3f(1.0)) * count);
    return min(band, vec3f(count - 1.0)) / (count - 1.0);
}
