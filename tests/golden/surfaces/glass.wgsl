// Glass

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
    glass_ior: f32,
    glass_roughness: f32,
    glass_tint: vec3f,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var environment: texture_2d<f32>;
@group(0) @binding(2) var environment_sampler: sampler;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;

fn fresnel_dielectric(cosine: f32, ior: f32) -> f32 {
    let eta = max(ior, 1e-3);
    let c = saturate(cosine);
    let inside_square = 1.0 - (1.0 - c * c) / (eta * eta);
    let inside = sqrt(max(inside_square, 0.0));
    let across = (c - eta * inside) / max(c + eta * inside, 1e-6);
    let along = (eta * c - inside) / max(eta * c + inside, 1e-6);
    return select(saturate(0.5 * (across * across + along * along)), 1.0, inside_square <= 0.0);
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

fn glass_ambient(
    normal: vec3f,
    to_camera: vec3f,
    tint: vec3f,
    ior: f32,
    roughness: f32,
    environment: texture_2d<f32>,
    environment_sampler: sampler,
    environment_levels: f32,
) -> vec3f {
    let front = fresnel_dielectric(dot(normal, to_camera), ior);
    let mirror = reflect(-to_camera, normal);
    let fresnel = front;
    let through = refract(-to_camera, normal, 1.0 / max(ior, 1.0));
    let mirrored = environment_radiance(environment, environment_sampler, environment_levels, mirror, roughness);
    let passed = environment_radiance(environment, environment_sampler, environment_levels, through, roughness);
    return mix(tint * passed, mirrored, fresnel);
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
    // glass: Glass
    let glass_ambient_radiance = glass_ambient(
        normalize(in.normal_world),
        normalize(frame.camera_position - in.position_world),
        parameters.glass_tint,
        parameters.glass_ior,
        parameters.glass_roughness,
        environment,
        environment_sampler,
        frame.environment_levels,
    );
    return vec4f(glass_ambient_radiance, 1.0);
}
