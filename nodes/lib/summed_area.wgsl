//! use: chebyshev
//! Boxes over a summed-area table (Crow 1984): each texel of the table is the sum of itself and all texels to its upper left.

/// A box on a map. Along each axis it is a part of one texel, then whole texels, then a part of another.
struct SummedBox {
    /// Columns and rows before its first texel, and up to its last; where there is no last one, up to the map's end.
    first: vec2i,
    last: vec2i,
    /// Parts of the first and of the last texel.
    head: vec2f,
    tail: vec2f,
    /// Texels in it, in all.
    area: f32,
    /// Map coordinate of its middle.
    center: vec2f,
}

/// Sums over the texels above a row of the table: of the box's first column, of its whole ones, and of its last.
struct SummedRun {
    head: vec2u,
    whole: vec2u,
    tail: vec2u,
}

/// The same in floats.
struct SummedFloatRun {
    head: vec2f,
    whole: vec2f,
    tail: vec2f,
}

/// The box around `uv` of a width in texels, at least one, as far as it lies on a map of `size`. At the borders it is
/// smaller, and its middle lies farther in.
fn summed_box(uv: vec2f, width: vec2f, size: vec2f) -> SummedBox {
    let half_width = 0.5 * max(width, vec2f(1.0));
    let low = clamp(uv * size - half_width, vec2f(0.0), size - 1.0);
    let high = clamp(uv * size + half_width, vec2f(1.0), size);
    let first = floor(low);
    // A box of one texel has two ends in different texels, but for rounding and at borders, where it gets the whole one.
    let last = max(floor(high), first + 1.0);
    let head = first + 1.0 - low;
    let tail = clamp(high - last, vec2f(0.0), vec2f(1.0));
    let sides = head + (last - first - 1.0) + tail;
    let center = 0.5 * (low + last + tail) / size;
    return SummedBox(vec2i(first), vec2i(last), head, tail, sides.x * sides.y, center);
}

/// Sum of what lies before a column and a row.
fn summed_before(map: texture_2d_array<u32>, layer: i32, column: i32, row: i32) -> vec2u {
    let sum = textureLoad(map, max(vec2i(column, row) - 1, vec2i(0)), layer, 0).xy;
    return select(sum, vec2u(0u), min(column, row) < 1);
}

/// Sums above a row.
fn summed_run(map: texture_2d_array<u32>, layer: i32, region: SummedBox, row: i32) -> SummedRun {
    let end = min(region.last.x + 1, i32(textureDimensions(map).x));
    let a = summed_before(map, layer, region.first.x, row);
    let b = summed_before(map, layer, region.first.x + 1, row);
    let c = summed_before(map, layer, region.last.x, row);
    let d = summed_before(map, layer, end, row);
    return SummedRun(b - a, c - b, d - c);
}

/// Sum over the rows between two, with parts of columns. Differences of whole numbers are right even where the table has
/// run over, as long as they themselves have not.
fn summed_strip(region: SummedBox, above: SummedRun, below: SummedRun) -> vec2f {
    let ends = region.head.x * vec2f(below.head - above.head) + region.tail.x * vec2f(below.tail - above.tail);
    return ends + vec2f(below.whole - above.whole);
}

/// Mean over a box, in units of the table: the exact mean of what is constant on each texel, which is also what bilinear
/// interpolation of the table at the four corners gives (Hensley and others 2005).
fn summed_mean(map: texture_2d_array<u32>, layer: i32, region: SummedBox) -> vec2f {
    let end = min(region.last.y + 1, i32(textureDimensions(map).y));
    let a = summed_run(map, layer, region, region.first.y);
    let b = summed_run(map, layer, region, region.first.y + 1);
    let c = summed_run(map, layer, region, region.last.y);
    let d = summed_run(map, layer, region, end);
    let ends = region.head.y * summed_strip(region, a, b) + region.tail.y * summed_strip(region, c, d);
    return (ends + summed_strip(region, b, c)) / region.area;
}

/// `summed_before` of a table of floats.
fn summed_before_float(map: texture_2d_array<f32>, layer: i32, column: i32, row: i32) -> vec2f {
    let sum = textureLoad(map, max(vec2i(column, row) - 1, vec2i(0)), layer, 0).xy;
    return select(sum, vec2f(0.0), min(column, row) < 1);
}

/// `summed_run` of a table of floats.
fn summed_run_float(map: texture_2d_array<f32>, layer: i32, region: SummedBox, row: i32) -> SummedFloatRun {
    let end = min(region.last.x + 1, i32(textureDimensions(map).x));
    let a = summed_before_float(map, layer, region.first.x, row);
    let b = summed_before_float(map, layer, region.first.x + 1, row);
    let c = summed_before_float(map, layer, region.last.x, row);
    let d = summed_before_float(map, layer, end, row);
    return SummedFloatRun(b - a, c - b, d - c);
}

/// `summed_strip` of a table of floats.
fn summed_strip_float(region: SummedBox, above: SummedFloatRun, below: SummedFloatRun) -> vec2f {
    let ends = region.head.x * (below.head - above.head) + region.tail.x * (below.tail - above.tail);
    return ends + (below.whole - above.whole);
}

/// `summed_mean` of a table of floats.
fn summed_mean_float(map: texture_2d_array<f32>, layer: i32, region: SummedBox) -> vec2f {
    let end = min(region.last.y + 1, i32(textureDimensions(map).y));
    let a = summed_run_float(map, layer, region, region.first.y);
    let b = summed_run_float(map, layer, region, region.first.y + 1);
    let c = summed_run_float(map, layer, region, region.last.y);
    let d = summed_run_float(map, layer, region, end);
    let ends = region.head.y * summed_strip_float(region, a, b) + region.tail.y * summed_strip_float(region, c, d);
    return (ends + summed_strip_float(region, b, c)) / region.area;
}

/// Lit part of a filter with this mean and variance of depth at most (Chebyshev's inequality, one-sided), with lit parts
/// up to `reduction` counted as dark.
fn summed_bound(depth: f32, mean: f32, variance: f32, least_variance: f32, reduction: f32) -> f32 {
    let behind = max(depth - mean, 0.0);
    // 1e-12 keeps 0 / 0 out where both the variance and the difference vanish.
    return reduce_bleeding(chebyshev_bound(max(variance, max(least_variance, 1e-12)), behind), reduction);
}
