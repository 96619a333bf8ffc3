//! label: Marble
//! category: procedural
//! synonyms: stone, veins, turbulence
//! use: box_filter, perlin
//! Veined stone: parallel bands whose position is disturbed by turbulence (Perlin 1985, section "Marble").
//! option octaves: 1 | 2 | 3 | 4 | 5 = 5 - How many sizes of turbulence disturb the bands; the others count as their mean.
//! cheaper: option octaves = 5 > 4 > 3 > 2 > 1 - Fewer sizes of turbulence.
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
//#if octaves == 5
    let phase = dot(base, across) + 2.0 * distortion * (perlin_turbulence5(base, footprint) - PERLIN3_MEAN_ABSOLUTE);
//#else
    let phase = dot(base, across) + 2.0 * distortion * (coarse_turbulence(base, footprint) - PERLIN3_MEAN_ABSOLUTE);
//#end
    let band = filtered_cosine(phase, pixel_width1(phase));
    let vein = pow(max(band, 0.0), max(sharpness, 0.1));
    return MarblePoint(mix(base_color, vein_color, vein), vein);
}

//#if octaves != 5
const OCTAVES: i32 = 5;

/// The coarser octaves of `perlin_turbulence5`, with the mean of the finer ones.
fn coarse_turbulence(p: vec3f, footprint: f32) -> f32 {
    var sum = 0.0;
    var amplitude = 0.5161290;
    var left = 1.0;
    var frequency = 1.0;
    for (var octave = 0; octave < OCTAVES; octave++) {
        let noise = abs(perlin_noise3(p * frequency + octave_shift3(octave)));
        sum += amplitude * mix(PERLIN3_MEAN_ABSOLUTE, noise, detail_left(footprint * frequency));
        left -= amplitude;
        amplitude *= 0.5;
        frequency *= 2.0;
    }
    return sum + left * PERLIN3_MEAN_ABSOLUTE;
}
//#end

struct MarblePoint {
    color: vec3f,
    vein: f32,
}
