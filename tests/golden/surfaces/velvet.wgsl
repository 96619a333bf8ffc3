// Velvet

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
    cloth_albedo: vec3f,
    cloth_roughness: f32,
    cloth_sheen: vec3f,
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

fn velvet_ambient(
    normal: vec3f,
    to_camera: vec3f,
    albedo: vec3f,
    sheen: vec3f,
    roughness: f32,
    irradiance_harmonics: array<vec4f, 9>,
) -> vec3f {
    // Share of even surroundings that the fibres return, fitted to a numeric integral of the lobe (within 0.04).
    let power = 1.0 / clamp(roughness, 0.2, 1.0);
    let n_dot_v = saturate(dot(normal, to_camera));
    let returned = (0.53 + 0.088 * power) * exp(-(1.1 + 0.43 * power) * n_dot_v);
    let strongest = max(sheen.r, max(sheen.g, sheen.b));
    let share = albedo * (1.0 - saturate(strongest)) + sheen * returned;
    return share * environment_irradiance(irradiance_harmonics, normal) * MATTE_RADIANCE;
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
    // cloth: Velvet
    let cloth_ambient_radiance = velvet_ambient(
        normalize(in.normal_world),
        normalize(frame.camera_position - in.position_world),
        parameters.cloth_albedo,
        parameters.cloth_sheen,
        parameters.cloth_roughness,
        frame.environment_irradiance,
    );
    return vec4f(cloth_ambient_radiance, 1.0);
}
