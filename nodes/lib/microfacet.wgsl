//! Reflection at rough and smooth interfaces: facet distribution, masking, Fresnel, and their integral over even surroundings.

/// 1 / pi: the radiance of a perfectly white matte surface under unit irradiance.
const MATTE_RADIANCE: f32 = 0.31830987;

/// Vector half way between two unit vectors; zero where they are opposite.
fn half_vector(a: vec3f, b: vec3f) -> vec3f {
    let sum = a + b;
    return sum * inverseSqrt(max(dot(sum, sum), 1e-12));
}

/// Roughness as people set it (0..1) to the alpha of the distribution, its square (Burley 2012, section 5.4). The lower
/// end stays wide enough for lights without size to be seen.
fn ggx_alpha(roughness: f32) -> f32 {
    let bounded = clamp(roughness, 0.045, 1.0);
    return bounded * bounded;
}

/// Facet distribution GGX (Walter et al. 2007, equation 33), per steradian. The sine comes from the cross product, which
/// keeps sharp highlights free of rounding.
fn ggx_distribution(normal: vec3f, half: vec3f, alpha: f32) -> f32 {
    let cosine = max(dot(normal, half), 0.0);
    let sine = cross(normal, half);
    let spread = (cosine * alpha) * (cosine * alpha) + dot(sine, sine);
    let root = alpha / max(spread, 1e-8);
    return select(0.0, root * root * MATTE_RADIANCE, cosine > 0.0);
}

/// Masking and shadowing of GGX facets over 4 (n.l) (n.v), height-correlated (Heitz 2014, equation 99).
fn ggx_visibility(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    let square = alpha * alpha;
    let from_light = n_dot_v * sqrt(square + (1.0 - square) * n_dot_l * n_dot_l);
    let from_camera = n_dot_l * sqrt(square + (1.0 - square) * n_dot_v * n_dot_v);
    return 0.5 / max(from_light + from_camera, 1e-6);
}

/// Reflectance at normal incidence of an interface with air.
fn normal_reflectance(ior: f32) -> f32 {
    let ratio = (ior - 1.0) / (max(ior, 0.0) + 1.0);
    return ratio * ratio;
}

/// Fresnel reflectance after Schlick 1994, equation 15.
fn fresnel_schlick(at_normal: vec3f, cosine: f32) -> vec3f {
    let grazing = 1.0 - saturate(cosine);
    let square = grazing * grazing;
    return at_normal + (1.0 - at_normal) * (square * square * grazing);
}

/// Exact Fresnel reflectance of a dielectric for unpolarised light that arrives from the side of air. `ior` is the index
/// inside over that outside; below 1 there is total reflection.
fn fresnel_dielectric(cosine: f32, ior: f32) -> f32 {
    let eta = max(ior, 1e-3);
    let c = saturate(cosine);
    let inside_square = 1.0 - (1.0 - c * c) / (eta * eta);
    let inside = sqrt(max(inside_square, 0.0));
    let across = (c - eta * inside) / max(c + eta * inside, 1e-6);
    let along = (eta * c - inside) / max(eta * c + inside, 1e-6);
    return select(saturate(0.5 * (across * across + along * along)), 1.0, inside_square <= 0.0);
}

/// What a GGX surface reflects of surroundings of even brightness: x times the reflectance at normal incidence plus y
/// (the split sum of Karis 2013, "Real Shading in Unreal Engine 4"). A rational fit to the integral of the functions
/// above, so that ambient and direct light agree; it is off by 0.012 (rms) and by 0.06 at most.
fn environment_brdf(roughness: f32, n_dot_v: f32) -> vec2f {
    let r = saturate(roughness);
    let m = saturate(n_dot_v);
    let powers = vec3f(1.0, m, m * m);
    let loss = vec3f(
        dot(powers, vec3f(0.1843, 0.8889, -2.4358)),
        dot(powers, vec3f(-0.5612, 0.5383, 4.5730)),
        dot(powers, vec3f(0.4168, -0.3580, -2.1897)),
    );
    let lost = r * r * dot(loss, vec3f(1.0, r, r * r)) / (m + 0.5 * r * r + 0.02);
    let grazing = 1.0 - m;
    let fifth = grazing * grazing * grazing * grazing * grazing;
    let at_grazing = fifth * saturate(1.0288 + 0.5008 * m + r * (2.8817 * m - 0.9173)) / (1.0 + 8.0 * r * r);
    let share = saturate(1.0 - lost);
    return vec2f(max(share - at_grazing, 0.0), min(at_grazing, share));
}
