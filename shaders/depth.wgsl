//! label: Depth map
//! kind: geometry
//! use: light_space
//! Linear depth of the nearest surface, seen from a light: 0 at its near plane, 1 at its far plane.
//! option size: 256 | 512 | 1024 | 2048 | 4096 = 1024 - Texels on a side.
//! target: depth32float
//! clear: 1

struct Object {
    world: mat4x4f,
}

@group(0) @binding(0) var<uniform> light: LightSpace;
@group(1) @binding(0) var<uniform> object: Object;

struct Varying {
    @builtin(position) clip: vec4f,
    // Light coordinate z. The rasteriser's own depth is not linear in perspective and may carry a bias.
    @location(0) distance: f32,
}

@vertex
fn vs_main(@location(0) position: vec3f) -> Varying {
    let point = (object.world * vec4f(position, 1.0)).xyz;
    let in_light = light_position(light, point);
    return Varying(light_clip_position(light, in_light), in_light.z);
}

@fragment
fn fs_main(fragment_in: Varying) -> @builtin(frag_depth) f32 {
    return saturate(light_linear_depth(light, fragment_in.distance));
}
