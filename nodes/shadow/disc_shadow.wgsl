//! label: Disc shadow
//! category: shadow
//! synonyms: vogel disc, poisson disc, rotated disc, random samples, stochastic pcf, percentage closer filtering, soft shadow, noise
//! use: receiver, disc
//! Shadow by comparing a depth map at places spread over a disc, turned from pixel to pixel: percentage-closer filtering by random samples, as at first (Reeves, Salesin and Cook 1987), on the spiral of Vogel (1979). Wide edges cost few samples and show fine noise. Every comparison is with the receiving plane, so no bias has to be tuned.
//! option count: 4 | 8 | 16 | 32 | 64 = 16 - Samples of the disc.
//! option turn: pixel | off = pixel - Turn the samples from pixel to pixel, which makes noise, or not, which makes bands.
//! option taps: nearest | bilinear | hardware = nearest - How a sample reads: the nearest texel, four texels blended after exact comparisons, or four blended by the sampler with one biased comparison.
//! option cull: none | front | back = none - Sides of triangles that are left out.
//! option size: 64 | 128 | 256 | 512 | 1024 | 2048 | 4096 = 2048 - Texels on a side of the map.
//! map map: depth(size=$size, cull=$cull)
//! sampler map_sampler: compare=on filter=nearest address=clamp
//! sampler blending_sampler: compare=on filter=linear address=clamp

const COUNT: i32 = 16;

/// point (point world; = @position_world; hidden): The shaded point.
/// space (space; hidden): The light's space.
/// map (map; hidden): Linear depth of the nearest surface.
//#if taps == hardware
/// blending_sampler (sampler; hidden): Compares with four texels and blends the results.
//#else
/// map_sampler (sampler; hidden): Compares with one texel.
//#end
//#if turn == pixel
/// pixel (point screen; = @pixel; hidden): Where the pixel is.
//#end
/// radius (number; = 3; 0..): Of the disc, in texels.
/// bias (distance; = 0; 0..; in m): Extra distance by which an occluder must be nearer to the light, for surfaces that the plane does not describe.
/// receives (scalar; = @receives; hidden): 0 where the object takes no shadows.
/// -> visibility (scalar visibility): 1 lit, 0 in shadow.
fn disc_shadow(
    point: vec3f,
    space: LightSpace,
    map: texture_depth_2d_array,
//#if taps == hardware
    blending_sampler: sampler_comparison,
//#else
    map_sampler: sampler_comparison,
//#end
//#if turn == pixel
    pixel: vec2f,
//#end
    radius: f32,
    bias: f32,
    receives: f32,
) -> f32 {
    let position = light_position(space, point);
    let plane = receiver_plane(space, position, geometric_normal(point));
    let margin = margin_within(receiver_margin(space, plane, map, bias), max(radius, 0.0) + 1.0);
//#if turn == pixel
    let turn = interleaved_noise(pixel);
//#else
    let turn = 0.0;
//#end
    let size = vec2f(textureDimensions(map));
    var sum = 0.0;
    for (var i = 0; i < COUNT; i++) {
        let offset = on_disc(vogel_sample(i, COUNT, turn)) * max(radius, 0.0);
        let uv = plane.uv + offset / size;
//#if taps == nearest
        sum += compare_nearest(space, plane, map, map_sampler, uv, margin);
//#elif taps == bilinear
        sum += compare_bilinear(space, plane, map, map_sampler, uv, margin);
//#else
        sum += compare_blended(space, plane, map, blending_sampler, uv, margin);
//#end
    }
    let visibility = sum / f32(COUNT);
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, plane.uv));
}
