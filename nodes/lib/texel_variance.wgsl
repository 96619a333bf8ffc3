//! use: light_space
//! How much depth varies inside one texel of a map that is being drawn.

/// Steepest surface, in metres of depth per metre across, whose slope is believed. Steeper ones are silhouettes, whose
/// triangles run through the whole scene within a texel.
const MAX_SLOPE: f32 = 8.0;

/// Variance of linear depth over one texel of a plane: (dx^2 + dy^2) / 12, of a box one texel wide (GPU Gems 3, chapter
/// 8, uses 1/4, of a Gaussian of half a texel). For fragment shaders of geometry passes; `in_light` in light coordinates.
fn texel_variance(space: LightSpace, in_light: vec3f) -> f32 {
    let ray = light_ray(space, in_light);
    let texel = fwidth(ray) * select(1.0, in_light.z, space.projection.z > 0.5);
    let steepest = texel * MAX_SLOPE;
    let change = vec2f(dpdx(in_light.z), dpdy(in_light.z));
    let bounded = clamp(change, -steepest, steepest) * space.depth.z;
    return dot(bounded, bounded) * (1.0 / 12.0);
}
