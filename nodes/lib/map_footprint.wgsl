//! Reads a filterable map over the footprint of a pixel, in the same way on every device.

/// How a footprint is covered: `taps` fetches of mip `level`, `step` apart (map coordinates). Taps are counted in f32: Mesa
/// 22's lavapipe crashes on loops over whole numbers whose end differs from pixel to pixel.
struct MapFootprint {
    level: f32,
    taps: f32,
    step: vec2f,
}

/// Taps along the longer side of the parallelogram that a pixel covers on a map of `size`, as many as it is wider than the
/// other side or than a texel, and at most `most`; each filters as widely as they lie apart.
fn map_footprint(size: vec2f, uv_dx: vec2f, uv_dy: vec2f, most: f32) -> MapFootprint {
    let across = length(uv_dx * size);
    let down = length(uv_dy * size);
    let longer = max(across, down);
    let taps = clamp(ceil(longer / max(min(across, down), 1.0) - 0.01), 1.0, most);
    let level = log2(max(longer / taps, 1.0));
    return MapFootprint(level, taps, select(uv_dy, uv_dx, across > down) / taps);
}

/// Half of the width (map coordinates) of what the taps of a footprint cover, with what they interpolate.
fn footprint_reach(size: vec2f, uv_dx: vec2f, uv_dy: vec2f, most: f32) -> vec2f {
    let footprint = map_footprint(size, uv_dx, uv_dy, most);
    return 0.5 * footprint.taps * abs(footprint.step) + exp2(ceil(footprint.level)) / size;
}

/// The mean over a footprint through a sampler that interpolates. `most`: longest footprint in widths that is followed.
fn sample_footprint(
    map: texture_2d_array<f32>,
    map_sampler: sampler,
    uv: vec2f,
    layer: i32,
    uv_dx: vec2f,
    uv_dy: vec2f,
    most: f32,
) -> vec4f {
    let footprint = map_footprint(vec2f(textureDimensions(map)), uv_dx, uv_dy, most);
    let first = uv - 0.5 * (footprint.taps - 1.0) * footprint.step;
    var sum = vec4f(0.0);
    for (var i = 0.0; i < footprint.taps; i += 1.0) {
        sum += textureSampleLevel(map, map_sampler, first + i * footprint.step, layer, footprint.level);
    }
    return sum / footprint.taps;
}

/// Four texels of a mip level, weighted by their distance: what an interpolating sampler does, with exact weights, for
/// formats that cannot be interpolated. `map_sampler` takes the nearest texel. (Texels are not loaded by their numbers:
/// software adapters take the mip level of one pixel for its neighbours, too, whose numbers then mean other places.)
fn blend_texels(map: texture_2d_array<f32>, map_sampler: sampler, uv: vec2f, layer: i32, level: f32) -> vec4f {
    let size = vec2f(textureDimensions(map, i32(level)));
    let corner = uv * size - 0.5;
    let low = (floor(corner) + 0.5) / size;
    let high = low + 1.0 / size;
    let part = corner - floor(corner);
    let upper = mix(
        textureSampleLevel(map, map_sampler, low, layer, level),
        textureSampleLevel(map, map_sampler, vec2f(high.x, low.y), layer, level),
        part.x,
    );
    let lower = mix(
        textureSampleLevel(map, map_sampler, vec2f(low.x, high.y), layer, level),
        textureSampleLevel(map, map_sampler, high, layer, level),
        part.x,
    );
    return mix(upper, lower, part.y);
}

/// The same mean as `sample_footprint`, through a sampler that takes the nearest texel.
fn blend_footprint(
    map: texture_2d_array<f32>,
    map_sampler: sampler,
    uv: vec2f,
    layer: i32,
    uv_dx: vec2f,
    uv_dy: vec2f,
    most: f32,
) -> vec4f {
    let footprint = map_footprint(vec2f(textureDimensions(map)), uv_dx, uv_dy, most);
    let first = uv - 0.5 * (footprint.taps - 1.0) * footprint.step;
    let last = f32(textureNumLevels(map)) - 1.0;
    let fine = min(floor(footprint.level), last);
    let coarse = min(fine + 1.0, last);
    var sum = vec4f(0.0);
    for (var i = 0.0; i < footprint.taps; i += 1.0) {
        let place = first + i * footprint.step;
        let upper = blend_texels(map, map_sampler, place, layer, fine);
        let lower = blend_texels(map, map_sampler, place, layer, coarse);
        sum += mix(upper, lower, saturate(footprint.level - fine));
    }
    return sum / footprint.taps;
}
