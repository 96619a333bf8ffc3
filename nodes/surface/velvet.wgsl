//! label: Velvet
//! category: surface
//! synonyms: cloth, fabric, sheen, fuzz, felt
//! use: microfacet, environment
//! Cloth with fibres that stand up and shine along the outline: the sheen distribution of Estevez and Kulla 2017 with the visibility of Neubelt and Pettineo 2013, over a matte base.
//! cheaper: kind lambert - Cloth without its shine.

/// irradiance (color irradiance): Light that arrives, measured facing the light.
/// to_light (direction world unit): Towards the light.
/// normal (normal world unit; = @normal_world): Shading normal.
/// to_camera (direction world unit; = @to_camera): Towards the eye.
/// albedo (color reflectance; = (0.35, 0.05, 0.1); 0..1): Colour of the cloth itself.
/// sheen (color reflectance; = (0.6, 0.5, 0.5); 0..1): Strength of the shine at the outline.
/// roughness (scalar; = 0.4; 0.2..1): Disorder of the fibres; smaller keeps the shine nearer to the outline.
/// -> radiance (color radiance): Light that leaves towards the camera.
fn velvet(
    irradiance: vec3f,
    to_light: vec3f,
    normal: vec3f,
    to_camera: vec3f,
    albedo: vec3f,
    sheen: vec3f,
    roughness: f32,
) -> vec3f {
    let n_dot_l = saturate(dot(normal, to_light));
    let n_dot_v = clamp(dot(normal, to_camera), 1e-4, 1.0);
    let half = half_vector(to_light, to_camera);
    let sine = min(length(cross(normal, half)), 1.0);
    let power = 1.0 / clamp(roughness, 0.2, 1.0);
    let fibres = (2.0 + power) * 0.5 * MATTE_RADIANCE * pow(sine, power);
    let lobe = fibres * 0.25 / max(n_dot_l + n_dot_v - n_dot_l * n_dot_v, 1e-4);
    let strongest = max(sheen.r, max(sheen.g, sheen.b));
    let matte = albedo * ((1.0 - saturate(strongest)) * MATTE_RADIANCE);
    return irradiance * (matte + sheen * lobe) * n_dot_l;
}

/// normal (normal world unit; = @normal_world): Shading normal.
/// to_camera (direction world unit; = @to_camera): Towards the eye.
/// albedo (color reflectance; = (0.35, 0.05, 0.1); 0..1): Colour of the cloth itself.
/// sheen (color reflectance; = (0.6, 0.5, 0.5); 0..1): Strength of the shine at the outline.
/// roughness (scalar; = 0.4; 0.2..1): Disorder of the fibres; smaller keeps the shine nearer to the outline.
/// irradiance_harmonics (environment; = @environment_irradiance; hidden): Irradiance of the surroundings.
/// -> radiance (color radiance): Light of the surroundings that leaves towards the camera.
fn velvet_ambient(
    normal: vec3f,
    to_camera: vec3f,
    albedo: vec3f,
    sheen: vec3f,
    roughness: f32,
    irradiance_harmonics: array<vec4f, 9>,
) -> vec3f {
    // Share of even surroundings that the fibres return, fitted to a numeric integral of the lobe (within 0.04).
    let power = 1.0 / clamp(roughness, 0.2, 1.0);
    let n_dot_v = saturate(dot(normal, to_camera));
    let returned = (0.53 + 0.088 * power) * exp(-(1.1 + 0.43 * power) * n_dot_v);
    let strongest = max(sheen.r, max(sheen.g, sheen.b));
    let share = albedo * (1.0 - saturate(strongest)) + sheen * returned;
    return share * environment_irradiance(irradiance_harmonics, normal) * MATTE_RADIANCE;
}
