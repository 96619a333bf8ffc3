//! label: Soft area shadow
//! category: shadow
//! synonyms: pcss, percentage closer soft shadows, contact hardening, penumbra, area light shadow, variable penumbra, blocker search
//! use: receiver, disc
//! Penumbrae as wide as the light is large: occluders around are searched for, and their mean distance says how wide to filter (percentage-closer soft shadows, Fernando 2005). Edges are sharp at contacts and soften with distance. The light's size is its `radius`, `angle`, or `width` and `height`; penumbrae far wider than texels show fine noise. What reaches beyond the map is as its edge: on point lights, whose faces overlap by 1/34 of their width, penumbrae wider than that are cut short at the edges of faces.
//! option search: 8 | 16 | 32 = 16 - Samples that search for occluders.
//! option filter: 16 | 32 | 64 = 32 - Samples of the filter.
//! option turn: pixel | off = pixel - Turn the samples from pixel to pixel, which makes noise, or not, which makes bands.
//! option cull: none | front | back = none - Sides of triangles that are left out.
//! option size: 64 | 128 | 256 | 512 | 1024 | 2048 | 4096 = 2048 - Texels on a side of the map.
//! map map: depth(size=$size, cull=$cull)
//! map depths: depth(size=$size, cull=$cull)
//! sampler map_sampler: filter=nearest address=clamp
//! sampler blending_sampler: compare=on filter=linear address=clamp

const SEARCH: i32 = 16;
const FILTER: i32 = 32;

/// point (point world; = @position_world; hidden): The shaded point.
/// space (space; hidden): The light's space.
/// map (map; hidden): Linear depth of the nearest surface, to compare with.
/// depths (map; hidden): The same, to read: OpenGL does not let one variable do both.
/// map_sampler (sampler; hidden): Reads one texel.
/// blending_sampler (sampler; hidden): Compares with four texels and blends the results.
//#if turn == pixel
/// pixel (point screen; = @pixel; hidden): Where the pixel is.
//#end
/// nearest (scalar; = 0.25; 0.01..1): Occluders nearer to the light than this part of the receiver's distance count as that far: the search then covers what such a one could hide, (1 / nearest - 1) times the light's own size. Parallel light has no such limit but its map.
/// bias (distance; = 0; 0..; in m): Extra distance by which an occluder must be nearer to the light, for surfaces that the plane does not describe.
/// receives (scalar; = @receives; hidden): 0 where the object takes no shadows.
/// -> visibility (scalar visibility): 1 lit, 0 in shadow.
fn pcss_shadow(
    point: vec3f,
    space: LightSpace,
    map: texture_depth_2d_array,
    depths: texture_2d_array<f32>,
    map_sampler: sampler,
    blending_sampler: sampler_comparison,
//#if turn == pixel
    pixel: vec2f,
//#end
    nearest: f32,
    bias: f32,
    receives: f32,
) -> f32 {
    let position = light_position(space, point);
    let plane = receiver_plane(space, position, geometric_normal(point));
    let margin = receiver_margin(space, plane, map, bias);
    let size = vec2f(textureDimensions(map));
    let layer = light_layer(space);
    let source = source_seen(space, position);
//#if turn == pixel
    let turn = interleaved_noise(pixel);
//#else
    let turn = 0.0;
//#end
    // Mean distance, along the light's axis, of what is nearer than the receiver.
    let nearest_distance = max(space.depth.x, clamp(nearest, 0.01, 1.0) * position.z * space.projection.z);
    let reach = penumbra_reach(space, nearest_distance, position.z);
    var total = 0.0;
    var found = 0.0;
    for (var i = 0; i < SEARCH; i++) {
        let offset = on_source(source, vogel_sample(i, SEARCH, turn)) * reach;
        let texel = clamp(floor(light_map_uv(space, position + vec3f(offset, 0.0)) * size), vec2f(0.0), size - 1.0);
        let uv = (texel + 0.5) / size;
        let stored = textureSampleLevel(depths, map_sampler, uv, layer, 0.0).x;
        let nearer = select(0.0, 1.0, stored < compared_depth(space, plane, size, uv, margin));
        total += nearer * stored;
        found += nearer;
    }
    let occluder = space.depth.x + total / max(found, 1.0) / space.depth.z;
    // The samples of the filter are turned against those of the search.
    let width = penumbra_reach(space, max(occluder, nearest_distance), position.z);
    // Metres to texels: how far the ends of its axes lie on the map.
    let first = length(light_map_uv(space, position + vec3f(source.first * width, 0.0)) - plane.uv);
    let second = length(light_map_uv(space, position + vec3f(source.second * width, 0.0)) - plane.uv);
    let texels = max(first, second) * max(size.x, size.y);
    let within = margin_within(margin, texels * mix(1.4142136, 1.0, source.round) + 1.0);
    var sum = 0.0;
    for (var i = 0; i < FILTER; i++) {
        let offset = on_source(source, vogel_sample(i, FILTER, turn + 0.5)) * width;
        sum += compare_blended(space, plane, map, blending_sampler, light_map_uv(space, position + vec3f(offset, 0.0)), within);
    }
    let visibility = select(sum / f32(FILTER), 1.0, found < 0.5);
    return select(visibility, 1.0, receives < 0.5 || outside_light_map(space, position, plane.uv));
}

/// The light as the shaded point sees it, for offsets of the shaded point.
struct SeenSource {
    /// Its half axes, for a reach of 1: metres across the light's axis at the distance of the shaded point.
    first: vec2f,
    second: vec2f,
    /// 1 an ellipse, 0 a rectangle.
    round: f32,
}

/// A shining ball is seen as a disc at right angles to the ray, which a map that looks along another axis stretches away
/// from its middle: by the root of 1 + r^2 at r metres off the axis per metre along it.
fn source_seen(space: LightSpace, position: vec3f) -> SeenSource {
    let half = space.source.xy * mix(1.0, position.z, space.projection.z);
    let ray = light_ray(space, position) * (space.projection.z * space.source.z);
    let radius = length(ray);
    let outwards = select(vec2f(1.0, 0.0), ray / max(radius, 1e-12), radius > 1e-6);
    let stretch = sqrt(1.0 + radius * radius);
    let first = vec2f(outwards.x, outwards.y) * stretch;
    let second = vec2f(-outwards.y, outwards.x);
    return SeenSource(first * half, second * half, space.source.z);
}

/// A sample of it.
fn on_source(source: SeenSource, polar: vec2f) -> vec2f {
    let place = select(on_square(polar), on_disc(polar), source.round > 0.5);
    return source.first * place.x + source.second * place.y;
}

/// What an occluder at a distance makes of the light's half size on the map, for a receiver behind it: similar triangles,
/// in metres along the axis. In rays per metre of source (perspective) or metres per tangent (parallel).
fn penumbra_reach(space: LightSpace, occluder: f32, receiver: f32) -> f32 {
    let parallel = receiver - occluder;
    let perspective = 1.0 / max(occluder, 1e-6) - 1.0 / max(receiver, 1e-6);
    return max(mix(parallel, perspective, space.projection.z), 0.0);
}
