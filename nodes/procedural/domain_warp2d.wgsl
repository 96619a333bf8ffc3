//! label: Domain Warp 2D
//! category: procedural
//! synonyms: distort, gradient noise warp, turbulence, swirl
//! use: perlin
//! Shifts points of texture coordinates by Perlin noise, so that a pattern looked up there gets wavy.
//! cheaper: input texcoord - The pattern is not disturbed.

/// texcoord (texcoord; = @texcoord): Point to shift.
/// scale (scalar; = 4): Features of the noise per unit of the texture coordinate.
/// amount (scalar; = 0.1): Largest shift of each component, in texture coordinates.
/// -> texcoord (texcoord): The shifted point.
fn domain_warp2d(texcoord: vec2f, scale: f32, amount: f32) -> vec2f {
    let p = texcoord * scale;
    let shift = vec2f(perlin_noise2(p), perlin_noise2(p + vec2f(37.7, 91.3)));
    return texcoord + amount * shift;
}
