//! label: Mix surfaces
//! category: surface
//! synonyms: blend, lerp, mask, layer
//! inline
//! Two surfaces side by side below what the eye resolves: a share of the one and the rest of the other.
//! cheaper: input first - The first surface alone.
//! cheaper: input second - The second surface alone.

/// first (color radiance): The surface shown at 0.
/// second (color radiance): The surface shown at 1.
/// amount (scalar; = 0.5; 0..1): Share of the second.
/// -> radiance (color radiance): Light that leaves towards the camera.
fn mix_surface(first: vec3f, second: vec3f, amount: f32) -> vec3f {
    return mix(first, second, saturate(amount));
}
