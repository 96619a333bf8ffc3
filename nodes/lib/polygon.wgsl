//! Light from shining polygons.

/// Axes x, y, z of a light's own frame: z along `direction` (any length), y as near to up as can be. Where the direction is
/// straight up or down, -z or +z of the world takes the place of up.
fn axes_along(direction: vec3f) -> mat3x3f {
    let square = dot(direction, direction);
    let axis = select(direction * inverseSqrt(max(square, 1e-30)), vec3f(0.0, -1.0, 0.0), square < 1e-30);
    let flat_up = vec3f(0.0, 0.0, select(1.0, -1.0, axis.y > 0.0));
    let up = select(vec3f(0.0, 1.0, 0.0), flat_up, abs(axis.y) > 0.9999);
    let x = normalize(cross(up, axis));
    return mat3x3f(x, cross(axis, x), axis);
}

/// The share of an edge from corner `a` to corner `b`, both seen from the point: the angle that it is seen under, along
/// the normal of the plane through it and the point. Written with the edge itself, whose cross product rounds least.
fn edge_irradiance(a: vec3f, b: vec3f) -> vec3f {
    let normal = cross(a, b - a);
    let size = length(normal);
    let angle = atan2(size, dot(a, b));
    return normal * (angle / max(size, 1e-30));
}

/// Irradiance as a vector, per radiance, from a rectangle with its middle at `middle` (seen from the point) and these half
/// axes: half the sum over its edges of the angle each is seen under, along the normal of the plane to it (Lambert 1760;
/// Arvo 1995, "Analytic Methods for Simulated Light Transport", section 4). Its product with a normal that sees all of
/// the rectangle is the irradiance there. Towards the light in front of it, where cross(half_x, half_y) points.
fn rectangle_irradiance(middle: vec3f, half_x: vec3f, half_y: vec3f) -> vec3f {
    let a = middle - half_x - half_y;
    let b = middle + half_x - half_y;
    let c = middle + half_x + half_y;
    let d = middle - half_x + half_y;
    return 0.5 * (edge_irradiance(b, a) + edge_irradiance(c, b) + edge_irradiance(d, c) + edge_irradiance(a, d));
}
