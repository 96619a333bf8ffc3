//! label: Perlin Noise 3D
//! category: procedural
//! synonyms: gradient noise, clouds, bumps, solid noise
//! use: perlin
//! Smooth random bumps of one size throughout space, fixed to the object: Perlin's improved noise (Perlin 2002).
//! option range: unit | signed = unit - Values from 0 to 1 around 0.5, or from -1 to 1 around 0.
//! cheaper: kind value_noise3d - Noise of values rather than of slopes.
//! cheaper: constant - The mean of the pattern.
//! cheaper: vertex - Noise at the vertices, interpolated.

/// position (point object; = @position_object): Where to look the noise up.
/// scale (scalar; = 4): Features per metre.
//#if range == unit
/// -> value (scalar): Noise in 0..1; mean 0.5, standard deviation 0.13.
//#else
/// -> value (scalar): Noise in -1..1; mean 0, standard deviation 0.26.
//#end
fn perlin3d(position: vec3f, scale: f32) -> f32 {
    let noise = perlin_noise3(position * scale);
//#if range == unit
    return clamp(0.5 + 0.5 * noise, 0.0, 1.0);
//#else
    return clamp(noise, -1.0, 1.0);
//#end
}
