//! label: Marble
//! category: procedural
//! synonyms: stone, veins, turbulence
//! use: box_filter, perlin
//! Veined stone: parallel bands whose position is disturbed by turbulence (Perlin 1985, section "Marble").
//! cheaper: constant - The mean of the pattern.

/// position (point object; = @position_object): Where to look the stone up.
/// direction (vector; = (1, 0.5, 0.3)): Across the veins; its length does not matter.
/// scale (scalar; = 2): Veins per metre before they are disturbed.
/// distortion (scalar; = 1; 0..8): How many vein widths turbulence moves the bands.
/// sharpness (scalar; = 5; 0.1..16): How thin the veins are.
/// base_color (color reflectance; = (0.86, 0.85, 0.82); 0..1; srgb): The stone.
/// vein_color (color reflectance; = (0.25, 0.25, 0.28); 0..1; srgb): The veins.
/// -> color (color reflectance): Colour of the stone.
/// -> vein (scalar): Share of the vein's colour, 0..1.
fn marble(
    position: vec3f,
    direction: vec3f,
    scale: f32,
    distortion: f32,
    sharpness: f32,
    base_color: vec3f,
    vein_color: vec3f,
) -> MarblePoint {
    let base = position * scale;
    let across = direction / max(length(direction), 1e-6);
    let footprint = octave_footprint3(base);
    // 2 because turbulence seldom leaves 0..0.7 and the bands should move by about `distortion`.
    let phase = dot(base, across) + 2.0 * distortion * (perlin_turbulence5(base, footprint) - PERLIN3_MEAN_ABSOLUTE);
    let band = filtered_cosine(phase, pixel_width1(phase));
    let vein = pow(max(band, 0.0), max(sharpness, 0.1));
    return MarblePoint(mix(base_color, vein_color, vein), vein);
}

struct MarblePoint {
    color: vec3f,
    vein: f32,
}
