//! label: Clear coat
//! category: surface
//! synonyms: varnish, lacquer, car paint, polish, glaze, wet
//! use: microfacet, environment
//! A clear, colourless coat over another surface: its own highlight, and Fresnel losses for the light that enters to the base and leaves it again.
//! cheaper: input base - The surface without its coat.

/// base (color radiance): The surface under the coat.
/// irradiance (color irradiance): Light that arrives, measured facing the light.
/// to_light (direction world unit): Towards the light.
/// normal (normal world unit; = @normal_world): Shading normal.
/// to_camera (direction world unit; = @to_camera): Towards the eye.
/// strength (scalar; = 1; 0..1): Share of the surface that is coated.
/// roughness (scalar; = 0.05; 0..1): Of the coat: 0 polished, 1 matte.
/// ior (scalar; = 1.5; 1..): Index of refraction of the coat.
/// -> radiance (color radiance): Light that leaves towards the camera.
fn clear_coat(
    base: vec3f,
    irradiance: vec3f,
    to_light: vec3f,
    normal: vec3f,
    to_camera: vec3f,
    strength: f32,
    roughness: f32,
    ior: f32,
) -> vec3f {
    let n_dot_l = saturate(dot(normal, to_light));
    let n_dot_v = clamp(dot(normal, to_camera), 1e-4, 1.0);
    let half = half_vector(to_light, to_camera);
    let alpha = ggx_alpha(roughness);
    let facets = ggx_distribution(normal, half, alpha) * ggx_visibility(n_dot_l, n_dot_v, alpha);
    let coat = irradiance * (fresnel_dielectric(dot(half, to_light), ior) * facets * n_dot_l);
    let entered = (1.0 - fresnel_dielectric(n_dot_l, ior)) * (1.0 - fresnel_dielectric(n_dot_v, ior));
    return mix(base, base * entered + coat, saturate(strength));
}

/// base (color radiance): The surface under the coat.
/// normal (normal world unit; = @normal_world): Shading normal.
/// to_camera (direction world unit; = @to_camera): Towards the eye.
/// strength (scalar; = 1; 0..1): Share of the surface that is coated.
/// roughness (scalar; = 0.05; 0..1): Of the coat: 0 polished, 1 matte.
/// ior (scalar; = 1.5; 1..): Index of refraction of the coat.
/// environment (environment; = @environment; hidden): Image of the surroundings.
/// environment_sampler (sampler; = @environment_sampler; hidden): Reads that image.
/// environment_levels (number; = @environment_levels; hidden): Its roughest mip level.
/// -> radiance (color radiance): Light of the surroundings that leaves towards the camera.
fn clear_coat_ambient(
    base: vec3f,
    normal: vec3f,
    to_camera: vec3f,
    strength: f32,
    roughness: f32,
    ior: f32,
    environment: texture_2d<f32>,
    environment_sampler: sampler,
    environment_levels: f32,
) -> vec3f {
    let at_normal = normal_reflectance(ior);
    let n_dot_v = saturate(dot(normal, to_camera));
    let response = environment_brdf(roughness, n_dot_v);
    let mirrored = at_normal * response.x + response.y;
    let direction = reflect(-to_camera, normal);
    let sharp = environment_radiance(environment, environment_sampler, environment_levels, direction, roughness);
    // Light enters from everywhere: the mean of Schlick's Fresnel over the hemisphere is F0 + (1 - F0) / 21.
    let lost_entering = at_normal + (1.0 - at_normal) / 21.0;
    let entered = (1.0 - lost_entering) * (1.0 - mirrored);
    return mix(base, base * entered + mirrored * sharp, saturate(strength));
}
