// Sun

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
    sun_angle: f32,
    sun_center: vec3f,
    sun_color: vec3f,
    sun_direction: vec3f,
    sun_intensity: f32,
    sun_radius: f32,
}

struct DirectionalLight {
    irradiance: vec3f,
    direction: vec3f,
    distance: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;

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
    return vec4f(sun.irradiance, 1.0);
}
