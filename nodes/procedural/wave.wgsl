//! label: Wave
//! category: procedural
//! synonyms: bands, oscillator, ripples, sine, sawtooth
//! use: box_filter
//! Parallel waves throughout space, fixed to the object and averaged over each pixel.
//! option shape: sine | triangle | saw | square = sine - The profile of a wave.
//! cheaper: constant - The mean of the pattern.

/// position (point object; = @position_object): Where to look the wave up.
/// direction (vector; = (1, 0, 0)): Along which it repeats; its length does not matter.
/// scale (scalar; = 5): Waves per metre.
/// phase (scalar; = 0): Moves the wave; 1 is a whole wave.
/// -> value (scalar): The wave, 0..1; it starts at 0, or at 1 if it is square.
fn wave(position: vec3f, direction: vec3f, scale: f32, phase: f32) -> f32 {
    let along = dot(position, direction) / max(length(direction), 1e-6) * scale;
    let width = pixel_width1(along);
//#if shape == sine
    return filtered_cosine(along - phase, width);
//#elif shape == triangle
    return filtered_triangle(along - phase, width);
//#elif shape == saw
    return filtered_saw(along - phase, width);
//#else
    return filtered_pulse(along - phase, 0.5, width);
//#end
}
