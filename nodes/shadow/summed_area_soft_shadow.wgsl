//! label: Summed-area soft shadow
//! category: shadow
//! synonyms: pcss, percentage closer soft shadow, vssm, variance soft shadow, satvsm, area light shadow, penumbra
//! use: light_space, summed_area, receiver_within
//! Soft shadow of a light with a size (Fernando 2005) from a summed-area table of moments: one box finds how far away the occluders are, another as wide as their penumbra filters (Lauritzen 2007; Yang and others 2010, section 3). Exact for one plane above another and a rectangular light, in wide boxes to half a texel; a round one is taken for the rectangle of equal variance. Wide boxes are cut into four by four, each with the depth that the receiver's plane has there (Yang and others 2010, section 4), so that slopes do not count as variance. It fails where the first box holds surfaces behind the receiver, which hide occluders from the mean and harden the edge; where occluders lie at several depths, which are taken for one and bleed; and where the penumbra is wider than the widest box, which cuts it off.
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

/// Parts along a side of a wide box, and the least width in texels of one that is cut: of narrower parts, which end at whole
/// texels, the stairs would be seen.
const PARTS: i32 = 4;
const LEAST_CUT: f32 = 32.0;

/// What a box says of the receiver: the lit share at most, with the reduction of bleeding; or, in search of occluders, the dark
/// share and that times their depth (linear), both times the dark share, so that of the parts of a box those count that
/// know most.
struct Seen {
    lit: f32,
    dark: f32,
    occluder: f32,
}

/// The same of a box, or a part of one, around `uv`, from its moments. In search of occluders the receiver's own moments are
/// taken off: at grazing light its slope is so much variance that occluders would seem few, and so near to the light.
fn seen_by_moments(
    space: LightSpace,
    plane: ReceiverPlane,
    uv: vec2f,
    width: vec2f,
    moments: vec2f,
    least_variance: f32,
    reduction: f32,
    search: bool,
) -> Seen {
    let variance = moments.y - moments.x * moments.x;
    if (search) {
        let own = receiver_moments_within(space, plane, uv, width);
        let dark = 1.0 - summed_bound(own.x, moments.x, variance - own.y, least_variance, 0.0);
        // The mean is that of what is dark and of the receiver here, which may be far from the shaded point.
        let occluder = max(moments.x - (1.0 - dark) * own.x, 0.0);
        return Seen(1.0 - dark, dark * dark, dark * occluder);
    }
    let depth = receiver_depth_within(space, plane, uv, width);
    return Seen(summed_bound(depth, moments.x, variance, least_variance, reduction), 0.0, 0.0);
}

/// One box as a whole, with parts of texels.
fn seen_in_whole(
    space: LightSpace,
    plane: ReceiverPlane,
    table: texture_2d_array<u32>,
    width: vec2f,
    least_variance: f32,
    reduction: f32,
    search: bool,
) -> Seen {
    let size = vec2f(textureDimensions(table));
    let region = summed_box(plane.uv, width, size);
    let moments = summed_mean(table, light_layer(space), region) * (1.0 / f32(1u << FRACTION_BITS));
    // Parts of texels are as deep as all of them: half a texel more at each end.
    let sides = (width + 1.0) / size;
    return seen_by_moments(space, plane, region.center, sides, moments, least_variance, reduction, search);
}

/// The mean over the parts of a box, each of whole texels.
fn seen_in_parts(
    space: LightSpace,
    plane: ReceiverPlane,
    table: texture_2d_array<u32>,
    width: vec2f,
    least_variance: f32,
    reduction: f32,
    search: bool,
) -> Seen {
    let size = vec2f(textureDimensions(table));
    let low = clamp(plane.uv * size - 0.5 * width, vec2f(0.0), size - 1.0);
    let high = clamp(plane.uv * size + 0.5 * width, vec2f(1.0), size);
    let layer = light_layer(space);
    var seen = Seen(0.0, 0.0, 0.0);
    var total = 0.0;
    var above = array<vec2u, PARTS + 1>();
    for (var j = 0; j <= PARTS; j++) {
        let rows = round(mix(vec2f(low.y), vec2f(high.y), vec2f(f32(j) - 1.0, f32(j)) / f32(PARTS)));
        var before = array<vec2u, PARTS + 1>();
        for (var i = 0; i <= PARTS; i++) {
            let columns = round(mix(vec2f(low.x), vec2f(high.x), vec2f(f32(i) - 1.0, f32(i)) / f32(PARTS)));
            before[i] = summed_before(table, layer, i32(columns.y), i32(rows.y));
            let area = (columns.y - columns.x) * (rows.y - rows.x);
            if (i > 0 && j > 0 && area > 0.0) {
                let sum = (before[i] - before[i - 1]) - (above[i] - above[i - 1]);
                let moments = vec2f(sum) * (1.0 / f32(1u << FRACTION_BITS)) / area;
                let center = vec2f(columns.x + columns.y, rows.x + rows.y) * 0.5 / size;
                let sides = vec2f(columns.y - columns.x, rows.y - rows.x) / size;
                let part =
                    seen_by_moments(space, plane, center, sides, moments, least_variance, reduction, search);
                seen.lit += area * part.lit;
                seen.dark += area * part.dark;
                seen.occluder += area * part.occluder;
                total += area;
            }
        }
        above = before;
    }
    let share = 1.0 / max(total, 1.0);
    return Seen(seen.lit * share, seen.dark * share, seen.occluder * share);
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
    let size = vec2f(textureDimensions(table));
    // As many texels of depth 1 as the sum of them has room for.
    let widest = vec2f(f32(1u << ((32u - FRACTION_BITS) / 2u)));

    // Occluders are nearer than the receiver and beyond the near plane: there the light appears largest.
    let largest = softness * source_width(space, position, size, space.depth.x);
    let search = clamp(largest, vec2f(minimum_width), widest);
    var found = Seen(1.0, 0.0, 0.0);
    if (min(search.x, search.y) < LEAST_CUT) {
        found = seen_in_whole(space, plane, table, search, minimum_variance, 0.0, true);
    } else {
        found = seen_in_parts(space, plane, table, search, minimum_variance, 0.0, true);
    }
    // The mean over what is dark. Where next to nothing is, its distance does not matter.
    let depth = found.occluder / max(found.dark, 1e-6);
    let occluder = select(position.z, space.depth.x + depth / space.depth.z, found.dark > 1e-6);

    let width = clamp(softness * source_width(space, position, size, occluder), vec2f(minimum_width), widest);
    var filtered = Seen(1.0, 0.0, 0.0);
    if (min(width.x, width.y) < LEAST_CUT) {
        filtered = seen_in_whole(space, plane, table, width, minimum_variance, bleeding_reduction, false);
    } else {
        filtered = seen_in_parts(space, plane, table, width, minimum_variance, bleeding_reduction, false);
    }
    return select(filtered.lit, 1.0, receives < 0.5 || outside_light_map(space, position, plane.uv));
}
