//! label: Summed-area soft shadow
//! category: shadow
//! synonyms: pcss, percentage closer soft shadow, vssm, variance soft shadow, satvsm, area light shadow, penumbra
//! use: light_space, summed_area
//! Soft shadow of a light with a size (Fernando 2005) from a summed-area table of moments: one box finds how far away the occluders are, another as wide as their penumbra filters (Lauritzen 2007; Yang and others 2010, section 3). Exact for one plane above another and a rectangular light; a round one is taken for the rectangle of equal variance. It fails where the first box holds surfaces behind the receiver, which hide occluders from the mean and harden the edge; where occluders lie at several depths, which are taken for one and bleed; and where the penumbra is wider than the widest box, which cuts it off.
//! option fraction_bits: 16 | 18 | 20 | 22 = 18 - Digits of the table's numbers after the binary point: each two more quarter the rounding of moments and halve the widest box, which is 256, 128, 64 or 32 texels.
//! option build: compute | image = compute - How the table is made.
//! option size: 64 | 128 | 256 | 512 | 1024 | 2048 = 1024 - Texels on a side of the map. A smaller map has wider boxes, in metres.
//! option slope_variance: on | off = on - Count the slope of a surface within one texel as variance, which spares slopes from shadowing themselves.
//! map table: moments(size=$size, slope=$slope_variance) > summands(fraction_bits=$fraction_bits) > sum(build=$build) > sum_drawn(build=$build)

const FRACTION_BITS: u32 = 18;

/// Half side over radius of the square that has the variance of a disc: radius^2 / 4 = half side^2 / 3.
const DISC_AS_SQUARE: f32 = 0.8660254;

/// Full width on the map, in texels of a map of `size`, of the light as a point sees it through a plane at `occluder`
/// (metres along the axis): similar triangles.
fn source_width(space: LightSpace, position: vec3f, size: vec2f, occluder: f32) -> vec2f {
    let gap = max(position.z - occluder, 0.0);
    let spread = select(gap, gap / max(occluder, 1e-6), space.projection.z > 0.5);
    // Half of what the penumbra is wide at the point, metres.
    let reach = space.source.xy * (spread * select(1.0, DISC_AS_SQUARE, space.source.z > 0.5));
    let across = light_map_uv(space, position + vec3f(reach.x, 0.0, 0.0)) - light_map_uv(space, position);
    let down = light_map_uv(space, position + vec3f(0.0, reach.y, 0.0)) - light_map_uv(space, position);
    return 2.0 * size * (abs(across) + abs(down));
}

/// point (point world; = @position_world; hidden): The shaded point.
/// space (space; hidden): The light's space.
/// table (map; hidden): Sums of depth and of its square.
/// softness (scalar; = 1; 0..): Multiplies the size of the light.
/// minimum_width (scalar; = 3; 1..): Texels across the narrowest filter, which keeps the stairs of the map out of contacts.
/// minimum_variance (number; = 0.000001; 0..1): Least variance, in squares of the light's range. Hides rounding; an occluder within about 16 of its square roots above the receiver lets more than 1/255 of the light through.
/// bleeding_reduction (scalar; = 0.18; 0..0.99): Lit parts up to this count as dark, the rest is stretched. 0.18 removes bleeding where two occluders lie at most 1.47 times as far apart as the lower lies above the receiver, and darkens half shadow by at most 0.18.
/// receives (scalar; = @receives; hidden): 0 where the object takes no shadows.
/// -> visibility (scalar visibility): 1 lit, 0 in shadow.
fn summed_area_soft_shadow(
    point: vec3f,
    space: LightSpace,
    table: texture_2d_array<u32>,
    softness: f32,
    minimum_width: f32,
    minimum_variance: f32,
    bleeding_reduction: f32,
    receives: f32,
) -> f32 {
    let position = light_position(space, point);
    let plane = receiver_plane(space, position, geometric_normal(point));
    let layer = light_layer(space);
    let size = vec2f(textureDimensions(table));
    let scale = 1.0 / f32(1u << FRACTION_BITS);
    // As many texels of depth 1 as the sum of them has room for.
    let widest = vec2f(f32(1u << ((32u - FRACTION_BITS) / 2u)));

    // Occluders are nearer than the receiver and beyond the near plane: there the light appears largest.
    let search_width = softness * source_width(space, position, size, space.depth.x);
    let search = summed_box(plane.uv, clamp(search_width, vec2f(minimum_width), widest), size);
    let seen = summed_mean(table, layer, search) * scale;
    let behind = max(receiver_depth(space, plane, search.center) - seen.x, 1e-6);
    let variance = max(seen.y - seen.x * seen.x, max(minimum_variance, 1e-12));
    // mean = lit * receiver + (1 - lit) * occluder, with lit from Chebyshev's bound, solved for receiver - occluder.
    let gap = (variance + behind * behind) / behind;
    let occluder = max(position.z - gap / space.depth.z, space.depth.x);

    let penumbra = softness * source_width(space, position, size, occluder);
    let region = summed_box(plane.uv, clamp(penumbra, vec2f(minimum_width), widest), size);
    let moments = summed_mean(table, layer, region) * scale;
    let depth = receiver_depth(space, plane, region.center);
    let spread = moments.y - moments.x * moments.x;
    let visibility = summed_bound(depth, moments.x, spread, minimum_variance, bleeding_reduction);
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, plane.uv));
}
