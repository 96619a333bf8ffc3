// Spot light, exponential shadow

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
    shadow_bleeding_reduction: f32,
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

struct MapFootprint {
    level: f32,
    taps: f32,
    step: vec2f,
}

struct SpotLight {
    irradiance: vec3f,
    direction: vec3f,
    distance: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;
@group(2) @binding(1) var trilinear_clamp_sampler: sampler;
@group(3) @binding(0) var<uniform> spot_space: LightSpace;
@group(3) @binding(1) var spot_map: texture_2d_array<f32>;

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

const MIN_RECEIVER_COSINE: f32 = 0.015625;

fn light_position(space: LightSpace, point: vec3f) -> vec3f {
    return (space.world_to_light * vec4f(point, 1.0)).xyz;
}

fn light_linear_depth(space: LightSpace, distance: f32) -> f32 {
    return (distance - space.depth.x) * space.depth.z;
}

fn light_depth_linear(space: LightSpace, position: vec3f) -> f32 {
    return light_linear_depth(space, position.z);
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

fn light_zoom(space: LightSpace) -> vec2f {
    let shape = sqrt(space.projection.x / space.projection.y);
    return max(space.source.w, 1.0) * vec2f(shape, 1.0 / shape);
}

fn light_map_change(space: LightSpace, position: vec3f, change: vec3f) -> vec2f {
    let moved = (space.world_to_light * vec4f(change, 0.0)).xyz;
    let perspective = (moved.xy - light_ray(space, position) * moved.z) / max(position.z, 1e-6);
    let ray = select(moved.xy, perspective, space.projection.z > 0.5);
    return ray * space.projection.xy * vec2f(0.5, -0.5);
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

fn receiver_slope(space: LightSpace, plane: ReceiverPlane) -> vec2f {
    return abs(plane.slope) * select(1.0, plane.distance, space.projection.z > 0.5) * space.depth.z;
}

fn geometric_normal(point: vec3f) -> vec3f {
    return cross(dpdx(point), dpdy(point));
}

fn reduce_bleeding(visibility: f32, amount: f32) -> f32 {
    let least = clamp(amount, 0.0, 0.99);
    return saturate((visibility - least) / (1.0 - least));
}

fn map_footprint(size: vec2f, uv_dx: vec2f, uv_dy: vec2f, most: f32) -> MapFootprint {
    let across = length(uv_dx * size);
    let down = length(uv_dy * size);
    let longer = max(across, down);
    let taps = clamp(ceil(longer / max(min(across, down), 1.0) - 0.01), 1.0, most);
    let level = log2(max(longer / taps, 1.0));
    return MapFootprint(level, taps, select(uv_dy, uv_dx, across > down) / taps);
}

fn footprint_reach(size: vec2f, uv_dx: vec2f, uv_dy: vec2f, most: f32) -> vec2f {
    let footprint = map_footprint(size, uv_dx, uv_dy, most);
    return 0.5 * footprint.taps * abs(footprint.step) + exp2(ceil(footprint.level)) / size;
}

fn sample_footprint(
    map: texture_2d_array<f32>,
    map_sampler: sampler,
    uv: vec2f,
    layer: i32,
    uv_dx: vec2f,
    uv_dy: vec2f,
    most: f32,
) -> vec4f {
    let footprint = map_footprint(vec2f(textureDimensions(map)), uv_dx, uv_dy, most);
    let first = uv - 0.5 * (footprint.taps - 1.0) * footprint.step;
    var sum = vec4f(0.0);
    for (var i = 0.0; i < footprint.taps; i += 1.0) {
        sum += textureSampleLevel(map, map_sampler, first + i * footprint.step, layer, footprint.level);
    }
    return sum / footprint.taps;
}

fn warped_mean_up_to_far(alone: f32, nearest: f32, farthest: f32, rate: f32, middle: f32, reach: f32) -> f32 {
    let mean = ((farthest - nearest) / rate + farthest * (middle + reach - 1.0)) / max(2.0 * reach, 1e-9);
    return select(alone, min(alone, mean), abs(middle - 1.0) < reach && reach > 1e-4);
}

fn receiver_reach(space: LightSpace, plane: ReceiverPlane, half_width: vec2f) -> f32 {
    return dot(receiver_slope(space, plane), half_width);
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

const EXPONENT: f32 = 80;
const WIDTH: f32 = 5;
const ANISOTROPY: f32 = 16;

fn exponential_shadow(
    point: vec3f,
    space: LightSpace,
    map: texture_2d_array<f32>,
    tap_sampler: sampler,
    bleeding_reduction: f32,
    receives: f32,
) -> f32 {
    let position = light_position(space, point);
    let uv = light_map_uv(space, position);
    let layer = light_layer(space);
    let uv_dx = light_map_change(space, position, dpdx(point));
    let uv_dy = light_map_change(space, position, dpdy(point));
    let stored = sample_footprint(map, tap_sampler, uv, layer, uv_dx, uv_dy, ANISOTROPY).x;
    let measured = light_depth_linear(space, position);
    let scale = 1.0;
    // The map holds what lies beyond the far plane as lying in it.
    let size = vec2f(textureDimensions(map));
    let blurred = (0.5 * WIDTH * light_zoom(space) + 1.0) / size;
    let filtered = blurred + footprint_reach(size, uv_dx, uv_dy, ANISOTROPY);
    let plane = receiver_plane(space, position, geometric_normal(point));
    let reach = receiver_reach(space, plane, filtered) * scale;
    // No bias: the mean of the exponentials over a lit slope is above the exponential of its middle.
    let exponent = EXPONENT;
    let mean = stored;
    let alone = exp(exponent * (saturate(measured) - 1.0));
    let nearest = exp(exponent * (saturate(measured - reach) - 1.0));
    let ratio = mean / warped_mean_up_to_far(alone, nearest, 1.0, exponent, measured, reach);
    let visibility = reduce_bleeding(min(ratio, 1.0), bleeding_reduction);
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, uv));
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
    // shadow: Exponential shadow
    let shadow_visibility = exponential_shadow(
        in.position_world,
        spot_space,
        spot_map,
        trilinear_clamp_sampler,
        parameters.shadow_bleeding_reduction,
        object.receives,
    );
    return vec4f(spot.irradiance * shadow_visibility, 1.0);
}
