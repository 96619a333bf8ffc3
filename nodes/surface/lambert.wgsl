//! label: Lambert
//! category: surface
//! synonyms: diffuse, matte, flat, chalk
//! use: microfacet, environment
//! Matte reflection: equally bright from everywhere (Lambert 1760).

/// irradiance (color irradiance): Light that arrives, measured facing the light.
/// to_light (direction world unit): Towards the light.
/// normal (normal world unit; = @normal_world): Shading normal.
/// albedo (color reflectance; = (0.8, 0.8, 0.8); 0..1): Share of light that is scattered back.
/// -> radiance (color radiance): Light that leaves towards the camera.
fn lambert(irradiance: vec3f, to_light: vec3f, normal: vec3f, albedo: vec3f) -> vec3f {
    return albedo * irradiance * (saturate(dot(normal, to_light)) * MATTE_RADIANCE);
}

/// normal (normal world unit; = @normal_world): Shading normal.
/// albedo (color reflectance; = (0.8, 0.8, 0.8); 0..1): Share of light that is scattered back.
/// irradiance_harmonics (environment; = @environment_irradiance; hidden): Irradiance of the surroundings.
/// -> radiance (color radiance): Light of the surroundings that leaves towards the camera.
fn lambert_ambient(normal: vec3f, albedo: vec3f, irradiance_harmonics: array<vec4f, 9>) -> vec3f {
    return albedo * environment_irradiance(irradiance_harmonics, normal) * MATTE_RADIANCE;
}
