//! label: Oren-Nayar
//! category: surface
//! synonyms: matte, clay, rough diffuse, plaster, moon
//! use: microfacet, environment
//! Matte reflection from a surface of rough facets: flatter than Lambert, brighter towards the light (Oren and Nayar 1994).
//! option order: qualitative | full = qualitative - Which model of the paper: equation 30, or equations 27 to 29 with light that bounces between facets.
//! cheaper: option order = full > qualitative - The simpler model of the paper.
//! cheaper: kind lambert - Facets laid flat.

/// irradiance (color irradiance): Light that arrives, measured facing the light.
/// to_light (direction world unit): Towards the light.
/// normal (normal world unit; = @normal_world): Shading normal.
/// to_camera (direction world unit; = @to_camera): Towards the eye.
/// albedo (color reflectance; = (0.8, 0.8, 0.8); 0..1): Share of light that is scattered back.
/// roughness (scalar; = 0.5; 0..1): Spread of facet slopes: standard deviation of their angle in radians.
/// -> radiance (color radiance): Light that leaves towards the camera.
fn oren_nayar(
    irradiance: vec3f,
    to_light: vec3f,
    normal: vec3f,
    to_camera: vec3f,
    albedo: vec3f,
    roughness: f32,
) -> vec3f {
    let n_dot_l = saturate(dot(normal, to_light));
    let n_dot_v = clamp(dot(normal, to_camera), 1e-4, 1.0);
    let variance = roughness * roughness;
    let sines = sqrt(max((1.0 - n_dot_l * n_dot_l) * (1.0 - n_dot_v * n_dot_v), 0.0));
    // Cosine between light and camera, both laid down into the surface.
    let azimuth = clamp((dot(to_light, to_camera) - n_dot_l * n_dot_v) / max(sines, 1e-6), -1.0, 1.0);
//#if order == qualitative
    let base = 1.0 - 0.5 * variance / (variance + 0.33);
    let towards_light = 0.45 * variance / (variance + 0.09);
    // sin(larger angle) tan(smaller angle) is the product of the sines over the larger cosine.
    let lobe = max(azimuth, 0.0) * sines / max(n_dot_l, n_dot_v);
    // Seen at the horizon, even light returns base + towards_light / 2 of itself, 1% too much for little roughness.
    let reflected = (base + towards_light * lobe) / max(base + 0.5 * towards_light, 1.0);
    return albedo * irradiance * (n_dot_l * MATTE_RADIANCE * reflected);
//#else
    let light_angle = acos(n_dot_l);
    let camera_angle = acos(n_dot_v);
    let alpha = max(light_angle, camera_angle);
    let beta = min(light_angle, camera_angle);
    let beta_share = beta * 2.0 * MATTE_RADIANCE;
    let mid = 0.09 + variance;
    let c1 = 1.0 - 0.5 * variance / (variance + 0.33);
    let away = select(0.0, beta_share * beta_share * beta_share, azimuth < 0.0);
    let c2 = 0.45 * variance / mid * (sin(alpha) - away);
    let both = 4.0 * alpha * beta * MATTE_RADIANCE * MATTE_RADIANCE;
    let c3 = 0.125 * variance / mid * both * both;
    // Both angles at the horizon would give an infinite tangent.
    let middle_tangent = tan(min(0.5 * (alpha + beta), 1.5));
    let single = c1 + azimuth * c2 * tan(min(beta, 1.5)) + (1.0 - abs(azimuth)) * c3 * middle_tangent;
    let c4 = 0.17 * variance / (variance + 0.13);
    let bounced = c4 * (1.0 - azimuth * beta_share * beta_share);
    let reflected = albedo * max(single, 0.0) + albedo * albedo * bounced;
    // Seen at the horizon, the model returns up to this share of even light (0.156: numeric integral), 4% too much.
    let most = c1 + 0.156 * variance / mid + c4;
    return irradiance * reflected * (n_dot_l * MATTE_RADIANCE / max(most, 1.0));
//#end
}

/// normal (normal world unit; = @normal_world): Shading normal.
/// albedo (color reflectance; = (0.8, 0.8, 0.8); 0..1): Share of light that is scattered back.
/// roughness (scalar; = 0.5; 0..1): Spread of facet slopes: standard deviation of their angle in radians.
/// irradiance_harmonics (environment; = @environment_irradiance; hidden): Irradiance of the surroundings.
/// -> radiance (color radiance): Light of the surroundings that leaves towards the camera.
fn oren_nayar_ambient(
    normal: vec3f,
    albedo: vec3f,
    roughness: f32,
    irradiance_harmonics: array<vec4f, 9>,
) -> vec3f {
    // Even surroundings see the base term alone, plus about an eighth of the lobe.
    let variance = roughness * roughness;
    let share = 1.0 - 0.5 * variance / (variance + 0.33) + 0.125 * 0.45 * variance / (variance + 0.09);
    return albedo * environment_irradiance(irradiance_harmonics, normal) * (share * MATTE_RADIANCE);
}
