//! Light from the surroundings: an equirectangular image whose mip levels are ever rougher, and the spherical harmonics of its irradiance.

/// Place of a unit direction on an equirectangular image: -z in the middle, +x to its right, +y at the top edge.
fn environment_uv(direction: vec3f) -> vec2f {
    // atan2 of two zeros is undefined: straight up and down count as forward.
    let pole = abs(direction.x) + abs(direction.z) < 1e-7;
    let turn = atan2(select(direction.x, 0.0, pole), select(-direction.z, 1.0, pole));
    return vec2f(0.5 + turn * 0.15915494, acos(clamp(direction.y, -1.0, 1.0)) * 0.31830987);
}

/// Radiance from a unit direction, averaged over the lobe of a surface of this roughness: level = roughness * last level.
fn environment_radiance(
    environment: texture_2d<f32>,
    environment_sampler: sampler,
    last_level: f32,
    direction: vec3f,
    roughness: f32,
) -> vec3f {
    let level = saturate(roughness) * last_level;
    return max(textureSampleLevel(environment, environment_sampler, environment_uv(direction), level).rgb, vec3f(0.0));
}

/// Irradiance on a surface with this unit normal: the sum of coefficient times real spherical harmonic, in the order
/// (l, m) = (0,0) (1,-1) (1,0) (1,1) (2,-2) (2,-1) (2,0) (2,1) (2,2). The coefficients are those of the irradiance, that
/// is, already multiplied by the cosine lobe's pi, 2 pi / 3, pi / 4 (Ramamoorthi and Hanrahan 2001, equations 3 and 11).
fn environment_irradiance(harmonics: array<vec4f, 9>, normal: vec3f) -> vec3f {
    let n = normal;
    let first = harmonics[0] + n.y * harmonics[1] + n.z * harmonics[2] + n.x * harmonics[3];
    let second = n.x * n.y * harmonics[4] + n.y * n.z * harmonics[5] + (3.0 * n.z * n.z - 1.0) * harmonics[6]
        + n.x * n.z * harmonics[7] + (n.x * n.x - n.y * n.y) * harmonics[8];
    return max((first + second).rgb, vec3f(0.0));
}
