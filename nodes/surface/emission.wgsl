//! label: Emission
//! category: surface
//! synonyms: glow, emissive, light source, self-illumination
//! inline
//! Light that the surface makes itself, equal in all directions. It does not light other objects; add it to another surface.

/// color (color emission; = (1, 0.9, 0.7); 0..): Tint of the light.
/// strength (scalar; = 1; 0..): Radiance of white, W/(m^2 sr).
/// -> radiance (color radiance): Light that leaves towards the camera.
fn emission(color: vec3f, strength: f32) -> vec3f {
    return color * strength;
}
