//! label: Value Noise 2D
//! category: procedural
//! synonyms: lattice noise, blotches
//! use: value_lattice
//! Blotches on texture coordinates: a random number at each lattice point, blended smoothly;
//! blockier and stronger than Perlin noise.
//! option range: unit | signed = unit - Values from 0 to 1 around 0.5, or from -1 to 1 around 0.
//! cheaper: constant - The mean of the pattern.
//! cheaper: vertex - Noise at the vertices, interpolated.

/// texcoord (texcoord; = @texcoord): Where to look the noise up.
/// scale (scalar; = 8): Features per unit of the texture coordinate.
//#if range == unit
/// -> value (scalar): Noise in 0..1; mean 0.5, standard deviation 0.23.
//#else
/// -> value (scalar): Noise in -1..1; mean 0, standard deviation 0.45.
//#end
fn value_noise2d(texcoord: vec2f, scale: f32) -> f32 {
    let noise = value_lattice2(texcoord * scale);
//#if range == unit
    return clamp(0.5 + 0.5 * noise, 0.0, 1.0);
//#else
    return clamp(noise, -1.0, 1.0);
//#end
}
