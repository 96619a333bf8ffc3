//! label: Fractal Noise 3D
//! category: procedural
//! synonyms: fbm, fractal Brownian motion, octaves, clouds, terrain
//! use: fractal, perlin, value_lattice, simplex
//! Noise with detail at many sizes: a sum of octaves, each finer and weaker than the one before (Musgrave 1994,
//! fractional Brownian motion), divided by the sum of their amplitudes. Octaves too fine for a pixel fade out.
//! option basis: perlin | value | simplex = perlin - The noise that is summed.
//! option octaves: 1 | 2 | 3 | 4 | 5 | 6 | 7 | 8 = 5 - How many sizes of detail.
//! option range: unit | signed = unit - Values from 0 to 1 around 0.5, or from -1 to 1 around 0.
//! cheaper: option octaves = 8 > 7 > 6 > 5 > 4 > 3 > 2 > 1 - Fewer sizes of detail.
//! cheaper: constant - The mean of the pattern.

const OCTAVES: i32 = 5;

/// position (point object; = @position_object): Where to look the noise up.
/// scale (scalar; = 2): Features of the coarsest octave per metre.
/// lacunarity (scalar; = 2; 1..8): How much finer each octave is than the one before.
/// gain (scalar; = 0.5; 0..1): How much weaker each octave is than the one before.
//#if range == unit
/// -> value (scalar): Noise in 0..1 around 0.5.
//#else
/// -> value (scalar): Noise in -1..1 around 0.
//#end
fn fbm3d(position: vec3f, scale: f32, lacunarity: f32, gain: f32) -> f32 {
    let base = position * scale;
    let footprint = octave_footprint3(base);
    var sum = 0.0;
    var total = 0.0;
    var amplitude = 1.0;
    var frequency = 1.0;
    for (var octave = 0; octave < OCTAVES; octave++) {
        let p = base * frequency + octave_shift3(octave);
//#if basis == perlin
        let noise = perlin_noise3(p);
//#elif basis == value
        let noise = value_lattice3(p);
//#else
        let noise = simplex_noise3(p);
//#end
        sum += amplitude * noise * detail_left(footprint * frequency);
        total += amplitude;
        amplitude *= gain;
        frequency *= lacunarity;
    }
//#if range == unit
    return clamp(0.5 + 0.5 * sum / total, 0.0, 1.0);
//#else
    return clamp(sum / total, -1.0, 1.0);
//#end
}
