// What is seen of a surface, in steps

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
    lamp_color: vec3f,
    lamp_intensity: f32,
    lamp_near: f32,
    lamp_position: vec3f,
    lamp_radius: f32,
    lamp_range: f32,
    matte_albedo: vec3f,
    spot_color: vec3f,
    spot_direction: vec3f,
    spot_inner_angle: f32,
    spot_intensity: f32,
    spot_near: f32,
    spot_outer_angle: f32,
    spot_position: vec3f,
    spot_radius: f32,
    spot_range: f32,
    steps_steps: f32,
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

fn lambert(irradiance: vec3f, to_light: vec3f, normal: vec3f, albedo: vec3f) -> vec3f {
    return albedo * irradiance * (saturate(dot(normal, to_light)) * MATTE_RADIANCE);
}

fn lambert_ambient(normal: vec3f, albedo: vec3f, irradiance_harmonics: array<vec4f, 9>) -> vec3f {
    return albedo * environment_irradiance(irradiance_harmonics, normal) * MATTE_RADIANCE;
}

fn posterize(color: vec3f, steps: f32) -> vec3f {
    let count = max(round(steps), 2.0);
    let band = floor(clamp(color, vec3f(0.0), vec3f(1.0)) * count);
    return min(band, vec3f(count - 1.0)) / (count - 1.0);
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
    let normal_world_unit = normalize(in.normal_world);
    // matte: Lambert, lit by spot
    let matte_spot_radiance = lambert(
        spot.irradiance,
        spot.direction,
        normal_world_unit,
        parameters.matte_albedo,
    );
    // lamp: Point light
    let lamp = point_light(
        in.position_world,
        parameters.lamp_position,
        parameters.lamp_color,
        parameters.lamp_intensity,
        parameters.lamp_near,
        parameters.lamp_range,
        parameters.lamp_radius,
    );
    // matte: Lambert, lit by lamp
    let matte_lamp_radiance = lambert(
        lamp.irradiance,
        lamp.direction,
        normal_world_unit,
        parameters.matte_albedo,
    );
    // matte: Lambert
    let matte_ambient_radiance = lambert_ambient(
        normal_world_unit,
        parameters.matte_albedo,
        frame.environment_irradiance,
    );
    // steps: Posterize
    let steps_color = posterize(
        matte_spot_radiance + matte_lamp_radiance + matte_ambient_radiance,
        parameters.steps_steps,
    );
    // flat: Unlit
    let flat_radiance = steps_color;
    return vec4f(flat_radiance, 1.0);
}
