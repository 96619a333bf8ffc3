// Bumpy glass

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
    bump_amplitude: f32,
    bump_strength: f32,
    glass_ior: f32,
    glass_roughness: f32,
    glass_tint: vec3f,
    noise_gain: f32,
    noise_lacunarity: f32,
    noise_scale: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var environment: texture_2d<f32>;
@group(0) @binding(2) var environment_sampler: sampler;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;

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

fn unit_normal_or(v: vec3f, otherwise: vec3f) -> vec3f {
    let squared = dot(v, v);
    return select(otherwise, v * inverseSqrt(max(squared, 1e-36)), squared > 1e-30);
}

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

const OCTAVES: i32 = 3;

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

fn bump(height: f32, amplitude: f32, strength: f32, position: vec3f, normal: vec3f) -> vec3f {
    let smooth_normal = unit_normal_or(normal, vec3f(0.0, 1.0, 0.0));
    let right = dpdx(position);
    let down = dpdy(position);
    let rise = vec2f(dpdx(height), dpdy(height)) * amplitude * strength;
    // Vectors in the tangent plane, each perpendicular to the other screen direction.
    let along_right = cross(down, smooth_normal);
    let along_down = cross(smooth_normal, right);
    let area = dot(right, along_right);
    let gradient = sign(area) * (rise.x * along_right + rise.y * along_down);
    return unit_normal_or(abs(area) * smooth_normal - gradient, smooth_normal);
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
    // noise: Fractal Noise 3D
    let noise = fbm3d(
        in.position_object,
        parameters.noise_scale,
        parameters.noise_lacunarity,
        parameters.noise_gain,
    );
    // bump: Bump
    let bump_normal = bump(
        noise,
        parameters.bump_amplitude,
        parameters.bump_strength,
        in.position_world,
        in.normal_world,
    );
    // glass: Glass
    let glass_ambient_radiance = glass_ambient(
        bump_normal,
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
