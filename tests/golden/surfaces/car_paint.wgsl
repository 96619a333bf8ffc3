// Car paint

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
    coat_ior: f32,
    coat_roughness: f32,
    coat_strength: f32,
    flakes_scale: f32,
    flakes_seed: f32,
    paint_ior: f32,
    paint_metallic: f32,
    paint_roughness: f32,
    tone_end: f32,
    tone_high: vec3f,
    tone_low: vec3f,
    tone_start: f32,
}

struct WhiteNoisePoint {
    value: f32,
    color: vec3f,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var environment: texture_2d<f32>;
@group(0) @binding(2) var environment_sampler: sampler;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;

fn pcg3d(seed: vec3u) -> vec3u {
    var v = seed * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

fn hash_cell3(corner: vec3f) -> vec3u {
    return pcg3d(bitcast<vec3u>(vec3i(corner)));
}

fn hash_to_unit(hash: u32) -> f32 {
    return f32(hash >> 8u) * 5.9604645e-8;
}

fn hash_to_unit3(hash: vec3u) -> vec3f {
    return vec3f(hash >> vec3u(8u)) * 5.9604645e-8;
}

fn pixel_width3(x: vec3f) -> vec3f {
    let across = dpdx(x);
    let down = dpdy(x);
    return sqrt(across * across + down * down);
}

fn detail_left(width: f32) -> f32 {
    return clamp(2.0 - 4.0 * width, 0.0, 1.0);
}

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

fn white_noise(position: vec3f, scale: f32, seed: f32) -> WhiteNoisePoint {
    // A face that lies exactly on a cube boundary would be torn between both cubes by rounding.
    let cell = floor(position * scale + 1e-3);
    let first = pcg3d(hash_cell3(cell) ^ vec3u(bitcast<u32>(i32(seed))));
    let width = pixel_width3(position * scale);
    // Full contrast down to cubes of two pixels, none below one: a pixel would see one of many cubes at random.
    let contrast = detail_left(0.5 * max(width.x, max(width.y, width.z)));
    let value = 0.5 + contrast * (hash_to_unit(first.x) - 0.5);
    return WhiteNoisePoint(value, 0.5 + contrast * (hash_to_unit3(pcg3d(first)) - 0.5));
}

fn color_ramp2(factor: f32, low: vec3f, high: vec3f, start: f32, end: f32) -> vec3f {
    let span = select(end - start, 1e-6, end == start);
    let t = clamp((factor - start) / span, 0.0, 1.0);
    return mix(low, high, t);
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

fn clear_coat_ambient(
    base: vec3f,
    normal: vec3f,
    to_camera: vec3f,
    strength: f32,
    roughness: f32,
    ior: f32,
    environment: texture_2d<f32>,
    environment_sampler: sampler,
    environment_levels: f32,
) -> vec3f {
    let at_normal = normal_reflectance(ior);
    let n_dot_v = saturate(dot(normal, to_camera));
    let response = environment_brdf(roughness, n_dot_v);
    let mirrored = at_normal * response.x + response.y;
    let direction = reflect(-to_camera, normal);
    let sharp = environment_radiance(environment, environment_sampler, environment_levels, direction, roughness);
    // Light enters from everywhere: the mean of Schlick's Fresnel over the hemisphere is F0 + (1 - F0) / 21.
    let lost_entering = at_normal + (1.0 - at_normal) / 21.0;
    let entered = (1.0 - lost_entering) * (1.0 - mirrored);
    return mix(base, base * entered + mirrored * sharp, saturate(strength));
}

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
}

struct Varyings {
    @builtin(position) clip_position: vec4f,
    @location(0) position_world: vec3f,
    @location(1) position_object: vec3f,
    @location(2) normal_world: vec3f,
}

@vertex
fn vs_main(in: Vertex) -> Varyings {
    let world = object.object_to_world * vec4f(in.position, 1.0);
    var out: Varyings;
    out.clip_position = frame.world_to_clip * world;
    out.position_world = world.xyz;
    out.position_object = in.position;
    out.normal_world = normalize((vec4f(in.normal, 0.0) * object.world_to_object).xyz);
    return out;
}

@fragment
fn fs_main(in: Varyings) -> @location(0) vec4f {
    let normal_world_unit = normalize(in.normal_world);
    let to_camera = normalize(frame.camera_position - in.position_world);
    // flakes: White Noise
    let flakes = white_noise(in.position_object, parameters.flakes_scale, parameters.flakes_seed);
    // tone: Color Ramp
    let tone_color = color_ramp2(
        flakes.value,
        parameters.tone_low,
        parameters.tone_high,
        parameters.tone_start,
        parameters.tone_end,
    );
    // paint: Metallic-roughness
    let paint_ambient_radiance = ggx_ambient(
        normal_world_unit,
        to_camera,
        tone_color,
        parameters.paint_metallic,
        parameters.paint_roughness,
        parameters.paint_ior,
        frame.environment_irradiance,
        environment,
        environment_sampler,
        frame.environment_levels,
    );
    // coat: Clear coat
    let coat_ambient_radiance = clear_coat_ambient(
        paint_ambient_radiance,
        normal_world_unit,
        to_camera,
        parameters.coat_strength,
        parameters.coat_roughness,
        parameters.coat_ior,
        environment,
        environment_sampler,
        frame.environment_levels,
    );
    return vec4f(coat_ambient_radiance, 1.0);
}
