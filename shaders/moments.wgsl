//! label: Moment map
//! kind: geometry
//! use: light_space, texel_variance, split_halves
//! Mean and mean square of depth, seen from a light: what a variance shadow map filters (Donnelly and Lauritzen 2006, section 3).
//! option size: 64 | 128 | 256 | 512 | 1024 | 2048 | 4096 = 1024 - Texels on a side.
//! option slope: off | on = on - Add the variance of depth inside one texel of a sloping surface.
//! option metric: linear | zw | radial = linear - How depth is measured: evenly along the light's axis, as projection matrices leave it, or by the distance from the light. All are linear in parallel light.
//! option cull: none | front | back = none - Sides of triangles that are not drawn: none, those that face the light, or those that face away from it.
//! option samples: 1 | 4 = 1 - Places within a texel at which triangles are drawn, where the format can be resolved to their mean.
//! option second: square | deviation = square - What stands beside the mean. Standard deviations are not linear: any filter over them is wrong.
//! option range: unit | signed = unit - Depth from 0 to 1, or from -1 to 1, which lends the sign bit of floats to precision. Formats without a sign keep 0 to 1.
//! option format: auto | rg32float | rg16unorm | rg16float | split = auto - Storage of the two moments. auto takes the best that the device can filter; split holds each in two halves.
//#if format == split
//! target: rgba16float
//! clear: 1 0 1 0
//#else
//#if range == signed
//#if format == rg16unorm
//! target: rg16unorm
//#else
//! target: rg32float | rg16float
//#end
//#else
//! target: rg32float | rg16unorm | rg16float
//#end
//#if second == square
//! clear: 1 1
//#else
//! clear: 1 0
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
//#if format == split
fn fs_main(fragment_in: Varying) -> @location(0) vec4f {
//#else
fn fs_main(fragment_in: Varying) -> @location(0) vec2f {
//#end
    let in_light = fragment_in.in_light;
    // Surfaces that run through the far plane go on beyond it: a filter across it would take a bend for an edge.
//#if metric == linear
    let depth = max(light_depth_linear(light, in_light), 0.0);
//#elif metric == zw
    let depth = max(light_depth_zw(light, in_light), 0.0);
//#else
    let depth = max(light_depth_radial(light, in_light), 0.0);
//#end
//#if slope == on
//#if metric == linear
    let variance = texel_variance(light, in_light);
//#else
//#if metric == zw
    let scale = light_scale_zw(light, in_light);
//#else
    let scale = light_scale_radial(light, in_light);
//#end
    let variance = texel_variance(light, in_light) * scale * scale;
//#end
    // Depths in [0, 1] have a mean square of at most their mean.
    let square = depth * depth;
    let mean_square = min(square + variance, max(depth, square));
//#else
    let mean_square = depth * depth;
//#end
    var moments = vec2f(depth, mean_square);
//#if second == deviation
    moments.y = sqrt(max(mean_square - depth * depth, 0.0));
//#elif range == signed
//#if format != rg16unorm
    moments = vec2f(2.0 * depth - 1.0, 4.0 * (mean_square - depth) + 1.0);
//#end
//#end
//#if format == split
    return split_halves(moments);
//#else
    return moments;
//#end
}
