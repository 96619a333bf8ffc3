// Spiral

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
    spiral_arms: f32,
    spiral_twist: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;

const MATTE_RADIANCE: f32 = 0.31830987;

fn environment_irradiance(harmonics: array<vec4f, 9>, normal: vec3f) -> vec3f {
    let n = normal;
    let first = harmonics[0] + n.y * harmonics[1] + n.z * harmonics[2] + n.x * harmonics[3];
    let second = n.x * n.y * harmonics[4] + n.y * n.z * harmonics[5] + (3.0 * n.z * n.z - 1.0) * harmonics[6]
        + n.x * n.z * harmonics[7] + (n.x * n.x - n.y * n.y) * harmonics[8];
    return max((first + second).rgb, vec3f(0.0));
}

fn spiral(texcoord: vec2f, arms: f32, twist: f32) -> vec3f {
    let from_center = texcoord - vec2f(0.5);
    let turn = atan2(from_center.y, from_center.x + 1e-6);
    let wave = 0.5 + 0.5 * sin(turn * floor(arms) + length(from_center) * twist);
    return mix(vec3f(0.05, 0.1, 0.3), vec3f(0.9, 0.75, 0.3), smoothstep(0.4, 0.6, wave));
}

fn lambert_ambient(normal: vec3f, albedo: vec3f, irradiance_harmonics: array<vec4f, 9>) -> vec3f {
    return albedo * environment_irradiance(irradiance_harmonics, normal) * MATTE_RADIANCE;
}

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) texcoord: vec2f,
}

struct Varyings {
    @builtin(position) clip_position: vec4f,
    @location(0) normal_world: vec3f,
    @location(1) texcoord: vec2f,
}

@vertex
fn vs_main(in: Vertex) -> Varyings {
    let world = object.object_to_world * vec4f(in.position, 1.0);
    var out: Varyings;
    out.clip_position = frame.world_to_clip * world;
    out.normal_world = normalize((vec4f(in.normal, 0.0) * object.world_to_object).xyz);
    out.texcoord = in.texcoord;
    return out;
}

@fragment
fn fs_main(in: Varyings) -> @location(0) vec4f {
    // spiral: Spiral
    let spiral_color = spiral(in.texcoord, parameters.spiral_arms, parameters.spiral_twist);
    // matte: Lambert
    let matte_ambient_radiance = lambert_ambient(
        normalize(in.normal_world),
        spiral_color,
        frame.environment_irradiance,
    );
    return vec4f(matte_ambient_radiance, 1.0);
}
