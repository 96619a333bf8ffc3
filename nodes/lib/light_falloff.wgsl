//! How the light of a point source thins out with distance and towards the edge of a cone.

/// xyz: unit vector from `point` to the light at `position` (up where they coincide); w: distance.
fn point_light_ray(point: vec3f, position: vec3f) -> vec4f {
    let offset = position - point;
    let distance = length(offset);
    return vec4f(select(offset / max(distance, 1e-6), vec3f(0.0, 1.0, 0.0), distance < 1e-6), distance);
}

/// Irradiance facing a source of unit intensity; held finite within 1 mm.
fn inverse_square(distance: f32) -> f32 {
    return 1.0 / max(distance * distance, 1e-6);
}

/// 1 inside the inner angle, 0 outside the outer angle (radians from the axis), smooth in the cosine between.
fn cone_falloff(cosine: f32, inner_angle: f32, outer_angle: f32) -> f32 {
    let outer = cos(outer_angle);
    let inner = max(cos(min(inner_angle, outer_angle)), outer + 1e-4);
    return smoothstep(outer, inner, cosine);
}
