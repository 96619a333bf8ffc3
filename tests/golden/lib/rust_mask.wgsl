// Rust mask

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
    border_high: f32,
    border_low: f32,
    patches_gain: f32,
    patches_lacunarity: f32,
    patches_scale: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
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

struct Vertex {
    @location(0) position: vec3f,
}

struct Varyings {
    @builtin(position) clip_position: vec4f,
    @location(0) position_object: vec3f,
}

@vertex
fn vs_main(in: Vertex) -> Varyings {
    let world = object.object_to_world * vec4f(in.position, 1.0);
    var out: Varyings;
    out.clip_position = frame.world_to_clip * world;
    out.position_object = in.position;
    return out;
}

@fragment
fn fs_main(in: Varyings) -> @location(0) vec4f {
    // patches: Fractal Noise 3D
    let patches = fbm3d(
        in.position_object,
        parameters.patches_scale,
        parameters.patches_lacunarity,
        parameters.patches_gain,
    );
    // border: Smoothstep
    let border_stepped = smooth_step_f32(patches, parameters.border_low, parameters.border_high);
    return vec4f(vec3f(border_stepped), 1.0);
}
