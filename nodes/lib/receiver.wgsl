//! use: light_space, unit_vectors
//! Receivers for comparisons that ask for no plane.

/// The plane through a point (light coordinates) that is equally deep everywhere: comparisons are then with the point.
fn facing_receiver(space: LightSpace, position: vec3f) -> ReceiverPlane {
    let axis = vec3f(space.world_to_light[0].z, space.world_to_light[1].z, space.world_to_light[2].z);
    return receiver_plane(space, position, axis);
}

/// By how much (light coordinates, metres) a point moves along its normal (world; any length, either side) to the side of
/// the light, so that a slope does not shadow itself within `texels` along a row of a map of `size`: a plane that is off
/// the light by an angle a rises by tan(a) per metre across, and moving by d along the normal takes a point d / cos(a)
/// nearer to the light.
fn receiver_offset(space: LightSpace, position: vec3f, normal: vec3f, size: vec2f, texels: f32) -> vec3f {
    let perspective = space.projection.z > 0.5;
    let n = unit_or_zero((space.world_to_light * vec4f(normal, 0.0)).xyz);
    let to_light = -unit_or_zero(select(vec3f(0.0, 0.0, 1.0), position, perspective));
    let cosine = dot(n, to_light);
    let sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    let texel = 2.0 / (space.projection.xy * size) * select(1.0, max(position.z, 0.0), perspective);
    return n * (select(1.0, -1.0, cosine < 0.0) * texels * max(texel.x, texel.y) * sine);
}

/// By how many texels of a map of `size` a point (light coordinates) and the one that is moved by `change` (world) lie apart:
/// a footprint that conditions of loops may depend on. Mesa 22.3's lavapipe crashes where those depend on a vector that a
/// uniform selects, as `light_map_change` does; the difference is known to some 1e-4 texel.
fn texel_change(space: LightSpace, position: vec3f, change: vec3f, size: vec2f) -> vec2f {
    let moved = position + (space.world_to_light * vec4f(change, 0.0)).xyz;
    return (light_map_uv(space, moved) - light_map_uv(space, position)) * size;
}

/// What z / w and radial depth are known to: two steps of float32 below 1, from the stored and from the compared value.
const METRIC_ROUNDING: f32 = 2.4e-7;

/// Where the light's ray through `uv` meets the plane (light coordinates), `margin` of linear depth nearer to the light.
fn receiver_nearer(space: LightSpace, plane: ReceiverPlane, uv: vec2f, margin: f32) -> vec3f {
    let there = receiver_position(space, plane, uv);
    let distance = there.z - margin / space.depth.z;
    // The ray runs through the light (perspective) or along its axis (parallel).
    let scale = select(1.0, distance / max(there.z, 1e-6), space.projection.z > 0.5);
    return vec3f(there.xy * scale, distance);
}

/// `receiver_depth_zw` with a margin of linear depth.
fn receiver_depth_zw_less(space: LightSpace, plane: ReceiverPlane, uv: vec2f, margin: f32) -> f32 {
    return saturate(light_depth_zw(space, receiver_nearer(space, plane, uv, margin))) - METRIC_ROUNDING;
}

/// `receiver_depth_radial` with a margin of linear depth.
fn receiver_depth_radial_less(space: LightSpace, plane: ReceiverPlane, uv: vec2f, margin: f32) -> f32 {
    return saturate(light_depth_radial(space, receiver_nearer(space, plane, uv, margin))) - METRIC_ROUNDING;
}

/// By how much of the range of depth an occluder must be nearer to the light than the plane of the receiver.
struct ReceiverMargin {
    /// Everywhere.
    here: f32,
    /// For each texel between the shaded point and the compared texel.
    per_texel: f32,
}

/// What rounding, the facets of curved surfaces and a bias (metres) ask for. Unlike a margin for the whole kernel, one that
/// grows with distance lets wide kernels see occluders that are near to the receiver.
fn receiver_margin(space: LightSpace, plane: ReceiverPlane, map: texture_depth_2d_array, bias: f32) -> ReceiverMargin {
    let size = vec2f(textureDimensions(map));
    let rounding = receiver_rounding(receiver_slope(space, plane) / size);
    return ReceiverMargin(bias * space.depth.z + rounding, receiver_curvature(space, plane, size, 1.0));
}

/// The margin of a kernel that reaches this many texels, the same everywhere in it: facets that meet near the shaded point
/// may then do so at larger angles.
fn margin_within(margin: ReceiverMargin, texels: f32) -> ReceiverMargin {
    return ReceiverMargin(margin.here + margin.per_texel * texels, 0.0);
}

/// Depth to compare with the texel whose centre is at `uv`.
fn compared_depth(space: LightSpace, plane: ReceiverPlane, size: vec2f, uv: vec2f, margin: ReceiverMargin) -> f32 {
    let away = length((uv - plane.uv) * size);
    return receiver_depth(space, plane, uv) - margin.here - margin.per_texel * away;
}

/// 1 where the plane is lit at the texel that `uv` falls into, else 0. What lies beyond the map is as its edge.
fn compare_nearest(
    space: LightSpace,
    plane: ReceiverPlane,
    map: texture_depth_2d_array,
    map_sampler: sampler_comparison,
    uv: vec2f,
    margin: ReceiverMargin,
) -> f32 {
    let size = vec2f(textureDimensions(map));
    let center = (clamp(floor(uv * size), vec2f(0.0), size - 1.0) + 0.5) / size;
    let depth = compared_depth(space, plane, size, center, margin);
    return textureSampleCompareLevel(map, map_sampler, center, light_layer(space), depth);
}

/// The lit shares of the four texels around `uv`, each compared with the plane at its centre, blended.
fn compare_bilinear(
    space: LightSpace,
    plane: ReceiverPlane,
    map: texture_depth_2d_array,
    map_sampler: sampler_comparison,
    uv: vec2f,
    margin: ReceiverMargin,
) -> f32 {
    let size = vec2f(textureDimensions(map));
    let corner = uv * size - 0.5;
    let low = (floor(corner) + 0.5) / size;
    let part = fract(corner);
    let lit_00 = compare_nearest(space, plane, map, map_sampler, low, margin);
    let lit_10 = compare_nearest(space, plane, map, map_sampler, low + vec2f(1.0, 0.0) / size, margin);
    let lit_01 = compare_nearest(space, plane, map, map_sampler, low + vec2f(0.0, 1.0) / size, margin);
    let lit_11 = compare_nearest(space, plane, map, map_sampler, low + 1.0 / size, margin);
    return mix(mix(lit_00, lit_10, part.x), mix(lit_01, lit_11, part.x), part.y);
}

/// The same by a sampler that filters. It compares one depth with four texels, whose centres lie up to a texel to each
/// side: the depth is taken a texel away, where the plane is nearest to the light.
fn compare_blended(
    space: LightSpace,
    plane: ReceiverPlane,
    map: texture_depth_2d_array,
    blending_sampler: sampler_comparison,
    uv: vec2f,
    margin: ReceiverMargin,
) -> f32 {
    let size = vec2f(textureDimensions(map));
    let inside = clamp(uv, 0.5 / size, 1.0 - 0.5 / size);
    let depth = compared_depth(space, plane, size, inside + sign(plane.slope) / size, margin);
    return textureSampleCompareLevel(map, blending_sampler, inside, light_layer(space), depth);
}
