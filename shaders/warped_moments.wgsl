//! label: Warped moment map
//! kind: geometry
//! use: light_space, texel_variance, exponential_warp
//! Exponentials of depth, seen from a light: what exponential shadow maps (Annen et al. 2008; Salvi 2008) and exponential variance shadow maps (Lauritzen and McCool 2008) filter.
//! option size: 64 | 128 | 256 | 512 | 1024 | 2048 | 4096 = 1024 - Texels on a side.
//! option moments: mean | one | two = mean - The exponential alone; with its square; or both of the rising and of the falling exponential.
//! option exponent: 5 | 5.54 | 10 | 11 | 15 | 20 | 30 | 40 | 42 | 80 = 40 - How fast it rises: e^(c depth) for the mean, e^(c (2 depth - 1)) for pairs. No more than the format holds: 42 (80 alone) in 32 bits, 5.54 (11 alone) in 16.
//! option falling: 5 | 5.54 | 10 | 20 | 40 = 5 - The same of the falling exponential.
//! option domain: plain | log = plain - What stands for the mean: the exponential, or its logarithm over c, which is depth.
//! option slope: off | on = on - Add the variance of depth inside one texel of a sloping surface.
//! option metric: linear | zw | radial = linear - How depth is measured: evenly along the light's axis, as projection matrices leave it, or by the distance from the light.
//! option cull: none | front | back = none - Sides of triangles that are not drawn.
//! option samples: 1 | 4 = 1 - Places within a texel at which triangles are drawn, where the format can be resolved to their mean.
//! option format: auto | float32 | float16 = float32 - Bits of each number. auto takes what the device can filter, and exponents that fit both.
//#if moments == mean
//#if domain == log
//! clear: 1
//#elif format == float32
//! clear: 1
//#else
//! clear: 32768
//#end
//#if format == auto
//! target: r32float | r16float
//#elif format == float32
//! target: r32float
//#else
//! target: r16float
//#end
//#elif moments == one
//#if format == auto
//! target: rg32float | rg16float
//! clear: 240 57600
//#elif format == float32
//! target: rg32float
//! clear: 1152921504606846976 1329227995784915872903807060280344576
//#else
//! target: rg16float
//! clear: 240 57600
//#end
//#else
//#if format == auto
//! target: rgba32float | rgba16float
//! clear: 240 57600 -0.00390625 0.0000152587890625
//#elif format == float32
//! target: rgba32float
//#if falling == 40
//! clear: 1152921504606846976 1329227995784915872903807060280344576 -5.551115123125783e-17 3.0814879110195774e-33
//#else
//! clear: 1152921504606846976 1329227995784915872903807060280344576 -1 1
//#end
//#else
//! target: rgba16float
//! clear: 240 57600 -0.00390625 0.0000152587890625
//#end
//#end

struct Object {
    world: mat4x4f,
}

@group(0) @binding(0) var<uniform> light: LightSpace;
@group(1) @binding(0) var<uniform> object: Object;

const EXPONENT: f32 = 40.0;
//#if moments == two
const FALLING: f32 = 5.0;
//#end

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
//#if moments == mean
fn fs_main(fragment_in: Varying) -> @location(0) f32 {
//#elif moments == one
fn fs_main(fragment_in: Varying) -> @location(0) vec2f {
//#else
fn fs_main(fragment_in: Varying) -> @location(0) vec4f {
//#end
    let in_light = fragment_in.in_light;
//#if metric == linear
    let measured = light_depth_linear(light, in_light);
//#elif metric == zw
    let measured = light_depth_zw(light, in_light);
//#else
    let measured = light_depth_radial(light, in_light);
//#end
    // Exponentials of what is beyond the far plane would overflow, and those of no number at all would spread.
    if (!(measured > -0.5)) {
        discard;
    }
    let depth = saturate(measured);
//#if moments == mean
//#if domain == log
    return depth;
//#elif format == float32
    return exp(EXPONENT * (depth - 1.0));
//#else
    return 32768.0 * exp(min(EXPONENT, 2.0 * HALF_EXPONENT) * (depth - 1.0));
//#end
//#else
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
//#else
    let variance = 0.0;
//#end
//#if format == float32
    let exponent = min(EXPONENT, SINGLE_EXPONENT);
    let far = SINGLE_RISING_FAR;
//#else
    let exponent = min(EXPONENT, HALF_EXPONENT);
    let far = HALF_RISING_FAR;
//#end
    let rising = rising_warp(depth, exponent, far);
    // The warp stretches what is near it by its slope, 2 c times its value. The product of both squares would overflow.
    let stretch = 2.0 * exponent;
    let rising_square = min(rising * rising * (1.0 + stretch * stretch * variance), far * rising);
//#if moments == one
    return vec2f(rising, rising_square);
//#else
//#if format == float32
    let exponent_2 = min(FALLING, SINGLE_EXPONENT);
    let far_2 = single_falling_far(exponent_2);
//#else
    let exponent_2 = min(FALLING, HALF_EXPONENT);
    let far_2 = HALF_FALLING_FAR;
//#end
    let falling = falling_warp(depth, exponent_2, far_2);
    let stretch_2 = 2.0 * exponent_2;
    let nearest = falling_warp(0.0, exponent_2, far_2);
    let falling_square = min(falling * falling * (1.0 + stretch_2 * stretch_2 * variance), nearest * falling);
    return vec4f(rising, rising_square, falling, falling_square);
//#end
//#end
}
