//! label: Reflect
//! category: math
//! synonyms: reflect, mirror, bounce, reflection vector, vector math
//! inline
//! The direction that a ray takes after it is mirrored at a surface.

/// incident (number): The ray's direction, towards the surface.
/// normal (normal unit): The surface's normal, on either side.
/// -> reflected (number): The ray's direction away from the surface, as long as the incident one.
fn reflect_vector(incident: vec3f, normal: vec3f) -> vec3f {
    return reflect(incident, normal);
}
