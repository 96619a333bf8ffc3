// A lamp that shines as a surface elsewhere looks

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
    bulb_intensity: f32,
    bulb_near: f32,
    bulb_position: vec3f,
    bulb_radius: f32,
    bulb_range: f32,
    inverse_amount: f32,
    matte_albedo: vec3f,
    seen_albedo: vec3f,
    seen_roughness: f32,
    shade_bias: f32,
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

struct SpotLight {
    irradiance: vec3f,
    direction: vec3f,
    distance: f32,
}

struct PointLight {
    irradiance: vec3f,
    direction: vec3f,
    distance: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;
@group(2) @binding(1) var nearest_comparison_sampler: sampler_comparison;
@group(3) @binding(0) var<uniform> spot_space: LightSpace;
@group(3) @binding(1) var spot_map: texture_depth_2d_array;

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

const MATTE_RADIANCE: f32 = 0.31830987;

fn environment_irradiance(harmonics: array<vec4f, 9>, normal: vec3f) -> vec3f {
    let n = normal;
    let first = harmonics[0] + n.y * harmonics[1] + n.z * harmonics[2] + n.x * harmonics[3];
    let second = n.x * n.y * harmonics[4] + n.y * n.z * harmonics[5] + (3.0 * n.z * n.z - 1.0) * harmonics[6]
        + n.x * n.z * harmonics[7] + (n.x * n.x - n.y * n.y) * harmonics[8];
    return max((first + second).rgb, vec3f(0.0));
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

fn hard_shadow(
    point: vec3f,
    space: LightSpace,
    map: texture_depth_2d_array,
    map_sampler: sampler_comparison,
    bias: f32,
    receives: f32,
) -> f32 {
    let normal = geometric_normal(point);
    let position = light_position(space, point);
    let layer = light_layer(space);
    let plane = receiver_plane(space, position, normal);
    let size = vec2f(textureDimensions(map));
    let rounding = receiver_rounding(receiver_slope(space, plane) / size) + receiver_curvature(space, plane, size, 0.5);
    let margin = bias * space.depth.z + rounding;
    let center = (floor(plane.uv * size) + 0.5) / size;
    let depth = compared_at(space, plane, center, margin);
    let visibility = textureSampleCompareLevel(map, map_sampler, center, layer, depth);
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, plane.uv));
}

fn compared_at(space: LightSpace, plane: ReceiverPlane, uv: vec2f, margin: f32) -> f32 {
    return receiver_depth(space, plane, uv) - margin;
}

fn lambert(irradiance: vec3f, to_light: vec3f, normal: vec3f, albedo: vec3f) -> vec3f {
    return albedo * irradiance * (saturate(dot(normal, to_light)) * MATTE_RADIANCE);
}

fn lambert_ambient(normal: vec3f, albedo: vec3f, irradiance_harmonics: array<vec4f, 9>) -> vec3f {
    return albedo * environment_irradiance(irradiance_harmonics, normal) * MATTE_RADIANCE;
}

fn point_light(
    point: vec3f,
    position: vec3f,
    color: vec3f,
    intensity: f32,
    near: f32,
    range: f32,
    radius: f32,
) -> PointLight {
    let ray = point_light_ray(point, position);
    return PointLight(color * (intensity * inverse_square(ray.w)), ray.xyz, ray.w);
}

fn oren_nayar(
    irradiance: vec3f,
    to_light: vec3f,
    normal: vec3f,
    to_camera: vec3f,
    albedo: vec3f,
    roughness: f32,
) -> vec3f {
    let n_dot_l = saturate(dot(normal, to_light));
    let n_dot_v = clamp(dot(normal, to_camera), 1e-4, 1.0);
    let variance = roughness * roughness;
    let sines = sqrt(max((1.0 - n_dot_l * n_dot_l) * (1.0 - n_dot_v * n_dot_v), 0.0));
    // Cosine between light and camera, both laid down into the surface.
    let azimuth = clamp((dot(to_light, to_camera) - n_dot_l * n_dot_v) / max(sines, 1e-6), -1.0, 1.0);
    let base = 1.0 - 0.5 * variance / (variance + 0.33);
    let towards_light = 0.45 * variance / (variance + 0.09);
    // sin(larger angle) tan(smaller angle) is the product of the sines over the larger cosine.
    let lobe = max(azimuth, 0.0) * sines / max(n_dot_l, n_dot_v);
    // Seen at the horizon, even light returns base + towards_light / 2 of itself, 1% too much for little roughness.
    let reflected = (base + towards_light * lobe) / max(base + 0.5 * towards_light, 1.0);
    return albedo * irradiance * (n_dot_l * MATTE_RADIANCE * reflected);
}

fn oren_nayar_ambient(
    normal: vec3f,
    albedo: vec3f,
    roughness: f32,
    irradiance_harmonics: array<vec4f, 9>,
) -> vec3f {
    // Even surroundings see the base term alone, plus about an eighth of the lobe.
    let variance = roughness * roughness;
    let share = 1.0 - 0.5 * variance / (variance + 0.33) + 0.125 * 0.45 * variance / (variance + 0.09);
    return albedo * environment_irradiance(irradiance_harmonics, normal) * (share * MATTE_RADIANCE);
}

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
}

struct Varyings {
    @builtin(position) clip_position: vec4f,
    @location(0) position_world: vec3f,
    @location(1) normal_world: vec3f,
}

@vertex
fn vs_main(in: Vertex) -> Varyings {
    let world = object.object_to_world * vec4f(in.position, 1.0);
    var out: Varyings;
    out.clip_position = frame.world_to_clip * world;
    out.position_world = world.xyz;
    out.normal_world = normalize((vec4f(in.normal, 0.0) * object.world_to_object).xyz);
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
    // shade: Hard shadow
    let shade_visibility = hard_shadow(
        in.position_world,
        spot_space,
        spot_map,
        nearest_comparison_sampler,
        parameters.shade_bias,
        object.receives,
    );
    let normal_world_unit = normalize(in.normal_world);
    // matte: Lambert, lit by spot
    let matte_spot_radiance = lambert(
        spot.irradiance * shade_visibility,
        spot.direction,
        normal_world_unit,
        parameters.matte_albedo,
    );
    // matte: Lambert
    let matte_ambient_radiance = lambert_ambient(
        normal_world_unit,
        parameters.matte_albedo,
        frame.environment_irradiance,
    );
    let matte_radiance = matte_spot_radiance + matte_ambient_radiance;
    // inverse: Invert
    let inverse_color = max(mix(matte_radiance, vec3f(1.0) - matte_radiance, parameters.inverse_amount), vec3f(0.0));
    // bulb: Point light
    let bulb = point_light(
        in.position_world,
        parameters.bulb_position,
        inverse_color,
        parameters.bulb_intensity,
        parameters.bulb_near,
        parameters.bulb_range,
        parameters.bulb_radius,
    );
    // seen: Oren-Nayar, lit by bulb
    let seen_bulb_radiance = oren_nayar(
        bulb.irradiance,
        bulb.direction,
        normal_world_unit,
        normalize(frame.camera_position - in.position_world),
        parameters.seen_albedo,
        parameters.seen_roughness,
    );
    // seen: Oren-Nayar
    let seen_ambient_radiance = oren_nayar_ambient(
        normal_world_unit,
        parameters.seen_albedo,
        parameters.seen_roughness,
        frame.environment_irradiance,
    );
    return vec4f(seen_bulb_radiance + seen_ambient_radiance, 1.0);
}
