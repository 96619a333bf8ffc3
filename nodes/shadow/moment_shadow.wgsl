//! label: Moment shadow
//! category: shadow
//! synonyms: msm, msm4, moment shadow map, hamburger, soft shadow, filtered shadow, blurred shadow
//! use: light_space, chebyshev, map_footprint, hamburger, receiver_within
//! Shadow from four moments of depth: the least shadow that they allow (Peters and Klein 2015, Hamburger moment problem). Exact for two occluder depths above a receiver, and where a receiver ends within the filter; light bleeds only where three and more occluders lie apart. Slopes need a bias of about half the blur.
//! option format: auto | float32 | unorm16 = float32 - Bits of each of the four moments. auto takes what the device can filter, with the care that 16 bits need. Devices that cannot filter 32 bits need unorm16 or manual sampling.
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
//! map map: power_moments(size=$size, metric=$metric, cull=$cull, samples=$samples, format=$format) > downsample(scale=$downsample) > blur(width=$width, weights=$weights) > mips(levels=$mips)
//! sampler map_sampler: filter=$filter address=clamp anisotropy=$anisotropy
//! sampler tap_sampler: filter=$filter address=clamp
//! sampler texel_sampler: filter=nearest address=clamp

const WIDTH: f32 = 5.0;

//#if mips == on
//#if sampling != hardware
const ANISOTROPY: f32 = 16.0;

//#end
//#end
/// point (point world; = @position_world; hidden): The shaded point.
/// space (space; hidden): The light's space.
/// map (map; hidden): Powers of depth, filtered.
//#if sampling == taps
/// tap_sampler (sampler; hidden): Filters moments.
//#elif sampling == hardware
/// map_sampler (sampler; hidden): Filters moments.
//#else
/// texel_sampler (sampler; hidden): Takes the nearest texel.
//#end
//#if format == float32
/// moment_bias (number; = 0.0000003; 0..0.1): Part of the moments that is replaced by those of a wide distribution, which hides rounding. More lets more light through at contacts.
//#else
/// moment_bias (number; = 0.00006; 0..0.1): Part of the moments that is replaced by those of a wide distribution, which hides rounding. More lets more light through at contacts.
//#end
/// slope_bias (scalar; = 1; 0..): How far the receiver is moved towards the light, in half widths of the blur along its slope. Without it, slopes shadow themselves; at grazing light it loosens a shadow from what casts it.
/// bleeding_reduction (scalar; = 0.02; 0..0.99): Lit parts up to this count as dark, the rest is stretched.
/// receives (scalar; = @receives; hidden): 0 where the object takes no shadows.
/// -> visibility (scalar visibility): 1 lit, 0 in shadow.
fn moment_shadow(
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
    moment_bias: f32,
    slope_bias: f32,
    bleeding_reduction: f32,
    receives: f32,
) -> f32 {
    let normal = geometric_normal(point);
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
//#if format == float32
    let wide = vec4f(0.0, 0.375, 0.0, 0.375);
    let moments = mix(stored, wide, moment_bias);
//#else
    let wide = vec4f(0.0, 0.628, 0.0, 0.628);
    let moments = mix(decode_moments(stored), wide, moment_bias);
//#end
    let plane = receiver_plane(space, position, normal);
    let size = vec2f(textureDimensions(map));
    let blurred = 0.5 * WIDTH * light_zoom(space) / size;
//#if mips == on
    // What a pixel covers beyond the texels that it interpolates is part of the filter.
    let covered = 0.5 * max(abs(uv_dx), abs(uv_dy));
    let filtered = blurred + max(covered - 0.5 / size, vec2f(0.0));
//#else
    let filtered = blurred;
//#end
    let bias = slope_bias * dot(filtered, receiver_bounded_slope(space, plane)) * scale;
    // The map holds what lies beyond the far plane as lying in it.
    let depth = mean_up_to_far(measured, receiver_reach(space, plane, filtered) * scale);
    let lit = hamburger_visibility(moments, 2.0 * (depth - bias) - 1.0);
    let visibility = reduce_bleeding(lit, bleeding_reduction);
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, uv));
}
