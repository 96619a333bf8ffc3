//! use: light_space
//! What a filter makes of the receiver's own plane. Maps that hold no depth beyond the far plane count what lies there as lying
//! in it, which bends the receiver: the mean of a filter across the bend is nearer to the light than its middle. So the
//! receiver is averaged likewise.

/// Mean of the lesser of depth and 1 where depth is spread evenly up to `reach` around `middle`; at least 0.
fn mean_up_to_far(middle: f32, reach: f32) -> f32 {
    let beyond = clamp(middle + reach - 1.0, 0.0, 2.0 * reach);
    return saturate(middle - beyond * beyond / max(4.0 * reach, 1e-9) - max(middle - reach - 1.0, 0.0));
}

/// The same mean of an exponential of depth that grows by `rate` times itself, is `nearest` at `middle - reach` and `farthest`
/// at the far plane and beyond. No more than `alone`, the exponential of `middle`, which it is where the far plane is out of
/// reach: bends towards the light are none.
fn warped_mean_up_to_far(alone: f32, nearest: f32, farthest: f32, rate: f32, middle: f32, reach: f32) -> f32 {
    let mean = ((farthest - nearest) / rate + farthest * (middle + reach - 1.0)) / max(2.0 * reach, 1e-9);
    return select(alone, min(alone, mean), abs(middle - 1.0) < reach && reach > 1e-4);
}

/// How far (linear depth) a receiver reaches to both sides within a filter of this half width (map coordinates).
fn receiver_reach(space: LightSpace, plane: ReceiverPlane, half_width: vec2f) -> f32 {
    return dot(receiver_slope(space, plane), half_width);
}

/// How far (linear depth) the plane reaches from its depth at `uv` in a box of this width (map coordinates), along u and v.
fn receiver_rise(space: LightSpace, plane: ReceiverPlane, uv: vec2f, width: vec2f) -> vec2f {
    // 1 / distance is even in a perspective, so that distance grows with its own square.
    let growth = receiver_distance(space, plane, uv) / max(plane.distance, 1e-6);
    let stretch = select(1.0, growth * growth, space.projection.z > 0.5);
    return receiver_slope(space, plane) * (0.5 * stretch) * width;
}

/// `receiver_depth`, averaged over a box of this width (map coordinates) around `uv`, as `mean_up_to_far`.
fn receiver_depth_within(space: LightSpace, plane: ReceiverPlane, uv: vec2f, width: vec2f) -> f32 {
    let rise = receiver_rise(space, plane, uv, width);
    return mean_up_to_far(light_linear_depth(space, receiver_distance(space, plane, uv)), rise.x + rise.y);
}

/// Mean and variance of the plane's linear depth in the same box, where what lies beyond the far plane counts as in it. In a
/// perspective 1 / distance is even, so that the mean is deeper than the middle: of distances 1 / w with w from a to b, the
/// mean is ln(b / a) / (b - a) and the mean square 1 / (a b).
fn receiver_moments_within(space: LightSpace, plane: ReceiverPlane, uv: vec2f, width: vec2f) -> vec2f {
    let distance = receiver_distance(space, plane, uv);
    let rise = length(receiver_rise(space, plane, uv, width));
    let depth = light_linear_depth(space, distance);
    let even = vec2f(mean_up_to_far(depth, rise), rise * rise * (1.0 / 3.0));
    // Half the spread of 1 / distance, in parts of its middle; as receivers elsewhere, within four times the distance.
    let spread = rise / (space.depth.z * max(distance, 1e-6));
    let middle = 1.0 / max(distance, 1e-6);
    let farthest = 1.0 / space.depth.y;
    let high = middle * (1.0 + max(spread, 0.05));
    let low = middle * max(1.0 - max(spread, 0.05), 0.25);
    let bend = clamp(farthest, low, high);
    let mean = ((bend - low) / farthest + log(high / bend)) / (high - low);
    let square = ((bend - low) / (farthest * farthest) + (1.0 / bend - 1.0 / high)) / (high - low);
    let variance = max(square - mean * mean, 0.0) * space.depth.z * space.depth.z;
    let uneven = vec2f(saturate(light_linear_depth(space, mean)), variance);
    return select(even, uneven, space.projection.z > 0.5 && spread > 0.05);
}
