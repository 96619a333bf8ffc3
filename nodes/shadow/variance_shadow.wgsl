//! label: Variance shadow
//! category: shadow
//! synonyms: vsm, variance shadow map, soft shadow, filtered shadow, blurred shadow
//! use: light_space
//! Shadow from the filtered mean and variance of depth: Chebyshev's inequality bounds the lit part of the filter from above, and meets it for one plane above another (Donnelly and Lauritzen 2006, theorem 1). The map is blurred once, not per pixel. Where several occluders lie far apart, light bleeds into the shadow of the nearer.
//! option width: 1 | 3 | 5 | 7 | 9 | 11 = 5 - Texels across the blur of the map.
//! option weights: gaussian | box | tent = gaussian - Shape of the blur.
//! option size: 256 | 512 | 1024 | 2048 | 4096 = 1024 - Texels on a side of the map.
//! option format: auto | rg32float | rg16unorm | rg16float = auto - Storage; auto takes the most exact that the device can filter. rg16unorm needs a minimum variance of about 2e-5, rg16float of 1e-4.
//! option mips: on | off = on - Filter over the pixel's footprint, so that far shadows do not shimmer. Off: one bilinear fetch.
//! option filter: linear | trilinear = trilinear - Blend between mip levels or take the nearer.
//! option anisotropy: 1 | 4 | 8 | 16 = 16 - Longest footprint, in widths, that is followed at grazing views; above 1 it needs trilinear and mips.
//! option slope_variance: on | off = on - Count the slope of a surface within one texel as variance, which spares slopes from shadowing themselves.
//! map map: moments(size=$size, slope=$slope_variance, format=$format) > blur(width=$width, weights=$weights) > mips(levels=$mips)
//! sampler map_sampler: filter=$filter address=clamp anisotropy=$anisotropy

/// point (point world; = @position_world; hidden): The shaded point.
/// space (space; hidden): The light's space.
/// map (map; hidden): Mean and mean square of linear depth, filtered.
/// map_sampler (sampler; hidden): Filters moments.
/// minimum_variance (number; = 0.000001; 0..1): Least variance, in squares of the light's range. Hides rounding; an occluder within about 16 of its square roots above the receiver lets more than 1/255 of the light through.
/// bleeding_reduction (scalar; = 0.18; 0..0.99): Lit parts up to this count as dark, the rest is stretched. 0.18 removes bleeding where two occluders lie at most 1.47 times as far apart as the lower lies above the receiver, and darkens half shadow by at most 0.18.
/// receives (scalar; = @receives; hidden): 0 where the object takes no shadows.
/// -> visibility (scalar visibility): 1 lit, 0 in shadow.
fn variance_shadow(
    point: vec3f,
    space: LightSpace,
    map: texture_2d_array<f32>,
    map_sampler: sampler,
    minimum_variance: f32,
    bleeding_reduction: f32,
    receives: f32,
) -> f32 {
    let position = light_position(space, point);
    let uv = light_map_uv(space, position);
//#if mips == on
    let uv_dx = light_map_change(space, position, dpdx(point));
    let uv_dy = light_map_change(space, position, dpdy(point));
    let moments = textureSampleGrad(map, map_sampler, uv, light_layer(space), uv_dx, uv_dy).xy;
//#else
    let moments = textureSampleLevel(map, map_sampler, uv, light_layer(space), 0.0).xy;
//#end
    // Beyond the far plane the map holds depths above 1, if its format can: there the receiver is lit where it is what
    // the map shows, and in the shadow of anything nearer.
    let depth = min(max(light_linear_depth(space, position.z), 0.0), max(moments.x, 1.0));
    // 1e-12 keeps 0 / 0 out where both the variance and the difference vanish.
    let variance = max(moments.y - moments.x * moments.x, max(minimum_variance, 1e-12));
    let behind = max(depth - moments.x, 0.0);
    let bound = variance / (variance + behind * behind);
    let least = clamp(bleeding_reduction, 0.0, 0.99);
    let visibility = saturate((bound - least) / (1.0 - least));
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, uv));
}
