//! label: Domain Warp 3D
//! category: procedural
//! synonyms: distort, gradient noise warp, turbulence, swirl
//! use: perlin
//! Shifts points of space by Perlin noise, so that a pattern looked up there gets wavy.
//! cheaper: input position - The pattern is not disturbed.

/// position (point object; = @position_object): Point to shift.
/// scale (scalar; = 2): Features of the noise per metre.
/// amount (distance; = 0.2; in m): Largest shift of each component.
/// -> position (point object): The shifted point.
fn domain_warp3d(position: vec3f, scale: f32, amount: f32) -> vec3f {
    let p = position * scale;
    let shift = vec3f(
        perlin_noise3(p),
        perlin_noise3(p + vec3f(37.7, 91.3, 11.9)),
        perlin_noise3(p + vec3f(71.1, 13.7, 53.3)),
    );
    return position + amount * shift;
}
