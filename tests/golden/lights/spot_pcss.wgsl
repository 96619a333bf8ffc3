// Spot light, soft area shadow

struct Frame {
    world_to_clip: mat4x4f,
    world_to_view: mat4x4f,
    camera_position: vec3f,
    time: f32,
    camera_forward: vec3f,
    environment_levels: f32,
    environment_irradiance: array<vec4f, 9>,
}

struct Object {
    object_to_world: mat4x4f,
    world_to_object: mat4x4f,
    receives: f32,
}

struct Parameters {
    shadow_bias: f32,
    shadow_nearest: f32,
    spot_color: vec3f,
    spot_direction: vec3f,
    spot_inner_angle: f32,
    spot_intensity: f32,
    spot_near: f32,
    spot_outer_angle: f32,
    spot_position: vec3f,
    spot_radius: f32,
    spot_range: f32,
}

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

struct ReceiverMargin {
    /// Everywhere.
    here: f32,
    /// For each texel between the shaded point and the compared texel.
    per_texel: f32,
}

struct SpotLight {
    irradiance: vec3f,
    direction: vec3f,
    distance: f32,
}

struct SeenSource {
    /// Its half axes, for a reach of 1: metres across the light's axis at the distance of the shaded point.
    first: vec2f,
    second: vec2f,
    /// 1 an ellipse, 0 a rectangle.
    round: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;
@group(2) @binding(1) var nearest_clamp_sampler: sampler;
@group(2) @binding(2) var linear_comparison_sampler: sampler_comparison;
@group(3) @binding(0) var<uniform> spot_space: LightSpace;
@group(3) @binding(1) var spot_shadow_map: texture_depth_2d_array;
@group(3) @binding(2) var spot_shadow_map_2: texture_2d_array<f32>;

fn point_light_ray(point: vec3f, position: vec3f) -> vec4f {
    let offset = position - point;
    let distance = length(offset);
    return vec4f(select(offset / max(distance, 1e-6), vec3f(0.0, 1.0, 0.0), distance < 1e-6), distance);
}

fn inverse_square(distance: f32) -> f32 {
    return 1.0 / max(distance * distance, 1e-6);
}

fn cone_falloff(cosine: f32, inner_angle: f32, outer_angle: f32) -> f32 {
    let outer = cos(outer_angle);
    let inner = max(cos(min(inner_angle, outer_angle)), outer + 1e-4);
    return smoothstep(outer, inner, cosine);
}

const MAX_RETREAT: f32 = 8.0;
const MIN_RECEIVER_COSINE: f32 = 0.015625;
const MAX_FOLD: f32 = 0.125;
const MAX_FOLD_DEPTH: f32 = 8.0;

fn light_position(space: LightSpace, point: vec3f) -> vec3f {
    return (space.world_to_light * vec4f(point, 1.0)).xyz;
}

fn light_linear_depth(space: LightSpace, distance: f32) -> f32 {
    return (distance - space.depth.x) * space.depth.z;
}

fn light_ray(space: LightSpace, position: vec3f) -> vec2f {
    return position.xy / select(1.0, max(position.z, 1e-6), space.projection.z > 0.5);
}

fn light_map_uv(space: LightSpace, position: vec3f) -> vec2f {
    return light_ray(space, position) * space.projection.xy * vec2f(0.5, -0.5) + 0.5;
}

fn light_layer(space: LightSpace) -> i32 {
    return i32(space.projection.w);
}

fn outside_light_map(space: LightSpace, position: vec3f, uv: vec2f) -> bool {
    return position.z < space.depth.x || any(uv < vec2f(0.0)) || any(uv > vec2f(1.0));
}

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

fn receiver_distance(space: LightSpace, plane: ReceiverPlane, uv: vec2f) -> f32 {
    let change = dot(plane.slope, uv - plane.uv);
    let parallel = plane.distance - change;
    // Rays that run away along the plane are held within four times the distance.
    let perspective = plane.distance / max(1.0 + change, 0.25);
    let is_perspective = space.projection.z > 0.5;
    let across = length((uv - plane.uv) * 2.0 / space.projection.xy) * select(1.0, plane.distance, is_perspective);
    return min(select(parallel, perspective, is_perspective), plane.distance + MAX_RETREAT * across);
}

fn receiver_depth(space: LightSpace, plane: ReceiverPlane, uv: vec2f) -> f32 {
    return saturate(light_linear_depth(space, receiver_distance(space, plane, uv)));
}

fn receiver_slope(space: LightSpace, plane: ReceiverPlane) -> vec2f {
    return abs(plane.slope) * select(1.0, plane.distance, space.projection.z > 0.5) * space.depth.z;
}

fn receiver_rounding(slope_per_texel: vec2f) -> f32 {
    return (slope_per_texel.x + slope_per_texel.y) * (1.0 / 64.0) + 1e-6;
}

fn receiver_curvature(space: LightSpace, plane: ReceiverPlane, size: vec2f, texels: f32) -> f32 {
    let texel = 2.0 / (space.projection.xy * size) * select(1.0, plane.distance, space.projection.z > 0.5);
    // The rise of a plane per metre across is the tangent of its angle, whose derivative is 1 + tangent^2.
    let steep = dot(plane.rise, plane.rise);
    return MAX_FOLD * min(1.0 + steep, MAX_FOLD_DEPTH) * texels * max(texel.x, texel.y) * space.depth.z;
}

fn geometric_normal(point: vec3f) -> vec3f {
    return cross(dpdx(point), dpdy(point));
}

fn receiver_margin(space: LightSpace, plane: ReceiverPlane, map: texture_depth_2d_array, bias: f32) -> ReceiverMargin {
    let size = vec2f(textureDimensions(map));
    let rounding = receiver_rounding(receiver_slope(space, plane) / size);
    return ReceiverMargin(bias * space.depth.z + rounding, receiver_curvature(space, plane, size, 1.0));
}

fn margin_within(margin: ReceiverMargin, texels: f32) -> ReceiverMargin {
    return ReceiverMargin(margin.here + margin.per_texel * texels, 0.0);
}

fn compared_depth(space: LightSpace, plane: ReceiverPlane, size: vec2f, uv: vec2f, margin: ReceiverMargin) -> f32 {
    let away = length((uv - plane.uv) * size);
    return receiver_depth(space, plane, uv) - margin.here - margin.per_texel * away;
}

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

const GOLDEN_ANGLE: f32 = 2.3999632;

fn interleaved_noise(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(floor(pixel), vec2f(0.06711056, 0.00583715))));
}

fn vogel_sample(index: i32, count: i32, turn: f32) -> vec2f {
    let radius = sqrt((f32(index) + 0.5) / f32(count));
    return vec2f(radius, fract(f32(index) * (GOLDEN_ANGLE / 6.2831853) + turn) * 6.2831853);
}

fn on_disc(polar: vec2f) -> vec2f {
    return polar.x * vec2f(cos(polar.y), sin(polar.y));
}

fn on_square(polar: vec2f) -> vec2f {
    // Quarters of the circle around +x, +y, -x and -y become the triangles between the middle and each side.
    let quarter = floor(polar.y * (2.0 / 3.1415927) + 0.5);
    let part = (polar.y * (4.0 / 3.1415927) - 2.0 * quarter) * polar.x;
    let turned = i32(quarter) & 3;
    let sign = select(1.0, -1.0, turned >= 2);
    return sign * select(vec2f(polar.x, part), vec2f(-part, polar.x), (turned & 1) == 1);
}

fn spot_light(
    point: vec3f,
    position: vec3f,
    direction: vec3f,
    color: vec3f,
    intensity: f32,
    inner_angle: f32,
    outer_angle: f32,
    near: f32,
    range: f32,
    radius: f32,
) -> SpotLight {
    let ray = point_light_ray(point, position);
    let axis = direction * inverseSqrt(max(dot(direction, direction), 1e-20));
    let cone = cone_falloff(-dot(ray.xyz, axis), inner_angle, outer_angle);
    return SpotLight(color * (intensity * cone * inverse_square(ray.w)), ray.xyz, ray.w);
}

const SEARCH: i32 = 32;
const FILTER: i32 = 64;

fn pcss_shadow(
    point: vec3f,
    space: LightSpace,
    map: texture_depth_2d_array,
    depths: texture_2d_array<f32>,
    map_sampler: sampler,
    blending_sampler: sampler_comparison,
    pixel: vec2f,
    nearest: f32,
    bias: f32,
    receives: f32,
) -> f32 {
    let position = light_position(space, point);
    let plane = receiver_plane(space, position, geometric_normal(point));
    let margin = receiver_margin(space, plane, map, bias);
    let size = vec2f(textureDimensions(map));
    let layer = light_layer(space);
    let source = source_seen(space, position);
    let turn = interleaved_noise(pixel);
    // Mean distance, along the light's axis, of what is nearer than the receiver.
    let nearest_distance = max(space.depth.x, clamp(nearest, 0.01, 1.0) * position.z * space.projection.z);
    let reach = penumbra_reach(space, nearest_distance, position.z);
    var total = 0.0;
    var found = 0.0;
    for (var i = 0; i < SEARCH; i++) {
        let offset = on_source(source, vogel_sample(i, SEARCH, turn)) * reach;
        let texel = clamp(floor(light_map_uv(space, position + vec3f(offset, 0.0)) * size), vec2f(0.0), size - 1.0);
        let uv = (texel + 0.5) / size;
        let stored = textureSampleLevel(depths, map_sampler, uv, layer, 0.0).x;
        let nearer = select(0.0, 1.0, stored < compared_depth(space, plane, size, uv, margin));
        total += nearer * stored;
        found += nearer;
    }
    let occluder = space.depth.x + total / max(found, 1.0) / space.depth.z;
    // The samples of the filter are turned against those of the search.
    let width = penumbra_reach(space, max(occluder, nearest_distance), position.z);
    // Metres to texels: how far the ends of its axes lie on the map.
    let first = length(light_map_uv(space, position + vec3f(source.first * width, 0.0)) - plane.uv);
    let second = length(light_map_uv(space, position + vec3f(source.second * width, 0.0)) - plane.uv);
    let texels = max(first, second) * max(size.x, size.y);
    let within = margin_within(margin, texels * mix(1.4142136, 1.0, source.round) + 1.0);
    var sum = 0.0;
    for (var i = 0; i < FILTER; i++) {
        let offset = on_source(source, vogel_sample(i, FILTER, turn + 0.5)) * width;
        sum += compare_blended(space, plane, map, blending_sampler, light_map_uv(space, position + vec3f(offset, 0.0)), within);
    }
    let visibility = select(sum / f32(FILTER), 1.0, found < 0.5);
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, plane.uv));
}

fn source_seen(space: LightSpace, position: vec3f) -> SeenSource {
    let half = space.source.xy * mix(1.0, position.z, space.projection.z);
    let ray = light_ray(space, position) * (space.projection.z * space.source.z);
    let radius = length(ray);
    let outwards = select(vec2f(1.0, 0.0), ray / max(radius, 1e-12), radius > 1e-6);
    let stretch = sqrt(1.0 + radius * radius);
    let first = vec2f(outwards.x, outwards.y) * stretch;
    let second = vec2f(-outwards.y, outwards.x);
    return SeenSource(first * half, second * half, space.source.z);
}

fn on_source(source: SeenSource, polar: vec2f) -> vec2f {
    let place = select(on_square(polar), on_disc(polar), source.round > 0.5);
    return source.first * place.x + source.second * place.y;
}

fn penumbra_reach(space: LightSpace, occluder: f32, receiver: f32) -> f32 {
    let parallel = receiver - occluder;
    let perspective = 1.0 / max(occluder, 1e-6) - 1.0 / max(receiver, 1e-6);
    return max(mix(parallel, perspective, space.projection.z), 0.0);
}

struct Vertex {
    @location(0) position: vec3f,
}

struct Varyings {
    @builtin(position) clip_position: vec4f,
    @location(0) position_world: vec3f,
}

@vertex
fn vs_main(in: Vertex) -> Varyings {
    let world = object.object_to_world * vec4f(in.position, 1.0);
    var out: Varyings;
    out.clip_position = frame.world_to_clip * world;
    out.position_world = world.xyz;
    return out;
}

@fragment
fn fs_main(in: Varyings) -> @location(0) vec4f {
    // spot: Spot light
    let spot = spot_light(
        in.position_world,
        parameters.spot_position,
        parameters.spot_direction,
        parameters.spot_color,
        parameters.spot_intensity,
        parameters.spot_inner_angle,
        parameters.spot_outer_angle,
        parameters.spot_near,
        parameters.spot_range,
        parameters.spot_radius,
    );
    // shadow: Soft area shadow
    let shadow_visibility = pcss_shadow(
        in.position_world,
        spot_space,
        spot_shadow_map,
        spot_shadow_map_2,
        nearest_clamp_sampler,
        linear_comparison_sampler,
        in.clip_position.xy,
        parameters.shadow_nearest,
        parameters.shadow_bias,
        object.receives,
    );
    return vec4f(spot.irradiance * shadow_visibility, 1.0);
}
