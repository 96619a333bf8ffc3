//! label: Ridged Noise 3D
//! category: procedural
//! synonyms: ridged multifractal, mountains, veins, cracks
//! use: fractal, perlin
//! Sharp ridges that gather detail: octaves of (1 - |Perlin noise|)^2, each weighted by the one before (Musgrave 1994,
//! ridged multifractal), divided by the sum of their amplitudes. Octaves too fine for a pixel fade to their average.
//! option octaves: 1 | 2 | 3 | 4 | 5 | 6 | 7 | 8 = 5 - How many sizes of detail.
//! cheaper: option octaves = 8 > 7 > 6 > 5 > 4 > 3 > 2 > 1 - Fewer sizes of detail.
//! cheaper: constant - The mean of the pattern.

const OCTAVES: i32 = 5;

/// position (point object; = @position_object): Where to look the noise up.
/// scale (scalar; = 2): Features of the coarsest octave per metre.
/// lacunarity (scalar; = 2; 1..8): How much finer each octave is than the one before.
/// gain (scalar; = 0.5; 0..1): How much weaker each octave is than the one before.
/// sharpness (scalar; = 2; 0..4): How strongly detail gathers on the ridges of the coarser octave.
/// -> value (scalar): Height of the ridges, 0..1; 1 along the crests.
fn ridged3d(position: vec3f, scale: f32, lacunarity: f32, gain: f32, sharpness: f32) -> f32 {
    let base = position * scale;
    let footprint = octave_footprint3(base);
    var sum = 0.0;
    var total = 0.0;
    var amplitude = 1.0;
    var frequency = 1.0;
    var weight = 1.0;
    for (var octave = 0; octave < OCTAVES; octave++) {
        let crest = 1.0 - abs(perlin_noise3(base * frequency + octave_shift3(octave)));
        let ridge = weight * mix(PERLIN3_MEAN_RIDGE, crest * crest, detail_left(footprint * frequency));
        sum += amplitude * ridge;
        total += amplitude;
        weight = clamp(ridge * sharpness, 0.0, 1.0);
        amplitude *= gain;
        frequency *= lacunarity;
    }
    return clamp(sum / total, 0.0, 1.0);
}
