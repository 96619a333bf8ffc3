//! label: Depth map
//! kind: geometry
//! use: light_space
//! Depth of the nearest surface, seen from a light: 0 at its near plane, 1 at its far plane.
//! option size: 64 | 128 | 256 | 512 | 1024 | 2048 | 4096 = 1024 - Texels on a side.
//! option metric: linear | zw | radial = linear - How depth is measured: evenly along the light's axis, as projection matrices leave it, or by the distance from the light. All are linear in parallel light.
//! option cull: none | front | back = none - Sides of triangles that are not drawn: none, those that face the light, or those that face away from it.
//! target: depth32float
//! clear: 1

struct Object {
    world: mat4x4f,
}

@group(0) @binding(0) var<uniform> light: LightSpace;
@group(1) @binding(0) var<uniform> object: Object;

struct Varying {
    @builtin(position) clip: vec4f,
    // Light coordinates. The rasteriser's own depth is not linear in perspective and may carry a bias.
//#if metric == radial
    @location(0) in_light: vec3f,
//#else
    @location(0) distance: f32,
//#end
}

@vertex
fn vs_main(@location(0) position: vec3f) -> Varying {
    let point = (object.world * vec4f(position, 1.0)).xyz;
    let in_light = light_position(light, point);
//#if metric == radial
    return Varying(light_clip_position(light, in_light), in_light);
//#else
    return Varying(light_clip_position(light, in_light), in_light.z);
//#end
}

@fragment
fn fs_main(fragment_in: Varying) -> @builtin(frag_depth) f32 {
//#if metric == linear
    let depth = light_linear_depth(light, fragment_in.distance);
//#elif metric == zw
    let depth = light_depth_zw(light, vec3f(0.0, 0.0, fragment_in.distance));
//#else
    let depth = light_depth_radial(light, fragment_in.in_light);
//#end
    // Only triangles thinner than the rasteriser's grid have fragments before the near plane, which clips, or at a depth
    // that is no number: neither comparison holds for those. They would count as occluders at the light.
    if (!(depth >= -1e-4)) {
        discard;
    }
    return saturate(depth);
}
