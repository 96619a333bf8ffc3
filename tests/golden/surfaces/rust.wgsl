// Rusty iron

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
    iron_base_color: vec3f,
    iron_ior: f32,
    iron_metallic: f32,
    iron_roughness: f32,
    border_high: f32,
    border_low: f32,
    patches_gain: f32,
    patches_lacunarity: f32,
    patches_scale: f32,
    rust_albedo: vec3f,
    rust_roughness: f32,
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

fn pixel_width3(x: vec3f) -> vec3f {
    let across = dpdx(x);
    let down = dpdy(x);
    return sqrt(across * across + down * down);
}

fn detail_left(width: f32) -> f32 {
    return clamp(2.0 - 4.0 * width, 0.0, 1.0);
}

fn octave_shift3(octave: i32) -> vec3f {
    return vec3f(17.31, 5.77, 11.19) * f32(octave);
}

fn octave_footprint3(p: vec3f) -> f32 {
    let width = pixel_width3(p);
    return max(width.x, max(width.y, width.z));
}

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

fn lattice_gradient3(hash: u32, offset: vec3f) -> f32 {
    let choice = hash % 12u;
    let first = select(offset.x, offset.y, choice >= 8u);
    let second = select(offset.z, offset.y, choice < 4u);
    return select(first, -first, (choice & 1u) != 0u) + select(second, -second, (choice & 2u) != 0u);
}

fn quintic_fade3(t: vec3f) -> vec3f {
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

fn perlin_corner3(cell: vec3f, f: vec3f, corner: vec3f) -> f32 {
    return lattice_gradient3(hash_cell3(cell + corner).x, f - corner);
}

fn perlin_side3(cell: vec3f, f: vec3f, x: f32) -> vec4f {
    return vec4f(
        perlin_corner3(cell, f, vec3f(x, 0.0, 0.0)),
        perlin_corner3(cell, f, vec3f(x, 1.0, 0.0)),
        perlin_corner3(cell, f, vec3f(x, 0.0, 1.0)),
        perlin_corner3(cell, f, vec3f(x, 1.0, 1.0)),
    );
}

fn perlin_noise3(p: vec3f) -> f32 {
    let cell = floor(p);
    let f = p - cell;
    let w = quintic_fade3(f);
    let x = mix(perlin_side3(cell, f, 0.0), perlin_side3(cell, f, 1.0), w.x);
    let y = mix(x.xz, x.yw, w.y);
    return mix(y.x, y.y, w.z) * 0.9649214;
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

const OCTAVES: i32 = 5;

fn fbm3d(position: vec3f, scale: f32, lacunarity: f32, gain: f32) -> f32 {
    let base = position * scale;
    let footprint = octave_footprint3(base);
    var sum = 0.0;
    var total = 0.0;
    var amplitude = 1.0;
    var frequency = 1.0;
    for (var octave = 0; octave < OCTAVES; octave++) {
        let p = base * frequency + octave_shift3(octave);
        let noise = perlin_noise3(p);
        sum += amplitude * noise * detail_left(footprint * frequency);
        total += amplitude;
        amplitude *= gain;
        frequency *= lacunarity;
    }
    return clamp(0.5 + 0.5 * sum / total, 0.0, 1.0);
}

fn smooth_step_f32(x: f32, low: f32, high: f32) -> f32 {
    let span = high - low;
    let none = span == f32(0.0);
    let t = clamp((x - low) / select(span, f32(1.0), none), f32(0.0), f32(1.0));
    return select(t * t * (3.0 - 2.0 * t), step(low, x), none);
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
    // iron: Metallic-roughness
    let iron_ambient_radiance = ggx_ambient(
        normal_world_unit,
        normalize(frame.camera_position - in.position_world),
        parameters.iron_base_color,
        parameters.iron_metallic,
        parameters.iron_roughness,
        parameters.iron_ior,
        frame.environment_irradiance,
        environment,
        environment_sampler,
        frame.environment_levels,
    );
    // rust: Oren-Nayar
    let rust_ambient_radiance = oren_nayar_ambient(
        normal_world_unit,
        parameters.rust_albedo,
        parameters.rust_roughness,
        frame.environment_irradiance,
    );
    // mask/patches: Fractal Noise 3D
    let patches = fbm3d(
        in.position_object,
        parameters.patches_scale,
        parameters.patches_lacunarity,
        parameters.patches_gain,
    );
    // mask/border: Smoothstep
    let border_stepped = smooth_step_f32(patches, parameters.border_low, parameters.border_high);
    // mix: Mix surfaces
    let mix_radiance = mix(iron_ambient_radiance, rust_ambient_radiance, saturate(border_stepped));
    return vec4f(mix_radiance, 1.0);
}
