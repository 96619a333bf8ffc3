// Sun, summed-area shadow

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
    shadow_minimum_variance: f32,
    shadow_near_distance: f32,
    shadow_width: f32,
    sun_angle: f32,
    sun_center: vec3f,
    sun_color: vec3f,
    sun_direction: vec3f,
    sun_intensity: f32,
    sun_radius: f32,
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

struct SummedBox {
    /// Columns and rows before its first texel, and up to its last; where there is no last one, up to the map's end.
    first: vec2i,
    last: vec2i,
    /// Parts of the first and of the last texel.
    head: vec2f,
    tail: vec2f,
    /// Texels in it, in all.
    area: f32,
    /// Map coordinate of its middle.
    center: vec2f,
}

struct SummedRun {
    head: vec2u,
    whole: vec2u,
    tail: vec2u,
}

struct DirectionalLight {
    irradiance: vec3f,
    direction: vec3f,
    distance: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;
@group(3) @binding(0) var<uniform> sun_space: LightSpace;
@group(3) @binding(1) var sun_map: texture_2d_array<u32>;

const MAX_RETREAT: f32 = 8.0;
const MIN_RECEIVER_COSINE: f32 = 0.015625;

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

fn receiver_distance(space: LightSpace, plane: ReceiverPlane, uv: vec2f) -> f32 {
    let change = dot(plane.slope, uv - plane.uv);
    let parallel = plane.distance - change;
    // Rays that run away along the plane are held within four times the distance.
    let perspective = plane.distance / max(1.0 + change, 0.25);
    let is_perspective = space.projection.z > 0.5;
    let across = length((uv - plane.uv) * 2.0 / space.projection.xy) * select(1.0, plane.distance, is_perspective);
    return min(select(parallel, perspective, is_perspective), plane.distance + MAX_RETREAT * across);
}

fn receiver_slope(space: LightSpace, plane: ReceiverPlane) -> vec2f {
    return abs(plane.slope) * select(1.0, plane.distance, space.projection.z > 0.5) * space.depth.z;
}

fn geometric_normal(point: vec3f) -> vec3f {
    return cross(dpdx(point), dpdy(point));
}

fn chebyshev_bound(variance: f32, behind: f32) -> f32 {
    return variance / (variance + behind * behind);
}

fn reduce_bleeding(visibility: f32, amount: f32) -> f32 {
    let least = clamp(amount, 0.0, 0.99);
    return saturate((visibility - least) / (1.0 - least));
}

fn summed_box(uv: vec2f, width: vec2f, size: vec2f) -> SummedBox {
    let half_width = 0.5 * max(width, vec2f(1.0));
    let low = clamp(uv * size - half_width, vec2f(0.0), size - 1.0);
    let high = clamp(uv * size + half_width, vec2f(1.0), size);
    let first = floor(low);
    // A box of one texel has two ends in different texels, but for rounding and at borders, where it gets the whole one.
    let last = max(floor(high), first + 1.0);
    let head = first + 1.0 - low;
    let tail = clamp(high - last, vec2f(0.0), vec2f(1.0));
    let sides = head + (last - first - 1.0) + tail;
    let center = 0.5 * (low + last + tail) / size;
    return SummedBox(vec2i(first), vec2i(last), head, tail, sides.x * sides.y, center);
}

fn summed_before(map: texture_2d_array<u32>, layer: i32, column: i32, row: i32) -> vec2u {
    let sum = textureLoad(map, max(vec2i(column, row) - 1, vec2i(0)), layer, 0).xy;
    return select(sum, vec2u(0u), min(column, row) < 1);
}

fn summed_run(map: texture_2d_array<u32>, layer: i32, region: SummedBox, row: i32) -> SummedRun {
    let end = min(region.last.x + 1, i32(textureDimensions(map).x));
    let a = summed_before(map, layer, region.first.x, row);
    let b = summed_before(map, layer, region.first.x + 1, row);
    let c = summed_before(map, layer, region.last.x, row);
    let d = summed_before(map, layer, end, row);
    return SummedRun(b - a, c - b, d - c);
}

fn summed_strip(region: SummedBox, above: SummedRun, below: SummedRun) -> vec2f {
    let ends = region.head.x * vec2f(below.head - above.head) + region.tail.x * vec2f(below.tail - above.tail);
    return ends + vec2f(below.whole - above.whole);
}

fn summed_mean(map: texture_2d_array<u32>, layer: i32, region: SummedBox) -> vec2f {
    let end = min(region.last.y + 1, i32(textureDimensions(map).y));
    let a = summed_run(map, layer, region, region.first.y);
    let b = summed_run(map, layer, region, region.first.y + 1);
    let c = summed_run(map, layer, region, region.last.y);
    let d = summed_run(map, layer, region, end);
    let ends = region.head.y * summed_strip(region, a, b) + region.tail.y * summed_strip(region, c, d);
    return (ends + summed_strip(region, b, c)) / region.area;
}

fn summed_bound(depth: f32, mean: f32, variance: f32, least_variance: f32, reduction: f32) -> f32 {
    let behind = max(depth - mean, 0.0);
    // 1e-12 keeps 0 / 0 out where both the variance and the difference vanish.
    return reduce_bleeding(chebyshev_bound(max(variance, max(least_variance, 1e-12)), behind), reduction);
}

fn mean_up_to_far(middle: f32, reach: f32) -> f32 {
    let beyond = clamp(middle + reach - 1.0, 0.0, 2.0 * reach);
    return saturate(middle - beyond * beyond / max(4.0 * reach, 1e-9) - max(middle - reach - 1.0, 0.0));
}

fn receiver_rise(space: LightSpace, plane: ReceiverPlane, uv: vec2f, width: vec2f) -> vec2f {
    // 1 / distance is even in a perspective, so that distance grows with its own square.
    let growth = receiver_distance(space, plane, uv) / max(plane.distance, 1e-6);
    let stretch = select(1.0, growth * growth, space.projection.z > 0.5);
    return receiver_slope(space, plane) * (0.5 * stretch) * width;
}

fn receiver_depth_within(space: LightSpace, plane: ReceiverPlane, uv: vec2f, width: vec2f) -> f32 {
    let rise = receiver_rise(space, plane, uv, width);
    return mean_up_to_far(light_linear_depth(space, receiver_distance(space, plane, uv)), rise.x + rise.y);
}

fn directional_light(
    point: vec3f,
    direction: vec3f,
    color: vec3f,
    intensity: f32,
    center: vec3f,
    radius: f32,
    angle: f32,
) -> DirectionalLight {
    // A direction of length zero counts as straight down.
    let square = dot(direction, direction);
    let axis = select(direction * inverseSqrt(max(square, 1e-20)), vec3f(0.0, -1.0, 0.0), square < 1e-20);
    return DirectionalLight(color * intensity, -axis, max(dot(point - center, axis) + radius, 0.0));
}

const FRACTION_BITS: u32 = 18;
const MOST_GROWTH: f32 = 8.0;

fn summed_area_shadow(
    point: vec3f,
    space: LightSpace,
    table: texture_2d_array<u32>,
    width: f32,
    near_distance: f32,
    eye: f32,
    minimum_variance: f32,
    bleeding_reduction: f32,
    receives: f32,
) -> f32 {
    let position = light_position(space, point);
    let plane = receiver_plane(space, position, geometric_normal(point));
    let size = vec2f(textureDimensions(table));
    // As many texels of depth 1 as the sum of them has room for.
    let widest = f32(1u << ((32u - FRACTION_BITS) / 2u));
    let wanted = width * clamp(near_distance / max(eye, 1e-6), 1.0, MOST_GROWTH);
    // The rectangle around the pixel on the map.
    let uv_dx = abs(light_map_change(space, position, dpdx(point)));
    let uv_dy = abs(light_map_change(space, position, dpdy(point)));
    let texels = max(vec2f(wanted), (uv_dx + uv_dy) * size);
    let box_width = min(texels, vec2f(widest));
    let region = summed_box(plane.uv, box_width, size);
    let moments = summed_mean(table, light_layer(space), region) / f32(1u << FRACTION_BITS);
    let mean = moments.x;
    let variance = moments.y - mean * mean;
    // At the borders the middle of the box is another place of the receiver, at another depth.
    // Parts of texels are as deep as all of them: half a texel more at each end.
    let depth = receiver_depth_within(space, plane, region.center, (box_width + 1.0) / size);
    let visibility = summed_bound(depth, mean, variance, minimum_variance, bleeding_reduction);
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, plane.uv));
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
    // sun: Directional light
    let sun = directional_light(
        in.position_world,
        parameters.sun_direction,
        parameters.sun_color,
        parameters.sun_intensity,
        parameters.sun_center,
        parameters.sun_radius,
        parameters.sun_angle,
    );
    // shadow: Summed-area shadow
    let shadow_visibility = summed_area_shadow(
        in.position_world,
        sun_space,
        sun_map,
        parameters.shadow_width,
        parameters.shadow_near_distance,
        dot(frame.camera_forward, in.position_world - frame.camera_position),
        parameters.shadow_minimum_variance,
        parameters.shadow_bleeding_reduction,
        object.receives,
    );
    return vec4f(sun.irradiance * shadow_visibility, 1.0);
}
