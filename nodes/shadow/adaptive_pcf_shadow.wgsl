//! label: Adaptive PCF shadow
//! category: shadow
//! synonyms: adaptive percentage closer filtering, anti-aliased shadow, minification, derivative kernel, footprint filter, soft shadow
//! use: receiver
//! Percentage-closer filtering whose kernel is the pixel's footprint on the map, from the derivatives of the map coordinate: as many taps as it covers texels, so far shadows neither sparkle nor lose thin things, and near ones cost four comparisons. Near the camera the footprint is smaller than a texel, and what is left is the blend of four texels.
//! option most: 1 | 2 | 4 | 8 | 16 = 8 - Most taps along each side of the footprint. Beyond, they stand apart.
//! option taps: bilinear | hardware = bilinear - How a tap reads: four texels blended after exact comparisons, or four blended by the sampler with one biased comparison.
//! option cull: none | front | back = none - Sides of triangles that are left out.
//! option size: 64 | 128 | 256 | 512 | 1024 | 2048 | 4096 = 2048 - Texels on a side of the map.
//! map map: depth(size=$size, cull=$cull)
//! sampler map_sampler: compare=on filter=nearest address=clamp
//! sampler blending_sampler: compare=on filter=linear address=clamp

const MOST: i32 = 8;

/// point (point world; = @position_world; hidden): The shaded point.
/// space (space; hidden): The light's space.
/// map (map; hidden): Linear depth of the nearest surface.
//#if taps == hardware
/// blending_sampler (sampler; hidden): Compares with four texels and blends the results.
//#else
/// map_sampler (sampler; hidden): Compares with one texel.
//#end
/// width (number; = 1; 0..64): Texels that the kernel is wide at least: above 1, edges near the camera are softened, too.
/// bias (distance; = 0; 0..; in m): Extra distance by which an occluder must be nearer to the light, for surfaces that the plane does not describe.
/// receives (scalar; = @receives; hidden): 0 where the object takes no shadows.
/// -> visibility (scalar visibility): 1 lit, 0 in shadow.
fn adaptive_pcf_shadow(
    point: vec3f,
    space: LightSpace,
    map: texture_depth_2d_array,
//#if taps == hardware
    blending_sampler: sampler_comparison,
//#else
    map_sampler: sampler_comparison,
//#end
    width: f32,
    bias: f32,
    receives: f32,
) -> f32 {
    let position = light_position(space, point);
    let across = dpdx(point);
    let down = dpdy(point);
    let plane = receiver_plane(space, position, cross(across, down));
    let size = vec2f(textureDimensions(map));
    let along_x = footprint_side(texel_change(space, position, across, size), width);
    let along_y = footprint_side(texel_change(space, position, down, size), width);
    let taps_x = i32(along_x.z);
    let taps_y = i32(along_y.z);
    let reach = 0.5 * (length(along_x.xy) * (along_x.z - 1.0) + length(along_y.xy) * (along_y.z - 1.0)) + 1.0;
    let margin = margin_within(receiver_margin(space, plane, map, bias), reach);
    var sum = 0.0;
    for (var y = 0; y < taps_y; y++) {
        for (var x = 0; x < taps_x; x++) {
            let place = vec2f(f32(x), f32(y)) - 0.5 * vec2f(f32(taps_x - 1), f32(taps_y - 1));
            let uv = plane.uv + (along_x.xy * place.x + along_y.xy * place.y) / size;
//#if taps == bilinear
            sum += compare_bilinear(space, plane, map, map_sampler, uv, margin);
//#else
            sum += compare_blended(space, plane, map, blending_sampler, uv, margin);
//#end
        }
    }
    let visibility = sum / f32(taps_x * taps_y);
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, plane.uv));
}

/// Taps along a side of the footprint (texels), at least `least` long. xy: from one tap to the next; z: how many. A tap is
/// itself one texel wide; n of them at steps s have the variance of a box as wide as the root of 1 + s^2 (n^2 - 1). So
/// one tap does up to a width of 1, n taps a texel apart are the box of n texels, and widths between follow continuously.
fn footprint_side(side: vec2f, least: f32) -> vec3f {
    let length = length(side);
    let width = max(max(length, least), 1.0);
    let count = clamp(ceil(width), 1.0, f32(MOST));
    let step = sqrt((width * width - 1.0) / max(count * count - 1.0, 1.0));
    return vec3f(side * (select(0.0, step, count > 1.0) / max(length, 1e-12)), count);
}
