// Spot light, soft summed-area shadow

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
    shadow_minimum_width: f32,
    shadow_softness: f32,
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

struct SpotLight {
    irradiance: vec3f,
    direction: vec3f,
    distance: f32,
}

struct Seen {
    lit: f32,
    dark: f32,
    occluder: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;
@group(3) @binding(0) var<uniform> spot_space: LightSpace;
@group(3) @binding(1) var spot_map: texture_2d_array<u32>;

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

fn receiver_moments_within(space: LightSpace, plane: ReceiverPlane, uv: vec2f, width: vec2f) -> vec2f {
    let distance = receiver_distance(space, plane, uv);
    let rise = length(receiver_rise(space, plane, uv, width));
    let depth = light_linear_depth(space, distance);
    let even = vec2f(mean_up_to_far(depth, rise), rise * rise * (1.0 / 3.0));
    // Half the spread of 1 / distance, in parts of its middle; as receivers elsewhere, within four times the distance.
    let spread = rise / (space.depth.z * max(distance, 1e-6));
    let middle = 1.0 / max(distance, 1e-6);
    let farthest = 1.0 / space.depth.y;
    let high = middle * (1.0 + max(spread, 0.05));
    let low = middle * max(1.0 - max(spread, 0.05), 0.25);
    let bend = clamp(farthest, low, high);
    let mean = ((bend - low) / farthest + log(high / bend)) / (high - low);
    let square = ((bend - low) / (farthest * farthest) + (1.0 / bend - 1.0 / high)) / (high - low);
    let variance = max(square - mean * mean, 0.0) * space.depth.z * space.depth.z;
    let uneven = vec2f(saturate(light_linear_depth(space, mean)), variance);
    return select(even, uneven, space.projection.z > 0.5 && spread > 0.05);
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

const FRACTION_BITS: u32 = 18;
const DISC_AS_SQUARE: f32 = 0.8660254;

fn source_width(space: LightSpace, position: vec3f, size: vec2f, occluder: f32) -> vec2f {
    let gap = max(position.z - occluder, 0.0);
    let spread = select(gap, gap / max(occluder, 1e-6), space.projection.z > 0.5);
    // Half of what the penumbra is wide at the point, metres.
    let reach = space.source.xy * (spread * select(1.0, DISC_AS_SQUARE, space.source.z > 0.5));
    let across = light_map_uv(space, position + vec3f(reach.x, 0.0, 0.0)) - light_map_uv(space, position);
    let down = light_map_uv(space, position + vec3f(0.0, reach.y, 0.0)) - light_map_uv(space, position);
    return 2.0 * size * (abs(across) + abs(down));
}

const PARTS: i32 = 4;
const LEAST_CUT: f32 = 32.0;

fn seen_by_moments(
    space: LightSpace,
    plane: ReceiverPlane,
    uv: vec2f,
    width: vec2f,
    moments: vec2f,
    least_variance: f32,
    reduction: f32,
    search: bool,
) -> Seen {
    let variance = moments.y - moments.x * moments.x;
    if (search) {
        let own = receiver_moments_within(space, plane, uv, width);
        let dark = 1.0 - summed_bound(own.x, moments.x, variance - own.y, least_variance, 0.0);
        // The mean is that of what is dark and of the receiver here, which may be far from the shaded point.
        let occluder = max(moments.x - (1.0 - dark) * own.x, 0.0);
        return Seen(1.0 - dark, dark * dark, dark * occluder);
    }
    let depth = receiver_depth_within(space, plane, uv, width);
    return Seen(summed_bound(depth, moments.x, variance, least_variance, reduction), 0.0, 0.0);
}

fn seen_in_whole(
    space: LightSpace,
    plane: ReceiverPlane,
    table: texture_2d_array<u32>,
    width: vec2f,
    least_variance: f32,
    reduction: f32,
    search: bool,
) -> Seen {
    let size = vec2f(textureDimensions(table));
    let region = summed_box(plane.uv, width, size);
    let moments = summed_mean(table, light_layer(space), region) * (1.0 / f32(1u << FRACTION_BITS));
    // Parts of texels are as deep as all of them: half a texel more at each end.
    let sides = (width + 1.0) / size;
    return seen_by_moments(space, plane, region.center, sides, moments, least_variance, reduction, search);
}

fn seen_in_parts(
    space: LightSpace,
    plane: ReceiverPlane,
    table: texture_2d_array<u32>,
    width: vec2f,
    least_variance: f32,
    reduction: f32,
    search: bool,
) -> Seen {
    let size = vec2f(textureDimensions(table));
    let low = clamp(plane.uv * size - 0.5 * width, vec2f(0.0), size - 1.0);
    let high = clamp(plane.uv * size + 0.5 * width, vec2f(1.0), size);
    let layer = light_layer(space);
    var seen = Seen(0.0, 0.0, 0.0);
    var total = 0.0;
    var above = array<vec2u, PARTS + 1>();
    for (var j = 0; j <= PARTS; j++) {
        let rows = round(mix(vec2f(low.y), vec2f(high.y), vec2f(f32(j) - 1.0, f32(j)) / f32(PARTS)));
        var before = array<vec2u, PARTS + 1>();
        for (var i = 0; i <= PARTS; i++) {
            let columns = round(mix(vec2f(low.x), vec2f(high.x), vec2f(f32(i) - 1.0, f32(i)) / f32(PARTS)));
            before[i] = summed_before(table, layer, i32(columns.y), i32(rows.y));
            let area = (columns.y - columns.x) * (rows.y - rows.x);
            if (i > 0 && j > 0 && area > 0.0) {
                let sum = (before[i] - before[i - 1]) - (above[i] - above[i - 1]);
                let moments = vec2f(sum) * (1.0 / f32(1u << FRACTION_BITS)) / area;
                let center = vec2f(columns.x + columns.y, rows.x + rows.y) * 0.5 / size;
                let sides = vec2f(columns.y - columns.x, rows.y - rows.x) / size;
                let part =
                    seen_by_moments(space, plane, center, sides, moments, least_variance, reduction, search);
                seen.lit += area * part.lit;
                seen.dark += area * part.dark;
                seen.occluder += area * part.occluder;
                total += area;
            }
        }
        above = before;
    }
    let share = 1.0 / max(total, 1.0);
    return Seen(seen.lit * share, seen.dark * share, seen.occluder * share);
}

fn summed_area_soft_shadow(
    point: vec3f,
    space: LightSpace,
    table: texture_2d_array<u32>,
    softness: f32,
    minimum_width: f32,
    minimum_variance: f32,
    bleeding_reduction: f32,
    receives: f32,
) -> f32 {
    let position = light_position(space, point);
    let plane = receiver_plane(space, position, geometric_normal(point));
    let size = vec2f(textureDimensions(table));
    // As many texels of depth 1 as the sum of them has room for.
    let widest = vec2f(f32(1u << ((32u - FRACTION_BITS) / 2u)));

    // Occluders are nearer than the receiver and beyond the near plane: there the light appears largest.
    let largest = softness * source_width(space, position, size, space.depth.x);
    let search = clamp(largest, vec2f(minimum_width), widest);
    var found = Seen(1.0, 0.0, 0.0);
    if (min(search.x, search.y) < LEAST_CUT) {
        found = seen_in_whole(space, plane, table, search, minimum_variance, 0.0, true);
    } else {
        found = seen_in_parts(space, plane, table, search, minimum_variance, 0.0, true);
    }
    // The mean over what is dark. Where next to nothing is, its distance does not matter.
    let depth = found.occluder / max(found.dark, 1e-6);
    let occluder = select(position.z, space.depth.x + depth / space.depth.z, found.dark > 1e-6);

    let width = clamp(softness * source_width(space, position, size, occluder), vec2f(minimum_width), widest);
    var filtered = Seen(1.0, 0.0, 0.0);
    if (min(width.x, width.y) < LEAST_CUT) {
        filtered = seen_in_whole(space, plane, table, width, minimum_variance, bleeding_reduction, false);
    } else {
        filtered = seen_in_parts(space, plane, table, width, minimum_variance, bleeding_reduction, false);
    }
    return select(filtered.lit, 1.0, receives < 0.5 || outside_light_map(space, position, plane.uv));
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
    // shadow: Summed-area soft shadow
    let shadow_visibility = summed_area_soft_shadow(
        in.position_world,
        spot_space,
        spot_map,
        parameters.shadow_softness,
        parameters.shadow_minimum_width,
        parameters.shadow_minimum_variance,
        parameters.shadow_bleeding_reduction,
        object.receives,
    );
    return vec4f(spot.irradiance * shadow_visibility, 1.0);
}
