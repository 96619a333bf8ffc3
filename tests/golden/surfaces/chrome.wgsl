// Chrome

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
    chrome_base_color: vec3f,
    chrome_ior: f32,
    chrome_metallic: f32,
    chrome_roughness: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var environment: texture_2d<f32>;
@group(0) @binding(2) var environment_sampler: sampler;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;

const MATTE_RADIANCE: f32 = 0.31830987;

fn normal_reflectance(ior: f32) -> f32 {
    let ratio = (ior - 1.0) / (max(ior, 0.0) + 1.0);
    return ratio * ratio;
}

fn environment_brdf(roughness: f32, n_dot_v: f32) -> vec2f {
    let r = saturate(roughness);
    let m = saturate(n_dot_v);
    let powers = vec3f(1.0, m, m * m);
    let loss = vec3f(
        dot(powers, vec3f(0.1843, 0.8889, -2.4358)),
        dot(powers, vec3f(-0.5612, 0.5383, 4.5730)),
        dot(powers, vec3f(0.4168, -0.3580, -2.1897)),
    );
    let lost = r * r * dot(loss, vec3f(1.0, r, r * r)) / (m + 0.5 * r * r + 0.02);
    let grazing = 1.0 - m;
    let fifth = grazing * grazing * grazing * grazing * grazing;
    let at_grazing = fifth * saturate(1.0288 + 0.5008 * m + r * (2.8817 * m - 0.9173)) / (1.0 + 8.0 * r * r);
    let share = saturate(1.0 - lost);
    return vec2f(max(share - at_grazing, 0.0), min(at_grazing, share));
}

fn environment_uv(direction: vec3f) -> vec2f {
    // atan2 of two zeros is undefined: straight up and down count as forward.
    let pole = abs(direction.x) + abs(direction.z) < 1e-7;
    let turn = atan2(select(direction.x, 0.0, pole), select(-direction.z, 1.0, pole));
    return vec2f(0.5 + turn * 0.15915494, acos(clamp(direction.y, -1.0, 1.0)) * 0.31830987);
}

fn environment_radiance(
    environment: texture_2d<f32>,
    environment_sampler: sampler,
    last_level: f32,
    direction: vec3f,
    roughness: f32,
) -> vec3f {
    let level = saturate(roughness) * last_level;
    return max(textureSampleLevel(environment, environment_sampler, environment_uv(direction), level).rgb, vec3f(0.0));
}

fn environment_irradiance(harmonics: array<vec4f, 9>, normal: vec3f) -> vec3f {
    let n = normal;
    let first = harmonics[0] + n.y * harmonics[1] + n.z * harmonics[2] + n.x * harmonics[3];
    let second = n.x * n.y * harmonics[4] + n.y * n.z * harmonics[5] + (3.0 * n.z * n.z - 1.0) * harmonics[6]
        + n.x * n.z * harmonics[7] + (n.x * n.x - n.y * n.y) * harmonics[8];
    return max((first + second).rgb, vec3f(0.0));
}

fn ggx_ambient(
    normal: vec3f,
    to_camera: vec3f,
    base_color: vec3f,
    metallic: f32,
    roughness: f32,
    ior: f32,
    irradiance_harmonics: array<vec4f, 9>,
    environment: texture_2d<f32>,
    environment_sampler: sampler,
    environment_levels: f32,
) -> vec3f {
    let n_dot_v = saturate(dot(normal, to_camera));
    let at_normal = mix(vec3f(normal_reflectance(ior)), base_color, metallic);
    let response = environment_brdf(roughness, n_dot_v);
    let mirrored = at_normal * response.x + response.y;
    let direction = reflect(-to_camera, normal);
    let sharp = environment_radiance(environment, environment_sampler, environment_levels, direction, roughness);
    let matte = environment_irradiance(irradiance_harmonics, normal) * MATTE_RADIANCE;
    return base_color * (1.0 - metallic) * (1.0 - mirrored) * matte + mirrored * sharp;
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
    // chrome: Metallic-roughness
    let chrome_ambient_radiance = ggx_ambient(
        normalize(in.normal_world),
        normalize(frame.camera_position - in.position_world),
        parameters.chrome_base_color,
        parameters.chrome_metallic,
        parameters.chrome_roughness,
        parameters.chrome_ior,
        frame.environment_irradiance,
        environment,
        environment_sampler,
        frame.environment_levels,
    );
    return vec4f(chrome_ambient_radiance, 1.0);
}
