//! label: Refract
//! category: math
//! synonyms: refract, snell, bend ray, transmission, glass, ior, vector math
//! The direction that a ray takes after it enters another medium, by Snell's law.
//! Where all light is reflected there is no such ray and the result is zero.

/// incident (direction unit): The ray's direction, towards the surface.
/// normal (normal unit): The surface's normal, on the side that the ray comes from.
/// ior (number; = 1.5; 0..): Index of refraction behind the surface over the one before it: entering glass 1.5, leaving it 0.67.
/// -> refracted (number): The ray's unit direction behind the surface.
fn refract_vector(incident: vec3f, normal: vec3f, ior: f32) -> vec3f {
    return refract(incident, normal, 1.0 / max(ior, 1e-6));
}
