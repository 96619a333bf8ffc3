//! label: Blinn-Phong
//! category: surface
//! synonyms: plastic, shiny, specular, phong, classic
//! use: microfacet, environment
//! Matte reflection under a highlight round the half vector (Blinn 1977), scaled so that a sharper highlight is brighter, not dimmer.
//! cheaper: kind lambert - The matte part alone.

/// irradiance (color irradiance): Light that arrives, measured facing the light.
/// to_light (direction world unit): Towards the light.
/// normal (normal world unit; = @normal_world): Shading normal.
/// to_camera (direction world unit; = @to_camera): Towards the eye.
/// albedo (color reflectance; = (0.6, 0.6, 0.6); 0..1): Share of light that is scattered back by the matte part.
/// specular (color reflectance; = (0.04, 0.04, 0.04); 0..1): Mirror reflectance seen straight on; 0.04 is plastic.
/// shininess (scalar; = 64; 1..): Exponent of the highlight; larger is sharper.
/// -> radiance (color radiance): Light that leaves towards the camera.
fn blinn_phong(
    irradiance: vec3f,
    to_light: vec3f,
    normal: vec3f,
    to_camera: vec3f,
    albedo: vec3f,
    specular: vec3f,
    shininess: f32,
) -> vec3f {
    let exponent = max(shininess, 1.0);
    let half = half_vector(to_light, to_camera);
    let fresnel = fresnel_schlick(specular, dot(half, to_light));
    // Exactly one over the integral of lobe times cosine, seen straight on, where it is largest: pi times
    // (e + 2) (e + 4) / (8 pi (2^(-e/2) + e)) (Giesen 2009, "Phong Normalization Factor derivations").
    let scale = (exponent + 2.0) * (exponent + 4.0) / (8.0 * (exp2(-0.5 * exponent) + exponent));
    let lobe = scale * pow(saturate(dot(normal, half)), exponent);
    let reflected = albedo * (1.0 - fresnel) + fresnel * lobe;
    return irradiance * reflected * (saturate(dot(normal, to_light)) * MATTE_RADIANCE);
}

/// normal (normal world unit; = @normal_world): Shading normal.
/// to_camera (direction world unit; = @to_camera): Towards the eye.
/// albedo (color reflectance; = (0.6, 0.6, 0.6); 0..1): Share of light that is scattered back by the matte part.
/// specular (color reflectance; = (0.04, 0.04, 0.04); 0..1): Mirror reflectance seen straight on; 0.04 is plastic.
/// shininess (scalar; = 64; 1..): Exponent of the highlight; larger is sharper.
/// irradiance_harmonics (environment; = @environment_irradiance; hidden): Irradiance of the surroundings.
/// environment (environment; = @environment; hidden): Image of the surroundings.
/// environment_sampler (sampler; = @environment_sampler; hidden): Reads that image.
/// environment_levels (number; = @environment_levels; hidden): Its roughest mip level.
/// -> radiance (color radiance): Light of the surroundings that leaves towards the camera.
fn blinn_phong_ambient(
    normal: vec3f,
    to_camera: vec3f,
    albedo: vec3f,
    specular: vec3f,
    shininess: f32,
    irradiance_harmonics: array<vec4f, 9>,
    environment: texture_2d<f32>,
    environment_sampler: sampler,
    environment_levels: f32,
) -> vec3f {
    // The GGX roughness of nearly the same lobe: alpha^2 = 2 / (e + 2) (Walter et al. 2007, section 5.2).
    let roughness = sqrt(sqrt(2.0 / (max(shininess, 1.0) + 2.0)));
    let response = environment_brdf(roughness, dot(normal, to_camera));
    let mirrored = specular * response.x + response.y;
    let direction = reflect(-to_camera, normal);
    let sharp = environment_radiance(environment, environment_sampler, environment_levels, direction, roughness);
    let matte = environment_irradiance(irradiance_harmonics, normal) * MATTE_RADIANCE;
    return albedo * (1.0 - mirrored) * matte + mirrored * sharp;
}
