//! The space that a light's maps are made in: where a point lies in it, and how a receiving plane runs through it.

/// One view that a light has of the scene, filled by the host; 128 bytes. Lengths are metres.
struct LightSpace {
    /// Rigid: the light at the origin, looking along +z, +y up.
    world_to_light: mat4x4f,
    /// x, y: focal factors, ndc = projection.xy * light.xy / (perspective ? light.z : 1). z: 1 perspective, 0 parallel.
    /// w: layer of the light's maps that shows this view.
    projection: vec4f,
    /// x: near, y: far, z: 1 / (far - near). w: distance from the eye up to which this view is used.
    depth: vec4f,
    /// Half size of the shining surface along x and y: metres across the axis (perspective) or tangents of the angles that
    /// it is seen under (parallel). z: 1 an ellipse, 0 a rectangle. w: texels per metre here over those of the light's
    /// coarsest view.
    source: vec4f,
    /// x: strength of the warp, -1 to 1, where the light warps its map.
    warp: vec4f,
}

/// The plane of the surface that is shaded, ready to be met by the ray through any other place on the map.
struct ReceiverPlane {
    /// Map coordinate of the shaded point.
    uv: vec2f,
    /// Distance of the shaded point along the light's axis, metres.
    distance: f32,
    /// Change over the whole map: of distance in metres (parallel) or of 1 / distance relative to here (perspective).
    slope: vec2f,
    /// Distance per metre across, at the shaded point.
    rise: vec2f,
}

/// Steepest rise of a surface away from the light, in metres per metre across, that is followed beyond the shaded point
/// (82.9 degrees). Near an outline the plane ends within the kernel, and followed further it would run behind whatever
/// lies beyond, which would then seem to shadow it.
const MAX_RETREAT: f32 = 8.0;

/// A plane seen by the light at a smaller cosine than this (89.1 degrees) is treated as if seen at this cosine. Up to
/// there it is followed exactly towards the light; beyond, next to no light arrives that could show the difference.
const MIN_RECEIVER_COSINE: f32 = 0.015625;

/// Facets that meet at up to this angle (radians, 7 degrees: 51 around a circle) count as one curved surface, which does
/// not shadow itself. Seen by the light straight on, an occluder must for that be nearer by this part of the kernel's half
/// width; at grazing light by more, as one angle is more depth there, but no more than the shadow's edge is wide.
const MAX_FOLD: f32 = 0.125;
/// What grazing light multiplies that by at most: reached at 69 degrees.
const MAX_FOLD_DEPTH: f32 = 8.0;

/// A world point in light coordinates, metres.
fn light_position(space: LightSpace, point: vec3f) -> vec3f {
    return (space.world_to_light * vec4f(point, 1.0)).xyz;
}

/// 0 at the near plane, 1 at the far plane, linear in metres; not clamped. `distance` is light coordinate z.
fn light_linear_depth(space: LightSpace, distance: f32) -> f32 {
    return (distance - space.depth.x) * space.depth.z;
}

/// Depth of a point in light coordinates in the metric of `light_linear_depth`: along the axis, even in metres. Not clamped.
fn light_depth_linear(space: LightSpace, position: vec3f) -> f32 {
    return light_linear_depth(space, position.z);
}

/// Depth as projection matrices leave it, z / w: 0 at the near plane, 1 at the far plane, and most of the range spent close
/// to the near plane. The same as linear depth in parallel light. Not clamped.
fn light_depth_zw(space: LightSpace, position: vec3f) -> f32 {
    let linear = light_linear_depth(space, position.z);
    return linear * select(1.0, space.depth.y / max(position.z, 1e-6), space.projection.z > 0.5);
}

/// Depth by the distance from the light itself, in parts of its range: 1 on a sphere that touches the far plane. The same
/// on all faces of a cube. The same as linear depth in parallel light. Not clamped.
fn light_depth_radial(space: LightSpace, position: vec3f) -> f32 {
    let radial = length(position) / space.depth.y;
    return select(light_linear_depth(space, position.z), radial, space.projection.z > 0.5);
}

/// Change of `light_depth_zw` per change of linear depth along the light's ray: turns margins in linear depth into margins
/// in z / w. The metric itself is known to some 1e-7, which has to be added behind.
fn light_scale_zw(space: LightSpace, position: vec3f) -> f32 {
    let distance = max(position.z, space.depth.x);
    let scale = space.depth.x * space.depth.y / max(distance * distance, 1e-12);
    return select(1.0, scale, space.projection.z > 0.5);
}

/// Change of `light_depth_radial` per change of linear depth along the light's ray.
fn light_scale_radial(space: LightSpace, position: vec3f) -> f32 {
    let ray = length(vec3f(light_ray(space, position), 1.0));
    return select(1.0, ray / (space.depth.z * space.depth.y), space.projection.z > 0.5);
}

/// What ndc is proportional to: the direction of the ray (perspective) or the offset from the axis in metres (parallel).
fn light_ray(space: LightSpace, position: vec3f) -> vec2f {
    return position.xy / select(1.0, max(position.z, 1e-6), space.projection.z > 0.5);
}

/// Map coordinate, (0, 0) at the upper left corner.
fn light_map_uv(space: LightSpace, position: vec3f) -> vec2f {
    return light_ray(space, position) * space.projection.xy * vec2f(0.5, -0.5) + 0.5;
}

/// Clip position for drawing a map. Clip depth only clips, at the near plane, and orders; what is stored is
/// `light_linear_depth`. The far plane of a perspective does not clip: what lies beyond is drawn, too.
fn light_clip_position(space: LightSpace, position: vec3f) -> vec4f {
    let xy = position.xy * space.projection.xy;
    let perspective_z = position.z - space.depth.x;
    let parallel = vec4f(xy, light_linear_depth(space, position.z), 1.0);
    return select(parallel, vec4f(xy, perspective_z, position.z), space.projection.z > 0.5);
}

/// The layer of the light's maps that shows this view.
fn light_layer(space: LightSpace) -> i32 {
    return i32(space.projection.w);
}

/// Texels per metre along x and y of the map over those of the light's coarsest view (the root of x times y of that): what
/// a kernel's width is multiplied by to be as wide in metres in every view. Exactly 1 where there is one view and it is
/// square.
fn light_zoom(space: LightSpace) -> vec2f {
    let shape = sqrt(space.projection.x / space.projection.y);
    return max(space.source.w, 1.0) * vec2f(shape, 1.0 / shape);
}

/// Change of the map coordinate per pixel where the point (light coordinates) changes by `change` (world). Taken from the
/// point, which is continuous, and not from map coordinates, which jump where two pixels are seen by different views.
fn light_map_change(space: LightSpace, position: vec3f, change: vec3f) -> vec2f {
    let moved = (space.world_to_light * vec4f(change, 0.0)).xyz;
    let perspective = (moved.xy - light_ray(space, position) * moved.z) / max(position.z, 1e-6);
    let ray = select(moved.xy, perspective, space.projection.z > 0.5);
    return ray * space.projection.xy * vec2f(0.5, -0.5);
}

/// Which of the six views along +x, -x, +y, -y, +z, -z sees a world point. `first` is the one along +x, whose own axes
/// are -z, +y and +x of the world.
fn cube_view(first: LightSpace, point: vec3f) -> u32 {
    let seen = light_position(first, point);
    let offset = vec3f(seen.z, seen.y, -seen.x);
    let size = abs(offset);
    if (size.x >= size.y && size.x >= size.z) {
        return select(0u, 1u, offset.x < 0.0);
    }
    if (size.y >= size.z) {
        return select(2u, 3u, offset.y < 0.0);
    }
    return select(4u, 5u, offset.z < 0.0);
}

/// Share that the next split has at a distance from the eye: it takes over in the last tenth of `view`.
fn split_blend(view: LightSpace, distance: f32) -> f32 {
    return saturate(distance / view.depth.w * 10.0 - 9.0);
}

/// One split for the four pixels of a quad, so that differences within it are of one map (Lauritzen 2007): powers of two
/// can be told from their differences, whichever pixel asks. Quads with three or four different splits may stay split.
fn split_of_quad(split: u32) -> u32 {
    let power = f32(1u << split);
    let across = abs(dpdxFine(power));
    let down = abs(dpdyFine(power));
    let mixed = abs(dpdxFine(down));
    let most = u32(round(max(mixed, max(across, down))));
    return select(split, firstLeadingBit(most), most > 0u);
}

/// Whether the map knows nothing about a point: beside the map, or in front of its near plane.
fn outside_light_map(space: LightSpace, position: vec3f, uv: vec2f) -> bool {
    return position.z < space.depth.x || any(uv < vec2f(0.0)) || any(uv > vec2f(1.0));
}

/// The plane through a point (light coordinates) with a geometric normal (world; any length, either side).
fn receiver_plane(space: LightSpace, position: vec3f, normal: vec3f) -> ReceiverPlane {
    let perspective = space.projection.z > 0.5;
    let n = (space.world_to_light * vec4f(normal, 0.0)).xyz;
    // The ray through the point, scaled to one metre along the axis, so that n.ray = n.position / position.z.
    let ray = vec3f(select(vec2f(0.0), light_ray(space, position), perspective), 1.0);
    let facing = dot(n, ray);
    let least = MIN_RECEIVER_COSINE * length(n) * length(ray);
    // A normal of length zero says nothing about the plane: it counts as facing the light.
    let bounded = max(max(abs(facing), least), 1e-30) * select(1.0, -1.0, facing < 0.0);
    let ray_per_uv = vec2f(2.0, -2.0) / space.projection.xy;
    return ReceiverPlane(light_map_uv(space, position), position.z, n.xy * ray_per_uv / bounded, n.xy / bounded);
}

/// Distance along the light's axis at which its ray through `uv` meets the plane. Exact for both projections, up to the
/// bounds above: with plane n.p = n0, a perspective ray (a, b, 1) z meets it at z = n0 / (n.x a + n.y b + n.z), a parallel
/// one at z = (n0 - n.x a - n.y b) / n.z; both are written relative to the shaded point, where rounding is least.
fn receiver_distance(space: LightSpace, plane: ReceiverPlane, uv: vec2f) -> f32 {
    let change = dot(plane.slope, uv - plane.uv);
    let parallel = plane.distance - change;
    // Rays that run away along the plane are held within four times the distance.
    let perspective = plane.distance / max(1.0 + change, 0.25);
    let is_perspective = space.projection.z > 0.5;
    let across = length((uv - plane.uv) * 2.0 / space.projection.xy) * select(1.0, plane.distance, is_perspective);
    return min(select(parallel, perspective, is_perspective), plane.distance + MAX_RETREAT * across);
}

/// The same place in light coordinates.
fn receiver_position(space: LightSpace, plane: ReceiverPlane, uv: vec2f) -> vec3f {
    let distance = receiver_distance(space, plane, uv);
    let ray = (uv - 0.5) * vec2f(2.0, -2.0) / space.projection.xy;
    return vec3f(ray * select(1.0, distance, space.projection.z > 0.5), distance);
}

/// Linear depth, clamped to [0, 1], where the light's ray through `uv` meets the plane.
fn receiver_depth(space: LightSpace, plane: ReceiverPlane, uv: vec2f) -> f32 {
    return saturate(light_linear_depth(space, receiver_distance(space, plane, uv)));
}

/// `light_depth_zw`, clamped to [0, 1], of the same place.
fn receiver_depth_zw(space: LightSpace, plane: ReceiverPlane, uv: vec2f) -> f32 {
    return saturate(light_depth_zw(space, receiver_position(space, plane, uv)));
}

/// `light_depth_radial`, clamped to [0, 1], of the same place.
fn receiver_depth_radial(space: LightSpace, plane: ReceiverPlane, uv: vec2f) -> f32 {
    return saturate(light_depth_radial(space, receiver_position(space, plane, uv)));
}

/// Size of the change of linear depth per unit of `uv` at the shaded point: |d depth/du|, |d depth/dv|.
fn receiver_slope(space: LightSpace, plane: ReceiverPlane) -> vec2f {
    return abs(plane.slope) * select(1.0, plane.distance, space.projection.z > 0.5) * space.depth.z;
}

/// The same, of no steeper surface than `MAX_RETREAT`: for biases that would otherwise carry a shadow away.
fn receiver_bounded_slope(space: LightSpace, plane: ReceiverPlane) -> vec2f {
    let across = select(1.0, plane.distance, space.projection.z > 0.5);
    let most = MAX_RETREAT * 2.0 / space.projection.xy * across * space.depth.z;
    return min(receiver_slope(space, plane), most);
}

/// Depth that rounding may shift a stored texel by, given the slope per texel. Rasterisers place vertices on a grid of
/// 1/256 texel, so a stored plane may lie off by that part of its slope; float32 adds a few parts in 10^7.
fn receiver_rounding(slope_per_texel: vec2f) -> f32 {
    return (slope_per_texel.x + slope_per_texel.y) * (1.0 / 64.0) + 1e-6;
}

/// Depth by which the facets around rise above the plane of the shaded one on a surface that curves towards the light,
/// `texels` away on a map of `size`. Without it the inner side of a ring shows its facets as ribs.
fn receiver_curvature(space: LightSpace, plane: ReceiverPlane, size: vec2f, texels: f32) -> f32 {
    let texel = 2.0 / (space.projection.xy * size) * select(1.0, plane.distance, space.projection.z > 0.5);
    // The rise of a plane per metre across is the tangent of its angle, whose derivative is 1 + tangent^2.
    let steep = dot(plane.rise, plane.rise);
    return MAX_FOLD * min(1.0 + steep, MAX_FOLD_DEPTH) * texels * max(texel.x, texel.y) * space.depth.z;
}

/// Normal of the surface as it is drawn, from neighbouring pixels; not normalised, either side. Shading normals do not
/// describe the plane that the map holds. Call it where all pixels come along.
fn geometric_normal(point: vec3f) -> vec3f {
    return cross(dpdx(point), dpdy(point));
}
