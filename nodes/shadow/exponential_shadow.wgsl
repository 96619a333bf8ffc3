//! label: Exponential shadow
//! category: shadow
//! synonyms: esm, exponential shadow map, soft shadow, filtered shadow, blurred shadow
//! use: light_space, chebyshev, map_footprint, exponential_warp, receiver_within
//! Shadow from a filtered exponential of depth (Annen et al. 2008; Salvi 2008): e^(-c t) times the mean of e^(c z) is the lit share, up to what occluders close above the receiver let through. One number a texel, no light bleeding; but light leaks at contacts, and where a part of the filter lies behind the receiver.
//! option exponent: 5 | 11 | 20 | 40 | 80 = 80 - How fast the exponential rises over the light's range: an occluder 5.54 / exponent of the range above the receiver lets 1/255 through, a nearer one more. Exponentials in 16 bits hold 11 at most, and are given no more.
//! option domain: plain | log = plain - What is stored: exponentials, or their logarithms, which are depths and fit any format, with blurs that average exponentials all the same. Between texels the sampler then interpolates depth.
//! option format: auto | float32 | float16 = float32 - Bits of a texel. auto takes what the device can filter, and an exponent of at most 11, as it may be 16.
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
//! map map: warped_moments(moments=mean, size=$size, exponent=$exponent, domain=$domain, metric=$metric, cull=$cull, samples=$samples, format=$format) > downsample(scale=$downsample, domain=$domain, exponent=$exponent) > blur(width=$width, weights=$weights, domain=$domain, exponent=$exponent) > mips(levels=$mips, domain=$domain, exponent=$exponent)
//! sampler map_sampler: filter=$filter address=clamp anisotropy=$anisotropy
//! sampler tap_sampler: filter=$filter address=clamp
//! sampler texel_sampler: filter=nearest address=clamp

const EXPONENT: f32 = 80.0;
const WIDTH: f32 = 5.0;

//#if mips == on
//#if sampling != hardware
const ANISOTROPY: f32 = 16.0;

//#end
//#end
/// point (point world; = @position_world; hidden): The shaded point.
/// space (space; hidden): The light's space.
/// map (map; hidden): Mean of the exponential of depth.
//#if sampling == taps
/// tap_sampler (sampler; hidden): Filters exponentials.
//#elif sampling == hardware
/// map_sampler (sampler; hidden): Filters exponentials.
//#else
/// texel_sampler (sampler; hidden): Takes the nearest texel.
//#end
/// bleeding_reduction (scalar; = 0; 0..0.99): Lit parts up to this count as dark, the rest is stretched.
/// receives (scalar; = @receives; hidden): 0 where the object takes no shadows.
/// -> visibility (scalar visibility): 1 lit, 0 in shadow.
fn exponential_shadow(
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
    let stored = sample_footprint(map, tap_sampler, uv, layer, uv_dx, uv_dy, ANISOTROPY).x;
//#elif sampling == hardware
    let stored = textureSampleGrad(map, map_sampler, uv, layer, uv_dx, uv_dy).x;
//#else
    let stored = blend_footprint(map, texel_sampler, uv, layer, uv_dx, uv_dy, ANISOTROPY).x;
//#end
//#else
//#if sampling == taps
    let stored = textureSampleLevel(map, tap_sampler, uv, layer, 0.0).x;
//#elif sampling == hardware
    let stored = textureSampleLevel(map, map_sampler, uv, layer, 0.0).x;
//#else
    let stored = blend_texels(map, texel_sampler, uv, layer, 0.0).x;
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
    // No bias: the mean of the exponentials over a lit slope is above the exponential of its middle.
//#if domain == log
    let ratio = exp(EXPONENT * (stored - mean_up_to_far(measured, reach)));
//#else
//#if format == float32
    let exponent = EXPONENT;
    let mean = stored;
//#else
    let exponent = min(EXPONENT, 2.0 * HALF_EXPONENT);
    let mean = stored * (1.0 / 32768.0);
//#end
    let alone = exp(exponent * (saturate(measured) - 1.0));
    let nearest = exp(exponent * (saturate(measured - reach) - 1.0));
    let ratio = mean / warped_mean_up_to_far(alone, nearest, 1.0, exponent, measured, reach);
//#end
    let visibility = reduce_bleeding(min(ratio, 1.0), bleeding_reduction);
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, uv));
}
