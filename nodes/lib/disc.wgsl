//! Samples of a disc or a square that are turned from pixel to pixel, so that what is missed becomes fine noise.

/// Angle between two neighbours of the spiral: a turn over the square of the golden ratio (Vogel 1979).
const GOLDEN_ANGLE: f32 = 2.3999632;

/// A number in [0, 1) per pixel whose values are spread evenly over any 3 by 3 pixels: interleaved gradient noise
/// (Jimenez 2014, "Next Generation Post Processing in Call of Duty: Advanced Warfare").
fn interleaved_noise(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(floor(pixel), vec2f(0.06711056, 0.00583715))));
}

/// The sample `index` of `count`, spread evenly over the unit disc, turned by `turn` (0..1 of a circle): radius, angle in
/// [0, 2 pi).
fn vogel_sample(index: i32, count: i32, turn: f32) -> vec2f {
    let radius = sqrt((f32(index) + 0.5) / f32(count));
    return vec2f(radius, fract(f32(index) * (GOLDEN_ANGLE / 6.2831853) + turn) * 6.2831853);
}

/// A point of the unit disc from its radius and angle.
fn on_disc(polar: vec2f) -> vec2f {
    return polar.x * vec2f(cos(polar.y), sin(polar.y));
}

/// A point of the square [-1, 1] x [-1, 1] from radius and angle on the unit disc, so that equal areas stay equal: the
/// inverse of the concentric map (Shirley and Chiu 1997). The angle is in [0, 2 pi).
fn on_square(polar: vec2f) -> vec2f {
    // Quarters of the circle around +x, +y, -x and -y become the triangles between the middle and each side.
    let quarter = floor(polar.y * (2.0 / 3.1415927) + 0.5);
    let part = (polar.y * (4.0 / 3.1415927) - 2.0 * quarter) * polar.x;
    let turned = i32(quarter) & 3;
    let sign = select(1.0, -1.0, turned >= 2);
    return sign * select(vec2f(polar.x, part), vec2f(-part, polar.x), (turned & 1) == 1);
}
