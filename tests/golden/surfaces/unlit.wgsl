// Unlit

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
    flat_color: vec3f,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;

struct Vertex {
    @location(0) position: vec3f,
}

struct Varyings {
    @builtin(position) clip_position: vec4f,
}

@vertex
fn vs_main(in: Vertex) -> Varyings {
    let world = object.object_to_world * vec4f(in.position, 1.0);
    var out: Varyings;
    out.clip_position = frame.world_to_clip * world;
    return out;
}

@fragment
fn fs_main(in: Varyings) -> @location(0) vec4f {
    // flat: Unlit
    let flat_radiance = parameters.flat_color;
    return vec4f(flat_radiance, 1.0);
}
