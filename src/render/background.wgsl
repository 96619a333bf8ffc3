// The surroundings behind everything: an equirectangular picture, +y at the top and -z in the middle.

struct View {
    // Half the picture's width at distance 1, its half height, and where the camera looks; xyz in world space.
    right: vec4f,
    up: vec4f,
    forward: vec4f,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var surroundings: texture_2d<f32>;
@group(0) @binding(2) var surroundings_sampler: sampler;

struct Varying {
    @builtin(position) clip: vec4f,
    @location(0) screen: vec2f,
}

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> Varying {
    let corner = vec2f(f32(vertex & 1u), f32(vertex >> 1u)) * 4.0 - 1.0;
    return Varying(vec4f(corner, 1.0, 1.0), corner);
}

@fragment
fn fs_main(in: Varying) -> @location(0) vec4f {
    let ray = normalize(view.forward.xyz + in.screen.x * view.right.xyz + in.screen.y * view.up.xyz);
    let u = 0.5 + atan2(ray.x, -ray.z) / 6.283185307;
    let v = acos(clamp(ray.y, -1.0, 1.0)) / 3.141592654;
    return vec4f(textureSampleLevel(surroundings, surroundings_sampler, vec2f(u, v), 0.0).rgb, 1.0);
}
