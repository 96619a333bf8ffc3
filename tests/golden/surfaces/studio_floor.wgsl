// Studio floor

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
    backdrop_color: vec3f,
    fade_high: f32,
    fade_low: f32,
    matte_albedo: vec3f,
    rim_center: vec2f,
    rim_end_color: vec3f,
    rim_radius: f32,
    rim_start_color: vec3f,
}

struct RadialRampPoint {
    color: vec3f,
    value: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> object: Object;
@group(2) @binding(0) var<uniform> parameters: Parameters;

fn ramp_share(x: f32, start: f32, end: f32) -> f32 {
    let span = end - start;
    // The smallest span keeps its sign, so that reversed ramps stay reversed.
    let safe_span = select(span, select(1e-6, -1e-6, span < 0.0), abs(span) < 1e-6);
    return clamp((x - start) / safe_span, 0.0, 1.0);
}

const MATTE_RADIANCE: f32 = 0.31830987;

fn environment_irradiance(harmonics: array<vec4f, 9>, normal: vec3f) -> vec3f {
    let n = normal;
    let first = harmonics[0] + n.y * harmonics[1] + n.z * harmonics[2] + n.x * harmonics[3];
    let second = n.x * n.y * harmonics[4] + n.y * n.z * harmonics[5] + (3.0 * n.z * n.z - 1.0) * harmonics[6]
        + n.x * n.z * harmonics[7] + (n.x * n.x - n.y * n.y) * harmonics[8];
    return max((first + second).rgb, vec3f(0.0));
}

fn ramp_radial(texcoord: vec2f, center: vec2f, radius: f32, start_color: vec3f, end_color: vec3f) -> RadialRampPoint {
    let along = ramp_share(length(texcoord - center), 0.0, radius);
    let value = along;
    return RadialRampPoint(mix(start_color, end_color, value), value);
}

fn lambert_ambient(normal: vec3f, albedo: vec3f, irradiance_harmonics: array<vec4f, 9>) -> vec3f {
    return albedo * environment_irradiance(irradiance_harmonics, normal) * MATTE_RADIANCE;
}

fn smooth_step_f32(x: f32, low: f32, high: f32) -> f32 {
    let span = high - low;
    let none = span == f32(0.0);
    let t = clamp((x - low) / select(span, f32(1.0), none), f32(0.0), f32(1.0));
    return select(t * t * (3.0 - 2.0 * t), step(low, x), none);
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
    // backdrop: Unlit
    let backdrop_radiance = parameters.backdrop_color;
    // rim: Radial Ramp
    let rim = ramp_radial(
        in.texcoord,
        parameters.rim_center,
        parameters.rim_radius,
        parameters.rim_start_color,
        parameters.rim_end_color,
    );
    // fade: Smoothstep
    let fade_stepped = smooth_step_f32(rim.value, parameters.fade_low, parameters.fade_high);
    // floor: Mix surfaces
    let floor_radiance = mix(matte_ambient_radiance, backdrop_radiance, saturate(fade_stepped));
    return vec4f(floor_radiance, 1.0);
}
