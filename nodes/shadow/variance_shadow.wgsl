//! label: Variance shadow
//! category: shadow
//! synonyms: vsm, psvsm, variance shadow map, soft shadow, filtered shadow, blurred shadow
//! use: light_space, chebyshev, map_footprint, split_halves, tile_bleeding
//! Shadow from the filtered mean and variance of depth: Chebyshev's inequality bounds the lit part of the filter from above, and meets it for one plane above another (Donnelly and Lauritzen 2006, theorem 1). The map is blurred once, not per pixel. Where several occluders lie far apart, light bleeds into the shadow of the nearer.
//! option width: 1 | 3 | 5 | 7 | 9 | 11 | 13 | 15 | 17 | 19 | 21 | 23 | 25 = 5 - Texels across the blur of the map, in the coarsest view of a light with splits: the others are blurred as widely in metres.
//! option weights: gaussian | box | tent = gaussian - Shape of the blur.
//! option size: 64 | 128 | 256 | 512 | 1024 | 2048 | 4096 = 1024 - Texels on a side of the map.
//! option downsample: 1 | 2 | 4 = 1 - Texels that are averaged before the blur, on a side: the map is drawn finely, and blurred widely at little cost.
//! option samples: 1 | 4 = 1 - Places within a texel at which occluders are drawn; where the format cannot be resolved, one.
//! option cull: none | front | back = none - Sides of triangles that cast no shadow: none, those that face the light (shadows shrink by the thickness of what casts them), or those that face away.
//! option metric: linear | zw | radial = linear - How depth is measured: evenly along the light's axis, as projection matrices leave it (most of it spent near the light, which makes bleeding worse), or by the distance from the light.
//! option format: auto | rg32float | rg16unorm | rg16float | split = auto - Storage; auto takes the most exact that the device can filter. rg16unorm needs a minimum variance of about 2e-5, rg16float of 1e-4; split holds each moment in two halves of rgba16float, which every device filters, at 20 bits.
//! option range: unit | signed = unit - Depth is stored from 0 to 1, or from -1 to 1, which lends the sign of floats to precision.
//! option second: square | deviation = square - What is stored beside the mean. Deviations are there to be compared with, not to be used: they are not linear, so every filtered edge turns hard.
//! option mips: on | off = on - Filter over the pixel's footprint, so that far shadows do not shimmer. Off: one bilinear fetch.
//! option sampling: taps | hardware | manual = taps - Trilinear taps along the pixel's footprint, the same on all devices; one anisotropic fetch of the sampler; or taps interpolated in the shader, exactly, for formats that the device cannot filter.
//! option filter: linear | trilinear = trilinear - Blend between mip levels or take the nearer.
//! option anisotropy: 1 | 4 | 8 | 16 = 16 - Longest footprint, in widths, that is followed at grazing views. With hardware sampling, more than 1 needs trilinear and mips.
//! option slope_variance: on | off = on - Count the slope of a surface within one texel as variance, which spares slopes from shadowing themselves.
//! option least: clamp | bias = clamp - Whether the minimum variance takes the place of smaller ones or is added to all.
//! option bleeding: fixed | measured = fixed - One amount of reduction everywhere, or for each tile of 16 by 16 texels the least that is sure to remove bleeding, from the depths that occur there: nothing where there is one occluder. Full shadow is dark, but for occluders within what the receiver's own slope spans in a tile; elsewhere it is too dark by no more than that amount.
//! map map: moments(size=$size, slope=$slope_variance, metric=$metric, cull=$cull, samples=$samples, second=$second, range=$range, format=$format) > downsample(scale=$downsample, format=$format) > blur(width=$width, weights=$weights, format=$format) > mips(levels=$mips, format=$format)
//! map tiles: moments(size=$size, slope=off, metric=$metric, cull=$cull) > occupancy(width=$width, downsample=$downsample)
//! sampler map_sampler: filter=$filter address=clamp anisotropy=$anisotropy
//! sampler tap_sampler: filter=$filter address=clamp
//! sampler texel_sampler: filter=nearest address=clamp

//#if mips == on
//#if sampling != hardware
const ANISOTROPY: f32 = 16.0;

//#end
//#end
//#if bleeding == measured
const WIDTH: f32 = 5.0;

//#end
/// point (point world; = @position_world; hidden): The shaded point.
/// space (space; hidden): The light's space.
/// map (map; hidden): Mean and mean square of depth, filtered.
//#if bleeding == measured
/// tiles (map; hidden): Depths that occur around each tile of the map.
//#end
//#if sampling == taps
/// tap_sampler (sampler; hidden): Filters moments.
//#elif sampling == hardware
/// map_sampler (sampler; hidden): Filters moments.
//#else
/// texel_sampler (sampler; hidden): Takes the nearest texel.
//#end
/// minimum_variance (number; = 0.000001; 0..1): Least variance, in squares of the light's range. Hides rounding; an occluder within about 16 of its square roots above the receiver lets more than 1/255 of the light through.
//#if bleeding == fixed
/// bleeding_reduction (scalar; = 0.18; 0..0.99): Lit parts up to this count as dark, the rest is stretched. 0.18 removes bleeding where two occluders lie at most 1.47 times as far apart as the lower lies above the receiver, and darkens half shadow by at most 0.18.
//#end
/// receives (scalar; = @receives; hidden): 0 where the object takes no shadows.
/// -> visibility (scalar visibility): 1 lit, 0 in shadow.
fn variance_shadow(
    point: vec3f,
    space: LightSpace,
    map: texture_2d_array<f32>,
//#if bleeding == measured
    tiles: texture_2d_array<f32>,
//#end
//#if sampling == taps
    tap_sampler: sampler,
//#elif sampling == hardware
    map_sampler: sampler,
//#else
    texel_sampler: sampler,
//#end
    minimum_variance: f32,
//#if bleeding == fixed
    bleeding_reduction: f32,
//#end
    receives: f32,
) -> f32 {
//#if bleeding == measured
    let normal = geometric_normal(point);
//#end
    let position = light_position(space, point);
    let uv = light_map_uv(space, position);
    let layer = light_layer(space);
//#if mips == on
    let uv_dx = light_map_change(space, position, dpdx(point));
    let uv_dy = light_map_change(space, position, dpdy(point));
//#if sampling == taps
    let texel = sample_footprint(map, tap_sampler, uv, layer, uv_dx, uv_dy, ANISOTROPY);
//#elif sampling == hardware
    let texel = textureSampleGrad(map, map_sampler, uv, layer, uv_dx, uv_dy);
//#else
    let texel = blend_footprint(map, texel_sampler, uv, layer, uv_dx, uv_dy, ANISOTROPY);
//#end
//#else
//#if sampling == taps
    let texel = textureSampleLevel(map, tap_sampler, uv, layer, 0.0);
//#elif sampling == hardware
    let texel = textureSampleLevel(map, map_sampler, uv, layer, 0.0);
//#else
    let texel = blend_texels(map, texel_sampler, uv, layer, 0.0);
//#end
//#end
//#if format == split
    let stored = join_halves(texel);
//#else
    let stored = texel.xy;
//#end
//#if second == deviation
    let mean = stored.x;
    let spread = stored.y * stored.y;
//#elif range == signed
//#if format == rg16unorm
    let mean = stored.x;
    let spread = stored.y - mean * mean;
//#else
    let mean = 0.5 * stored.x + 0.5;
    let spread = 0.25 * (stored.y - stored.x * stored.x);
//#end
//#else
    let mean = stored.x;
    let spread = stored.y - mean * mean;
//#end
//#if metric == linear
    let measured = light_depth_linear(space, position);
//#elif metric == zw
    let measured = light_depth_zw(space, position);
//#else
    let measured = light_depth_radial(space, position);
//#end
    // Beyond the far plane the map holds depths above 1, if its format can: there the receiver is lit where it is what
    // the map shows, and in the shadow of anything nearer.
    let depth = min(max(measured, 0.0), max(mean, 1.0));
    // 1e-12 keeps 0 / 0 out where both the variance and the difference vanish.
    let least = max(minimum_variance, 1e-12);
//#if least == clamp
    let variance = max(spread, least);
//#else
    let variance = max(spread, 0.0) + least;
//#end
    let bound = chebyshev_bound(variance, max(depth - mean, 0.0));
//#if bleeding == measured
    let tile_size = vec2i(textureDimensions(tiles));
    let tile = clamp(vec2i(uv * vec2f(tile_size)), vec2i(0), tile_size - 1);
    // How far the receiver's own plane may come towards the light within the tile and the reach of the blur around it.
    let plane = receiver_plane(space, position, normal);
    let across = 1.0 / vec2f(tile_size) + (0.5 * WIDTH * light_zoom(space) + 1.0) / vec2f(textureDimensions(map));
//#if metric == linear
    let rise = dot(receiver_bounded_slope(space, plane), across);
//#elif metric == zw
    let rise = dot(receiver_bounded_slope(space, plane), across) * light_scale_zw(space, position);
//#else
    let rise = dot(receiver_bounded_slope(space, plane), across) * light_scale_radial(space, position);
//#end
    let amount = tile_bleeding(textureLoad(tiles, tile, layer, 0), depth, rise);
    let visibility = reduce_bleeding(bound, amount);
//#else
    let visibility = reduce_bleeding(bound, bleeding_reduction);
//#end
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, uv));
}
