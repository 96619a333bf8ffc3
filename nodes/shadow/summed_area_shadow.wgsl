//! label: Summed-area shadow
//! category: shadow
//! synonyms: satvsm, savsm, summed-area variance shadow map, variance shadow, filtered shadow
//! use: light_space, summed_area, receiver_within
//! Variance shadow from a summed-area table of moments (Lauritzen 2007): a box of any width, another at every pixel, costs the same sixteen reads. Whole numbers keep the table exact whatever its size; floats lose digits with the square of it. Light bleeds as in every variance shadow.
//! option storage: uint32 | centred | float32 = uint32 - Whole numbers of 32 bits; floats around the middle of the range; or floats as they come, whose error grows four times with every doubling of the size.
//! option fraction_bits: 16 | 18 | 20 | 22 = 18 - Digits of whole numbers after the binary point: each two more quarter the rounding of moments and halve the widest box, which is 256, 128, 64 or 32 texels.
//! option footprint: fixed | pixel | near = pixel - Width of the box: as given; at least what the pixel covers, so that far shadows do not shimmer; or wider near the eye as well, where the texels of the map would show.
//! option build: compute | image = compute - How the table is made.
//! option size: 64 | 128 | 256 | 512 | 1024 | 2048 | 4096 = 1024 - Texels on a side of the map.
//! option slope_variance: on | off = on - Count the slope of a surface within one texel as variance, which spares slopes from shadowing themselves.
//! map table: moments(size=$size, slope=$slope_variance) > summands(storage=$storage, fraction_bits=$fraction_bits, format=rg32uint) > sum(format=rg32uint, build=$build) > sum_drawn(format=rg32uint, build=$build)
//! map float_table: moments(size=$size, slope=$slope_variance) > summands(storage=$storage, fraction_bits=$fraction_bits, format=rg32float) > sum(format=rg32float, build=$build) > sum_drawn(format=rg32float, build=$build)

//#if storage == uint32
const FRACTION_BITS: u32 = 18;

//#end
//#if footprint == near
/// Most times that a box grows near the eye.
const MOST_GROWTH: f32 = 8.0;

//#end
/// point (point world; = @position_world; hidden): The shaded point.
/// space (space; hidden): The light's space.
//#if storage == uint32
/// table (map; hidden): Sums of depth and of its square.
//#else
/// float_table (map; hidden): Sums of depth and of its square.
//#end
/// width (scalar; = 5; 1..): Texels across the box.
//#if footprint == near
/// near_distance (distance; = 4; 0..; in m): Nearer to the eye than this the box grows, up to eightfold.
/// eye (distance; = @depth; hidden): How far the point is from the eye.
//#end
/// minimum_variance (number; = 0.000001; 0..1): Least variance, in squares of the light's range. Hides rounding; an occluder within about 16 of its square roots above the receiver lets more than 1/255 of the light through.
/// bleeding_reduction (scalar; = 0.18; 0..0.99): Lit parts up to this count as dark, the rest is stretched. 0.18 removes bleeding where two occluders lie at most 1.47 times as far apart as the lower lies above the receiver, and darkens half shadow by at most 0.18.
/// receives (scalar; = @receives; hidden): 0 where the object takes no shadows.
/// -> visibility (scalar visibility): 1 lit, 0 in shadow.
fn summed_area_shadow(
    point: vec3f,
    space: LightSpace,
//#if storage == uint32
    table: texture_2d_array<u32>,
//#else
    float_table: texture_2d_array<f32>,
//#end
    width: f32,
//#if footprint == near
    near_distance: f32,
    eye: f32,
//#end
    minimum_variance: f32,
    bleeding_reduction: f32,
    receives: f32,
) -> f32 {
    let position = light_position(space, point);
    let plane = receiver_plane(space, position, geometric_normal(point));
//#if storage == uint32
    let size = vec2f(textureDimensions(table));
    // As many texels of depth 1 as the sum of them has room for.
    let widest = f32(1u << ((32u - FRACTION_BITS) / 2u));
//#else
    let size = vec2f(textureDimensions(float_table));
    let widest = size.x;
//#end
//#if footprint == near
    let wanted = width * clamp(near_distance / max(eye, 1e-6), 1.0, MOST_GROWTH);
//#else
    let wanted = width;
//#end
//#if footprint == fixed
    let texels = vec2f(wanted);
//#else
    // The rectangle around the pixel on the map.
    let uv_dx = abs(light_map_change(space, position, dpdx(point)));
    let uv_dy = abs(light_map_change(space, position, dpdy(point)));
    let texels = max(vec2f(wanted), (uv_dx + uv_dy) * size);
//#end
    let box_width = min(texels, vec2f(widest));
    let region = summed_box(plane.uv, box_width, size);
//#if storage == uint32
    let moments = summed_mean(table, light_layer(space), region) / f32(1u << FRACTION_BITS);
    let mean = moments.x;
    let variance = moments.y - mean * mean;
//#elif storage == centred
    let moments = summed_mean_float(float_table, light_layer(space), region);
    let mean = moments.x + 0.5;
    let variance = moments.y + 0.125 - moments.x * moments.x;
//#else
    let moments = summed_mean_float(float_table, light_layer(space), region);
    let mean = moments.x;
    let variance = moments.y - mean * mean;
//#end
    // At the borders the middle of the box is another place of the receiver, at another depth.
    // Parts of texels are as deep as all of them: half a texel more at each end.
    let depth = receiver_depth_within(space, plane, region.center, (box_width + 1.0) / size);
    let visibility = summed_bound(depth, mean, variance, minimum_variance, bleeding_reduction);
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, plane.uv));
}
