//! label: Exponential variance shadow
//! category: shadow
//! synonyms: evsm, evsm2, evsm4, exponential variance shadow map, soft shadow, filtered shadow, blurred shadow
//! use: light_space, chebyshev, map_footprint, exponential_warp, receiver_within
//! Shadow from the mean and variance of an exponential of depth, in which distances between occluders shrink to next to nothing beside that to the receiver: variance shadow mapping without light bleeding (Lauritzen and McCool 2008). Where a part of the filter lies behind the receiver, the exponential makes it count for more than it is; a second, falling exponential bounds that.
//! option warps: one | two = two - The rising exponential alone, in two numbers a texel, or the falling one as well, in four. One is falsely lit where what lies behind the receiver comes into the filter.
//! option exponent: 5 | 5.54 | 10 | 15 | 20 | 30 | 40 | 42 = 40 - c of the rising exponential e^(c (2 depth - 1)). 32 bits hold 42 at most, 16 bits 5.54, and are given no more.
//! option falling: 5 | 5.54 | 10 | 20 | 40 = 5 - The same of the falling exponential.
//! option format: auto | float32 | float16 = float32 - Bits of each number. auto takes what the device can filter, with exponents of at most 5.54, as it may be 16. Devices that cannot filter 32 bits need float16 or manual sampling.
//! option width: 1 | 3 | 5 | 7 | 9 | 11 | 13 | 15 | 17 | 19 | 21 | 23 | 25 = 5 - Texels across the blur of the map, in the coarsest view of a light with splits: the others are blurred as widely in metres.
//! option weights: gaussian | box | tent = gaussian - Shape of the blur.
//! option size: 64 | 128 | 256 | 512 | 1024 | 2048 | 4096 = 1024 - Texels on a side of the map.
//! option downsample: 1 | 2 | 4 = 1 - Texels that are averaged before the blur, on a side.
//! option samples: 1 | 4 = 1 - Places within a texel at which occluders are drawn; where the format cannot be resolved, one.
//! option cull: none | front | back = none - Sides of triangles that cast no shadow: none, those that face the light (shadows shrink by the thickness of what casts them), or those that face away.
//! option metric: linear | zw | radial = linear - How depth is measured: evenly along the light's axis, as projection matrices leave it, or by the distance from the light.
//! option mips: on | off = on - Filter over the pixel's footprint, so that far shadows do not shimmer. Off: one bilinear fetch.
//! option sampling: taps | hardware | manual = taps - Trilinear taps along the pixel's footprint, the same on all devices; one anisotropic fetch of the sampler; or taps interpolated in the shader, exactly, for formats that the device cannot filter.
//! option filter: linear | trilinear = trilinear - Blend between mip levels or take the nearer.
//! option anisotropy: 1 | 4 | 8 | 16 = 16 - Longest footprint, in widths, that is followed at grazing views. With hardware sampling, more than 1 needs trilinear and mips.
//! option slope_variance: on | off = on - Count the slope of a surface within one texel as variance, which spares slopes from shadowing themselves.
//! map map: warped_moments(moments=$warps, size=$size, exponent=$exponent, falling=$falling, slope=$slope_variance, metric=$metric, cull=$cull, samples=$samples, format=$format) > downsample(scale=$downsample) > blur(width=$width, weights=$weights) > mips(levels=$mips)
//! sampler map_sampler: filter=$filter address=clamp anisotropy=$anisotropy
//! sampler tap_sampler: filter=$filter address=clamp
//! sampler texel_sampler: filter=nearest address=clamp

const EXPONENT: f32 = 40.0;
const WIDTH: f32 = 5.0;

//#if warps == two
const FALLING: f32 = 5.0;

//#end
//#if mips == on
//#if sampling != hardware
const ANISOTROPY: f32 = 16.0;

//#end
//#end
/// point (point world; = @position_world; hidden): The shaded point.
/// space (space; hidden): The light's space.
/// map (map; hidden): Means and mean squares of exponentials of depth.
//#if sampling == taps
/// tap_sampler (sampler; hidden): Filters moments.
//#elif sampling == hardware
/// map_sampler (sampler; hidden): Filters moments.
//#else
/// texel_sampler (sampler; hidden): Takes the nearest texel.
//#end
//#if format == float32
/// minimum_variance (number; = 0.00000001; 0..1): Least variance, in squares of the light's range; each exponential stretches it by its slope. Hides rounding; an occluder within about 16 of its square roots above the receiver lets light through.
//#else
/// minimum_variance (number; = 0.00003; 0..1): Least variance, in squares of the light's range; each exponential stretches it by its slope. Hides rounding; an occluder within about 16 of its square roots above the receiver lets light through.
//#end
/// bleeding_reduction (scalar; = 0; 0..0.99): Lit parts up to this count as dark, the rest is stretched.
/// receives (scalar; = @receives; hidden): 0 where the object takes no shadows.
/// -> visibility (scalar visibility): 1 lit, 0 in shadow.
fn exponential_variance_shadow(
    point: vec3f,
    space: LightSpace,
    map: texture_2d_array<f32>,
//#if sampling == taps
    tap_sampler: sampler,
//#elif sampling == hardware
    map_sampler: sampler,
//#else
    texel_sampler: sampler,
//#end
    minimum_variance: f32,
    bleeding_reduction: f32,
    receives: f32,
) -> f32 {
    let position = light_position(space, point);
    let uv = light_map_uv(space, position);
    let layer = light_layer(space);
//#if mips == on
    let uv_dx = light_map_change(space, position, dpdx(point));
    let uv_dy = light_map_change(space, position, dpdy(point));
//#if sampling == taps
    let stored = sample_footprint(map, tap_sampler, uv, layer, uv_dx, uv_dy, ANISOTROPY);
//#elif sampling == hardware
    let stored = textureSampleGrad(map, map_sampler, uv, layer, uv_dx, uv_dy);
//#else
    let stored = blend_footprint(map, texel_sampler, uv, layer, uv_dx, uv_dy, ANISOTROPY);
//#end
//#else
//#if sampling == taps
    let stored = textureSampleLevel(map, tap_sampler, uv, layer, 0.0);
//#elif sampling == hardware
    let stored = textureSampleLevel(map, map_sampler, uv, layer, 0.0);
//#else
    let stored = blend_texels(map, texel_sampler, uv, layer, 0.0);
//#end
//#end
//#if metric == linear
    let measured = light_depth_linear(space, position);
    let scale = 1.0;
//#elif metric == zw
    let measured = light_depth_zw(space, position);
    let scale = light_scale_zw(space, position);
//#else
    let measured = light_depth_radial(space, position);
    let scale = light_scale_radial(space, position);
//#end
    // The map holds what lies beyond the far plane as lying in it.
    let size = vec2f(textureDimensions(map));
    let blurred = (0.5 * WIDTH * light_zoom(space) + 1.0) / size;
//#if mips == on
//#if sampling == hardware
    let filtered = blurred + footprint_reach(size, uv_dx, uv_dy, 1.0);
//#else
    let filtered = blurred + footprint_reach(size, uv_dx, uv_dy, ANISOTROPY);
//#end
//#else
    let filtered = blurred;
//#end
    let plane = receiver_plane(space, position, geometric_normal(point));
    let reach = receiver_reach(space, plane, filtered) * scale;
    let depth = saturate(measured);
    let nearest = saturate(measured - reach);
//#if format == float32
    let exponent = min(EXPONENT, SINGLE_EXPONENT);
    let far = SINGLE_RISING_FAR;
//#else
    let exponent = min(EXPONENT, HALF_EXPONENT);
    let far = HALF_RISING_FAR;
//#end
    let rise = 2.0 * exponent;
    let rising_alone = rising_warp(depth, exponent, far);
    let rising_nearest = rising_warp(nearest, exponent, far);
    let rising = warped_mean_up_to_far(rising_alone, rising_nearest, far, rise, measured, reach);
    let least = max(minimum_variance, 1e-12);
    let bound = warped_bound(stored.xy, rising, rise * rising, least);
//#if warps == two
//#if format == float32
    let exponent_2 = min(FALLING, SINGLE_EXPONENT);
    let far_2 = single_falling_far(exponent_2);
//#else
    let exponent_2 = min(FALLING, HALF_EXPONENT);
    let far_2 = HALF_FALLING_FAR;
//#end
    let fall = 2.0 * exponent_2;
    let falling_alone = falling_warp(depth, exponent_2, far_2);
    let falling_nearest = falling_warp(nearest, exponent_2, far_2);
    let falling = warped_mean_up_to_far(falling_alone, falling_nearest, -far_2, -fall, measured, reach);
    let lit = min(bound, warped_bound(stored.zw, falling, fall * falling, least));
//#else
    let lit = bound;
//#end
    let visibility = reduce_bleeding(lit, bleeding_reduction);
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, uv));
}

/// Chebyshev's bound under a warp: `moments` of warped depth, the receiver's, the slope of the warp there, and the least
/// variance of depth itself.
fn warped_bound(moments: vec2f, receiver: f32, stretch: f32, least: f32) -> f32 {
    // In units of the slope, as squares of the numbers themselves may leave the range of f32. Where the filter reaches far
    // behind the receiver, even that may be infinite.
    let behind = max((receiver - moments.x) / abs(stretch), 0.0);
    let variance = (moments.y - moments.x * moments.x) / abs(stretch) / abs(stretch);
    return chebyshev_bound(clamp(variance, least, 1e30), behind);
}
