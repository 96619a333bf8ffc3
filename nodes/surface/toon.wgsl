//! label: Toon
//! category: surface
//! synonyms: cel, cartoon, comic, anime, banded
//! use: microfacet, environment
//! Matte light in even bands with soft edges, and a rim of light along the outline on the lit side.

/// irradiance (color irradiance): Light that arrives, measured facing the light.
/// to_light (direction world unit): Towards the light.
/// normal (normal world unit; = @normal_world): Shading normal.
/// to_camera (direction world unit; = @to_camera): Towards the eye.
/// albedo (color reflectance; = (0.8, 0.8, 0.8); 0..1): Share of light that is scattered back.
/// steps (scalar; = 3; 1..): Bands between dark and bright.
/// softness (scalar; = 0.08; 0..1): Width of the edge between bands, as part of a band.
/// rim_color (color reflectance; = (0.6, 0.6, 0.6); 0..): Strength of the rim, as part of white.
/// rim_width (scalar; = 0.3; 0..1): How far the rim reaches in from the outline; 0 for none.
/// -> radiance (color radiance): Light that leaves towards the camera.
fn toon(
    irradiance: vec3f,
    to_light: vec3f,
    normal: vec3f,
    to_camera: vec3f,
    albedo: vec3f,
    steps: f32,
    softness: f32,
    rim_color: vec3f,
    rim_width: f32,
) -> vec3f {
    let n_dot_l = saturate(dot(normal, to_light));
    let bands = max(round(steps), 1.0);
    let edge = clamp(0.5 * softness, 1e-3, 0.5);
    let place = n_dot_l * bands;
    // Bands round to the nearest step, so their average is the light of a matte surface.
    let level = (floor(place) + smoothstep(0.5 - edge, 0.5 + edge, fract(place))) / bands;
    let outline = 1.0 - saturate(dot(normal, to_camera));
    let start = 1.0 - clamp(rim_width, 0.0, 1.0);
    let rim = smoothstep(start - edge * 0.5, start + edge * 0.5, outline) * smoothstep(0.0, edge, n_dot_l);
    let rim_share = select(0.0, rim, rim_width > 0.0);
    return irradiance * (albedo * level + rim_color * rim_share) * MATTE_RADIANCE;
}

/// normal (normal world unit; = @normal_world): Shading normal.
/// albedo (color reflectance; = (0.8, 0.8, 0.8); 0..1): Share of light that is scattered back.
/// irradiance_harmonics (environment; = @environment_irradiance; hidden): Irradiance of the surroundings.
/// -> radiance (color radiance): Light of the surroundings that leaves towards the camera.
fn toon_ambient(normal: vec3f, albedo: vec3f, irradiance_harmonics: array<vec4f, 9>) -> vec3f {
    return albedo * environment_irradiance(irradiance_harmonics, normal) * MATTE_RADIANCE;
}
