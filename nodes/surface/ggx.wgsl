//! label: Metallic-roughness
//! category: surface
//! synonyms: pbr, ggx, physically based, metal, plastic, principled, cook-torrance
//! use: microfacet, environment
//! Metals and plastics: GGX facets (Walter et al. 2007) with height-correlated masking (Heitz 2014) and Schlick's Fresnel over a matte base. Light that bounces between facets is lost: 69% at most, for a white metal of roughness 1 seen straight on.
//! cheaper: kind blinn_phong(albedo = base_color * (1 - metallic), specular = ((ior - 1) / (ior + 1))^2 * (1 - metallic) + base_color * metallic, shininess = 2 / roughness^4 - 2) - A highlight of the same width without masking.
//! cheaper: kind lambert(albedo = base_color) - The matte part alone, as bright as the whole.

/// irradiance (color irradiance): Light that arrives, measured facing the light.
/// to_light (direction world unit): Towards the light.
/// normal (normal world unit; = @normal_world): Shading normal.
/// to_camera (direction world unit; = @to_camera): Towards the eye.
/// base_color (color reflectance; = (0.8, 0.8, 0.8); 0..1): Albedo of the matte part, or mirror colour of a metal.
/// metallic (scalar; = 0; 0..1): 0 for insulators, 1 for metals.
/// roughness (scalar; = 0.4; 0..1): 0 polished, 1 matte; its square is the width of the facet distribution.
/// ior (scalar; = 1.5; 1..): Index of refraction of the insulator.
/// -> radiance (color radiance): Light that leaves towards the camera.
fn ggx(
    irradiance: vec3f,
    to_light: vec3f,
    normal: vec3f,
    to_camera: vec3f,
    base_color: vec3f,
    metallic: f32,
    roughness: f32,
    ior: f32,
) -> vec3f {
    let n_dot_l = saturate(dot(normal, to_light));
    let n_dot_v = clamp(dot(normal, to_camera), 1e-4, 1.0);
    let half = half_vector(to_light, to_camera);
    let alpha = ggx_alpha(roughness);
    let insulator = vec3f(normal_reflectance(ior));
    let fresnel = fresnel_schlick(mix(insulator, base_color, metallic), dot(half, to_light));
    let facets = ggx_distribution(normal, half, alpha) * ggx_visibility(n_dot_l, n_dot_v, alpha);
    // What goes into the base is what the interface lets through on the way in and on the way out.
    let entered = (1.0 - fresnel_schlick(insulator, n_dot_l)) * (1.0 - fresnel_schlick(insulator, n_dot_v));
    let matte = base_color * entered * ((1.0 - metallic) * MATTE_RADIANCE);
    return irradiance * (fresnel * facets + matte) * n_dot_l;
}

/// normal (normal world unit; = @normal_world): Shading normal.
/// to_camera (direction world unit; = @to_camera): Towards the eye.
/// base_color (color reflectance; = (0.8, 0.8, 0.8); 0..1): Albedo of the matte part, or mirror colour of a metal.
/// metallic (scalar; = 0; 0..1): 0 for insulators, 1 for metals.
/// roughness (scalar; = 0.4; 0..1): 0 polished, 1 matte; its square is the width of the facet distribution.
/// ior (scalar; = 1.5; 1..): Index of refraction of the insulator.
/// irradiance_harmonics (environment; = @environment_irradiance; hidden): Irradiance of the surroundings.
/// environment (environment; = @environment; hidden): Image of the surroundings.
/// environment_sampler (sampler; = @environment_sampler; hidden): Reads that image.
/// environment_levels (number; = @environment_levels; hidden): Its roughest mip level.
/// -> radiance (color radiance): Light of the surroundings that leaves towards the camera.
fn ggx_ambient(
    normal: vec3f,
    to_camera: vec3f,
    base_color: vec3f,
    metallic: f32,
    roughness: f32,
    ior: f32,
    irradiance_harmonics: array<vec4f, 9>,
    environment: texture_2d<f32>,
    environment_sampler: sampler,
    environment_levels: f32,
) -> vec3f {
    let n_dot_v = saturate(dot(normal, to_camera));
    let at_normal = mix(vec3f(normal_reflectance(ior)), base_color, metallic);
    let response = environment_brdf(roughness, n_dot_v);
    let mirrored = at_normal * response.x + response.y;
    let direction = reflect(-to_camera, normal);
    let sharp = environment_radiance(environment, environment_sampler, environment_levels, direction, roughness);
    let matte = environment_irradiance(irradiance_harmonics, normal) * MATTE_RADIANCE;
    return base_color * (1.0 - metallic) * (1.0 - mirrored) * matte + mirrored * sharp;
}
