//! label: Bump From Gradient
//! category: geometry
//! synonyms: surface gradient, slope, analytic bump
//! use: safe_normal
//! Bends the normal by a height whose gradient is known, which is sharper than differences between pixels
//! (Mikkelsen 2020, "Surface Gradient-Based Bump Mapping Framework").
//! cheaper: input normal - The smooth surface.

/// gradient (vector world): Change of the height per metre along each axis of the world, in metres.
/// strength (scalar; = 1; -4..4): Multiplies the gradient; negative turns bumps into dents.
/// normal (normal world near; = @normal_world): Normal of the smooth surface.
/// -> normal (normal world unit): The bent normal.
fn bump_from_gradient(gradient: vec3f, strength: f32, normal: vec3f) -> vec3f {
    let smooth_normal = unit_normal_or(normal, vec3f(0.0, 1.0, 0.0));
    // Only the part that lies in the surface tilts it.
    let slope = gradient - dot(gradient, smooth_normal) * smooth_normal;
    return unit_normal_or(smooth_normal - strength * slope, smooth_normal);
}
