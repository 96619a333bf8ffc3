//! label: Glass
//! category: surface
//! synonyms: dielectric, transparent, refraction, water, crystal, window
//! use: microfacet, environment
//! Clear or frosted glass: exact Fresnel shares of the surroundings mirrored and refracted, and a highlight of each light. It shows the environment through itself, not other objects.
//! option body: solid | thin = solid - A solid bends what is seen through its front; a thin sheet passes it straight and mirrors on both sides.

/// irradiance (color irradiance): Light that arrives, measured facing the light.
/// to_light (direction world unit): Towards the light.
/// normal (normal world unit; = @normal_world): Shading normal.
/// to_camera (direction world unit; = @to_camera): Towards the eye.
/// ior (scalar; = 1.5; 1..): Index of refraction: 1.33 water, 1.5 window glass, 2.4 diamond.
/// roughness (scalar; = 0; 0..1): 0 clear, 1 frosted.
/// -> radiance (color radiance): Light that leaves towards the camera.
fn glass(
    irradiance: vec3f,
    to_light: vec3f,
    normal: vec3f,
    to_camera: vec3f,
    ior: f32,
    roughness: f32,
) -> vec3f {
    let n_dot_l = saturate(dot(normal, to_light));
    let n_dot_v = clamp(dot(normal, to_camera), 1e-4, 1.0);
    let half = half_vector(to_light, to_camera);
    let alpha = ggx_alpha(roughness);
    let front = fresnel_dielectric(dot(half, to_light), ior);
//#if body == solid
    let fresnel = front;
//#else
    // Light that bounces to and fro between two parallel faces adds up to 2 F / (1 + F).
    let fresnel = 2.0 * front / (1.0 + front);
//#end
    let facets = ggx_distribution(normal, half, alpha) * ggx_visibility(n_dot_l, n_dot_v, alpha);
    return irradiance * (fresnel * facets * n_dot_l);
}

/// normal (normal world unit; = @normal_world): Shading normal.
/// to_camera (direction world unit; = @to_camera): Towards the eye.
/// tint (color; = (0.97, 0.99, 0.98); 0..1): Colour of the light that goes through.
/// ior (scalar; = 1.5; 1..): Index of refraction: 1.33 water, 1.5 window glass, 2.4 diamond.
/// roughness (scalar; = 0; 0..1): 0 clear, 1 frosted.
/// environment (environment; = @environment; hidden): Image of the surroundings.
/// environment_sampler (sampler; = @environment_sampler; hidden): Reads that image.
/// environment_levels (number; = @environment_levels; hidden): Its roughest mip level.
/// -> radiance (color radiance): Light of the surroundings that leaves towards the camera.
fn glass_ambient(
    normal: vec3f,
    to_camera: vec3f,
    tint: vec3f,
    ior: f32,
    roughness: f32,
    environment: texture_2d<f32>,
    environment_sampler: sampler,
    environment_levels: f32,
) -> vec3f {
    let front = fresnel_dielectric(dot(normal, to_camera), ior);
    let mirror = reflect(-to_camera, normal);
//#if body == solid
    let fresnel = front;
    let through = refract(-to_camera, normal, 1.0 / max(ior, 1.0));
//#else
    // Light that bounces to and fro between two parallel faces adds up to 2 F / (1 + F).
    let fresnel = 2.0 * front / (1.0 + front);
    let through = -to_camera;
//#end
    let mirrored = environment_radiance(environment, environment_sampler, environment_levels, mirror, roughness);
    let passed = environment_radiance(environment, environment_sampler, environment_levels, through, roughness);
    return mix(tint * passed, mirrored, fresnel);
}
