// Surfaces that depend on no light, as the colour of one

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
    glow_first: vec3f,
    glow_second: vec3f,
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
    // glow: Add surfaces
    let glow_radiance = parameters.glow_first + parameters.glow_second;
    // bulb: Point light
    let bulb = point_light(
        in.position_world,
        parameters.bulb_position,
        glow_radiance,
        parameters.bulb_intensity,
        parameters.bulb_near,
        parameters.bulb_range,
        parameters.bulb_radius,
    );
    return vec4f(bulb.irradiance, 1.0);
}
