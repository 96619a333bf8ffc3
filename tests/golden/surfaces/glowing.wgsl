// Glowing stripes

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
    glow_color: vec3f,
    matte_albedo: vec3f,
    strength_b: f32,
    stripes_color_a: vec3f,
    stripes_color_b: vec3f,
    stripes_rotation: f32,
    stripes_scale: f32,
    stripes_share: f32,
}

struct StripePoint {
    color: vec3f,
    mask: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;

fn pixel_width1(x: f32) -> f32 {
    return length(vec2f(dpdx(x), dpdy(x)));
}

fn filter_span(width: f32) -> f32 {
    return clamp(width, 1e-3, 1e4);
}

fn pulse_integral(x: f32, duty: f32) -> f32 {
    let whole = floor(x);
    return whole * duty + min(x - whole, duty);
}

fn filtered_pulse(x: f32, duty: f32, width: f32) -> f32 {
    let span = filter_span(width);
    let near_zero = x - floor(x);
    let half_span = 0.5 * span;
    let area = pulse_integral(near_zero + half_span, duty) - pulse_integral(near_zero - half_span, duty);
    return clamp(area / span, 0.0, 1.0);
}

const MATTE_RADIANCE: f32 = 0.31830987;

fn environment_irradiance(harmonics: array<vec4f, 9>, normal: vec3f) -> vec3f {
    let n = normal;
    let first = harmonics[0] + n.y * harmonics[1] + n.z * harmonics[2] + n.x * harmonics[3];
    let second = n.x * n.y * harmonics[4] + n.y * n.z * harmonics[5] + (3.0 * n.z * n.z - 1.0) * harmonics[6]
        + n.x * n.z * harmonics[7] + (n.x * n.x - n.y * n.y) * harmonics[8];
    return max((first + second).rgb, vec3f(0.0));
}

fn stripes(texcoord: vec2f, scale: f32, rotation: f32, share: f32, color_a: vec3f, color_b: vec3f) -> StripePoint {
    let across = dot(texcoord, vec2f(cos(rotation), sin(rotation))) * scale;
    let mask = filtered_pulse(across, clamp(share, 0.0, 1.0), pixel_width1(across));
    return StripePoint(mix(color_b, color_a, mask), mask);
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
    // matte: Lambert
    let matte_ambient_radiance = lambert_ambient(
        normalize(in.normal_world),
        parameters.matte_albedo,
        frame.environment_irradiance,
    );
    // stripes: Stripes
    let stripes_2 = stripes(
        in.texcoord,
        parameters.stripes_scale,
        parameters.stripes_rotation,
        parameters.stripes_share,
        parameters.stripes_color_a,
        parameters.stripes_color_b,
    );
    // strength: Multiply
    let strength_product = stripes_2.mask * parameters.strength_b;
    // glow: Emission
    let glow_radiance = parameters.glow_color * strength_product;
    // sum: Add surfaces
    let sum_radiance = matte_ambient_radiance + glow_radiance;
    return vec4f(sum_radiance, 1.0);
}
