//! label: Moment map
//! kind: geometry
//! use: light_space
//! Mean and mean square of linear depth, seen from a light: what a variance shadow map filters (Donnelly and Lauritzen 2006, section 3).
//! option size: 256 | 512 | 1024 | 2048 | 4096 = 1024 - Texels on a side.
//! option slope: off | on = on - Add the variance of depth inside one texel of a sloping surface.
//! option format: auto | rg32float | rg16unorm | rg16float = auto - Storage of the two moments; auto takes the best that the device can filter.
//! target: rg32float | rg16unorm | rg16float
//! clear: 1 1

struct Object {
    world: mat4x4f,
}

@group(0) @binding(0) var<uniform> light: LightSpace;
@group(1) @binding(0) var<uniform> object: Object;

struct Varying {
    @builtin(position) clip: vec4f,
    // Light coordinates. Depth is taken from here, as the rasteriser's own is not linear and may carry a bias.
    @location(0) in_light: vec3f,
}

//#if slope == on
/// Steepest surface, in metres of depth per metre across, whose slope is believed. Steeper ones are silhouettes, whose
/// triangles run through the whole scene within a texel.
const MAX_SLOPE: f32 = 8.0;

/// Variance of depth over one texel of a plane: (dx^2 + dy^2) / 12, of a box one texel wide (GPU Gems 3, chapter 8,
/// uses 1/4, of a Gaussian of half a texel).
fn texel_variance(in_light: vec3f) -> f32 {
    let ray = light_ray(light, in_light);
    let texel = fwidth(ray) * select(1.0, in_light.z, light.projection.z > 0.5);
    let steepest = texel * MAX_SLOPE;
    let change = vec2f(dpdx(in_light.z), dpdy(in_light.z));
    let bounded = clamp(change, -steepest, steepest) * light.depth.z;
    return dot(bounded, bounded) * (1.0 / 12.0);
}

//#end
@vertex
fn vs_main(@location(0) position: vec3f) -> Varying {
    let point = (object.world * vec4f(position, 1.0)).xyz;
    let in_light = light_position(light, point);
    return Varying(light_clip_position(light, in_light), in_light);
}

@fragment
fn fs_main(fragment_in: Varying) -> @location(0) vec2f {
    // Surfaces that run through the far plane go on beyond it: a filter across it would take a bend for an edge.
    let depth = max(light_linear_depth(light, fragment_in.in_light.z), 0.0);
//#if slope == on
    // Depths in [0, 1] have a mean square of at most their mean.
    let square = depth * depth;
    let mean_square = min(square + texel_variance(fragment_in.in_light), max(depth, square));
//#else
    let mean_square = depth * depth;
//#end
    return vec2f(depth, mean_square);
}
