//! label: Four moments map
//! kind: geometry
//! use: light_space, hamburger
//! Depth from -1 to 1 and its second, third and fourth power, seen from a light: what a moment shadow map filters (Peters and Klein 2015).
//! option size: 64 | 128 | 256 | 512 | 1024 | 2048 | 4096 = 1024 - Texels on a side.
//! option metric: linear | zw | radial = linear - How depth is measured: evenly along the light's axis, as projection matrices leave it, or by the distance from the light.
//! option cull: none | front | back = none - Sides of triangles that are not drawn.
//! option samples: 1 | 4 = 1 - Places within a texel at which triangles are drawn, where the format can be resolved to their mean.
//! option format: auto | float32 | unorm16 = float32 - Bits of each moment. unorm16 and auto mix them to use the range from 0 to 1 evenly.
//#if format == float32
//! target: rgba32float
//! clear: 1 1 1 1
//#else
//! clear: 0 0 0.9811252 1
//#if format == auto
//! target: rgba32float | rgba16unorm
//#else
//! target: rgba16unorm
//#end
//#end

struct Object {
    world: mat4x4f,
}

@group(0) @binding(0) var<uniform> light: LightSpace;
@group(1) @binding(0) var<uniform> object: Object;

struct Varying {
    @builtin(position) clip: vec4f,
    // Light coordinates. Depth is taken from here, as the rasteriser's own is not linear and may carry a bias.
//#if samples == 4
    // Never outside the triangle, where depth may be anything.
    @location(0) @interpolate(perspective, centroid) in_light: vec3f,
//#else
    @location(0) in_light: vec3f,
//#end
}

@vertex
fn vs_main(@location(0) position: vec3f) -> Varying {
    let point = (object.world * vec4f(position, 1.0)).xyz;
    let in_light = light_position(light, point);
    return Varying(light_clip_position(light, in_light), in_light);
}

@fragment
fn fs_main(fragment_in: Varying) -> @location(0) vec4f {
//#if metric == linear
    let measured = light_depth_linear(light, fragment_in.in_light);
//#elif metric == zw
    let measured = light_depth_zw(light, fragment_in.in_light);
//#else
    let measured = light_depth_radial(light, fragment_in.in_light);
//#end
    let depth = 2.0 * saturate(measured) - 1.0;
    let square = depth * depth;
    let moments = vec4f(depth, square, depth * square, square * square);
//#if format == float32
    return moments;
//#else
    return encode_moments(moments);
//#end
}
