//! label: Simplex Noise 2D
//! category: procedural
//! synonyms: gradient noise, opensimplex, bumps
//! use: simplex
//! Smooth random bumps on a triangular lattice, with fewer directional artefacts than Perlin noise
//! (Perlin 2001, Gustavson 2005).
//! option range: unit | signed = unit - Values from 0 to 1 around 0.5, or from -1 to 1 around 0.
//! cheaper: kind value_noise2d - Noise of values rather than of slopes.
//! cheaper: constant - The mean of the pattern.
//! cheaper: vertex - Noise at the vertices, interpolated.

/// texcoord (texcoord; = @texcoord): Where to look the noise up.
/// scale (scalar; = 8): Features per unit of the texture coordinate.
//#if range == unit
/// -> value (scalar): Noise in 0..1; mean 0.5, standard deviation 0.27.
//#else
/// -> value (scalar): Noise in -1..1; mean 0, standard deviation 0.54.
//#end
fn simplex2d(texcoord: vec2f, scale: f32) -> f32 {
    let noise = simplex_noise2(texcoord * scale);
//#if range == unit
    return clamp(0.5 + 0.5 * noise, 0.0, 1.0);
//#else
    return clamp(noise, -1.0, 1.0);
//#end
}
