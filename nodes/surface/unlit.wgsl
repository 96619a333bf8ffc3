//! label: Unlit
//! category: surface
//! synonyms: flat color, constant, shadeless, background
//! inline
//! A colour as it is, whatever the light.

/// color (color; = (0.8, 0.8, 0.8); 0..): Radiance to show, linear.
/// -> radiance (color radiance): The same.
fn unlit(color: vec3f) -> vec3f {
    return color;
}
