//! label: Wood Rings
//! category: procedural
//! synonyms: timber, grain, annual rings
//! use: box_filter, fractal, perlin
//! Annual rings of a tree around an axis: early wood darkens slowly into late wood and then starts again. Noise makes
//! the rings uneven, and fine fibres run along the trunk (after the wood of Peachey 1985 and Perlin 1985).
//! cheaper: constant - The mean of the pattern.

/// position (point object; = @position_object): Where to look the wood up.
/// center (point object; = (0, 0, 0.3)): A point on the axis of the trunk.
/// axis (vector; = (1, 0, 0)): Along the trunk; its length does not matter.
/// scale (scalar; = 12): Rings per metre.
/// distortion (scalar; = 0.6; 0..4): How many rings the noise moves them.
/// fibers (scalar; = 0.25; 0..1): How strongly fibres show.
/// early_color (color reflectance; = (0.80, 0.60, 0.38); 0..1; srgb): Wood of spring.
/// late_color (color reflectance; = (0.48, 0.28, 0.14); 0..1; srgb): Wood of autumn.
/// -> color (color reflectance): Colour of the wood.
/// -> ring (scalar): 0 in early wood, 1 in late wood.
fn wood_rings(
    position: vec3f,
    center: vec3f,
    axis: vec3f,
    scale: f32,
    distortion: f32,
    fibers: f32,
    early_color: vec3f,
    late_color: vec3f,
) -> WoodPoint {
    let trunk = axis / max(length(axis), 1e-6);
    let offset = position - center;
    let along = dot(offset, trunk);
    let outward = offset - along * trunk;
    // Trunks change slowly along their axis, so the noise is stretched along it.
    let stretched = outward + 0.2 * along * trunk;
    let wobble = perlin_noise3(stretched * 2.0) + 0.5 * perlin_noise3(stretched * 5.0 + 19.0);
    let radius = length(outward) * scale + distortion * wobble;
    let width = pixel_width1(radius);
    // A slow rise over most of the period and a quick fall at its end.
    let rise = filtered_saw(radius, width);
    let end = filtered_pulse(radius + 0.12, 0.12, width);
    let ring = clamp(rise * rise * (1.0 - end), 0.0, 1.0);
    let fiber_point = (outward + 0.03 * along * trunk) * scale * 12.0;
    let fiber = perlin_noise3(fiber_point) * detail_left(octave_footprint3(fiber_point));
    let shade = clamp(ring + fibers * fiber, 0.0, 1.0);
    return WoodPoint(mix(early_color, late_color, shade), ring);
}

struct WoodPoint {
    color: vec3f,
    ring: f32,
}
