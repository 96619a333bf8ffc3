//! label: Translucent
//! category: surface
//! synonyms: leaf, paper, curtain, lampshade, backlit
//! use: microfacet, environment
//! A thin sheet that scatters light to both sides, like paper or a leaf.

/// irradiance (color irradiance): Light that arrives, measured facing the light.
/// to_light (direction world unit): Towards the light.
/// normal (normal world unit; = @normal_world): Shading normal.
/// albedo (color reflectance; = (0.7, 0.7, 0.6); 0..1): Share of light that is scattered, to both sides together.
/// transmission (scalar; = 0.5; 0..1): Part of the scattered light that leaves on the other side.
/// -> radiance (color radiance): Light that leaves towards the camera.
fn translucent(irradiance: vec3f, to_light: vec3f, normal: vec3f, albedo: vec3f, transmission: f32) -> vec3f {
    let cosine = clamp(dot(normal, to_light), -1.0, 1.0);
    let share = select(1.0 - saturate(transmission), saturate(transmission), cosine < 0.0);
    return albedo * irradiance * (abs(cosine) * share * MATTE_RADIANCE);
}

/// normal (normal world unit; = @normal_world): Shading normal.
/// albedo (color reflectance; = (0.7, 0.7, 0.6); 0..1): Share of light that is scattered, to both sides together.
/// transmission (scalar; = 0.5; 0..1): Part of the scattered light that leaves on the other side.
/// irradiance_harmonics (environment; = @environment_irradiance; hidden): Irradiance of the surroundings.
/// -> radiance (color radiance): Light of the surroundings that leaves towards the camera.
fn translucent_ambient(
    normal: vec3f,
    albedo: vec3f,
    transmission: f32,
    irradiance_harmonics: array<vec4f, 9>,
) -> vec3f {
    let near_side = environment_irradiance(irradiance_harmonics, normal);
    let far_side = environment_irradiance(irradiance_harmonics, -normal);
    return albedo * mix(near_side, far_side, saturate(transmission)) * MATTE_RADIANCE;
}
