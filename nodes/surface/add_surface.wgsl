//! label: Add surfaces
//! category: surface
//! synonyms: sum, combine, layer
//! inline
//! commutative
//! The light of two surfaces together. It can return more than arrives: meant for emission, sheen and other additions.

/// first (color radiance): One surface.
/// second (color radiance): The other.
/// -> radiance (color radiance): Their sum.
fn add_surface(first: vec3f, second: vec3f) -> vec3f {
    return first + second;
}
