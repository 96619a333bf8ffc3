//! use: light_space
//! What takes the place of the functions of light_space where a light warps its map (light-space perspective shadow maps: Wimmer, Scherzer and Purgathofer 2004): each name without `_warped`. The flat map is the unwarped one; the warp is the plane perspective (x, y) -> (x, y + k) / (1 + k y) of its normalised coordinates, with k in warp.x, which spends texels on what lies at y = -1, near the eye. Rays stay straight, so depth is as before.

/// The plane of the surface that is shaded, ready to be met by the ray through any other place on the map.
struct ReceiverPlane_warped {
    /// Map coordinate of the shaded point.
    uv: vec2f,
    /// Distance of the shaded point along the light's axis, metres.
    distance: f32,
    /// Change over the whole flat map: of distance in metres (parallel) or of 1 / distance relative to here (perspective).
    slope: vec2f,
    /// Distance per metre across, at the shaded point.
    rise: vec2f,
    /// Flat map coordinate of the shaded point.
    flat_uv: vec2f,
}

/// Coordinates on the flat map, -1 to 1, y up, of a point in light coordinates.
fn light_flat(space: LightSpace, position: vec3f) -> vec2f {
    return light_ray(space, position) * space.projection.xy;
}

/// Flat map coordinate for a map coordinate.
fn light_flat_uv(space: LightSpace, uv: vec2f) -> vec2f {
    let k = space.warp.x;
    let ndc = (uv - 0.5) * vec2f(2.0, -2.0);
    let y = (ndc.y - k) / (1.0 - k * ndc.y);
    return vec2f(ndc.x * (1.0 + k * y), y) * vec2f(0.5, -0.5) + 0.5;
}

/// Change of flat map coordinates per change of u and of v, column by column, at a flat map coordinate.
fn light_flattening(space: LightSpace, flat_uv: vec2f) -> mat2x2f {
    let k = space.warp.x;
    let ndc = (flat_uv - 0.5) * vec2f(2.0, -2.0);
    let w = 1.0 + k * ndc.y;
    let stretch = w * w / (1.0 - k * k);
    return mat2x2f(w, 0.0, -k * ndc.x / w * stretch, stretch);
}

/// Map coordinate, (0, 0) at the upper left corner.
fn light_map_uv_warped(space: LightSpace, position: vec3f) -> vec2f {
    let flat = light_flat(space, position);
    let k = space.warp.x;
    return vec2f(flat.x, flat.y + k) / (1.0 + k * flat.y) * vec2f(0.5, -0.5) + 0.5;
}

/// Clip position for drawing a map. Clip depth only clips, at the near plane, and orders: all points of a ray have the
/// same warp, so dividing by it keeps their order.
fn light_clip_position_warped(space: LightSpace, position: vec3f) -> vec4f {
    let k = space.warp.x;
    let xy = position.xy * space.projection.xy;
    let along = select(1.0, position.z, space.projection.z > 0.5);
    let depth = select(light_linear_depth(space, position.z), position.z - space.depth.x, space.projection.z > 0.5);
    return vec4f(xy.x, xy.y + k * along, depth * (1.0 - abs(k)), along + k * xy.y);
}

/// Change of the map coordinate per pixel where the point (light coordinates) changes by `change` (world).
fn light_map_change_warped(space: LightSpace, position: vec3f, change: vec3f) -> vec2f {
    let moved = (space.world_to_light * vec4f(change, 0.0)).xyz;
    let perspective = (moved.xy - light_ray(space, position) * moved.z) / max(position.z, 1e-6);
    let flat = light_flat(space, position);
    let change_flat = select(moved.xy, perspective, space.projection.z > 0.5) * space.projection.xy;
    let k = space.warp.x;
    let w = 1.0 + k * flat.y;
    let x = (change_flat.x - flat.x / w * k * change_flat.y) / w;
    return vec2f(x, change_flat.y * (1.0 - k * k) / (w * w)) * vec2f(0.5, -0.5);
}

/// The plane through a point (light coordinates) with a geometric normal (world; any length, either side).
fn receiver_plane_warped(space: LightSpace, position: vec3f, normal: vec3f) -> ReceiverPlane_warped {
    let perspective = space.projection.z > 0.5;
    let n = (space.world_to_light * vec4f(normal, 0.0)).xyz;
    let ray = vec3f(select(vec2f(0.0), light_ray(space, position), perspective), 1.0);
    let facing = dot(n, ray);
    let least = MIN_RECEIVER_COSINE * length(n) * length(ray);
    let bounded = max(max(abs(facing), least), 1e-30) * select(1.0, -1.0, facing < 0.0);
    let slope = n.xy * vec2f(2.0, -2.0) / space.projection.xy / bounded;
    let flat_uv = light_flat(space, position) * vec2f(0.5, -0.5) + 0.5;
    return ReceiverPlane_warped(light_map_uv_warped(space, position), position.z, slope, n.xy / bounded, flat_uv);
}

/// Distance along the light's axis at which its ray through `uv` meets the plane.
fn receiver_distance_warped(space: LightSpace, plane: ReceiverPlane_warped, uv: vec2f) -> f32 {
    let moved = light_flat_uv(space, uv) - plane.flat_uv;
    let change = dot(plane.slope, moved);
    let parallel = plane.distance - change;
    let perspective = plane.distance / max(1.0 + change, 0.25);
    let is_perspective = space.projection.z > 0.5;
    let across = length(moved * 2.0 / space.projection.xy) * select(1.0, plane.distance, is_perspective);
    return min(select(parallel, perspective, is_perspective), plane.distance + MAX_RETREAT * across);
}

/// The same place in light coordinates.
fn receiver_position_warped(space: LightSpace, plane: ReceiverPlane_warped, uv: vec2f) -> vec3f {
    let distance = receiver_distance_warped(space, plane, uv);
    let ray = (light_flat_uv(space, uv) - 0.5) * vec2f(2.0, -2.0) / space.projection.xy;
    return vec3f(ray * select(1.0, distance, space.projection.z > 0.5), distance);
}

/// Size of the change of linear depth per unit of `uv` at the shaded point: |d depth/du|, |d depth/dv|.
fn receiver_slope_warped(space: LightSpace, plane: ReceiverPlane_warped) -> vec2f {
    let slope = plane.slope * light_flattening(space, plane.flat_uv);
    return abs(slope) * select(1.0, plane.distance, space.projection.z > 0.5) * space.depth.z;
}

/// Depth by which the facets around rise above the plane of the shaded one on a surface that curves towards the light,
/// `texels` away on a map of `size`.
fn receiver_curvature_warped(space: LightSpace, plane: ReceiverPlane_warped, size: vec2f, texels: f32) -> f32 {
    let flattening = light_flattening(space, plane.flat_uv);
    let across = vec2f(flattening[0].x, flattening[1].y) * 2.0 / (space.projection.xy * size);
    let texel = across * select(1.0, plane.distance, space.projection.z > 0.5);
    let steep = dot(plane.rise, plane.rise);
    return MAX_FOLD * min(1.0 + steep, MAX_FOLD_DEPTH) * texels * max(texel.x, texel.y) * space.depth.z;
}
