//! Periodic signals averaged over the width of a pixel, in closed form, so that patterns do not alias.
//! A width is the size of a pixel in periods; the average is the difference of the signal's integral at its two ends.

/// Size of a pixel in units of `x`: the box whose variance equals that of the pixel's footprint.
fn pixel_width1(x: f32) -> f32 {
    return length(vec2f(dpdx(x), dpdy(x)));
}

/// `pixel_width1` of each component.
fn pixel_width2(x: vec2f) -> vec2f {
    let across = dpdx(x);
    let down = dpdy(x);
    return sqrt(across * across + down * down);
}

/// `pixel_width1` of each component.
fn pixel_width3(x: vec3f) -> vec3f {
    let across = dpdx(x);
    let down = dpdy(x);
    return sqrt(across * across + down * down);
}

/// Widths below this would lose the difference of integrals to rounding; above the upper end the average is reached.
fn filter_span(width: f32) -> f32 {
    return clamp(width, 1e-3, 1e4);
}

/// Integral from 0 to `x` of the pulse train that is 1 in [n, n + duty) and 0 elsewhere.
fn pulse_integral(x: f32, duty: f32) -> f32 {
    let whole = floor(x);
    return whole * duty + min(x - whole, duty);
}

/// Average over `width` of a pulse train of period 1 that is 1 in [n, n + duty): 0..1.
fn filtered_pulse(x: f32, duty: f32, width: f32) -> f32 {
    let span = filter_span(width);
    let near_zero = x - floor(x);
    let half_span = 0.5 * span;
    let area = pulse_integral(near_zero + half_span, duty) - pulse_integral(near_zero - half_span, duty);
    return clamp(area / span, 0.0, 1.0);
}

/// Average over `width` of a square wave of period 2 that is 1 in [2n, 2n + 1) and -1 elsewhere: -1..1.
fn filtered_square(x: f32, width: f32) -> f32 {
    return 2.0 * filtered_pulse(0.5 * x, 0.5, 0.5 * width) - 1.0;
}

/// Integral from 0 to `x` of the sawtooth x - floor(x).
fn saw_integral(x: f32) -> f32 {
    let whole = floor(x);
    let rest = x - whole;
    return 0.5 * (whole + rest * rest);
}

/// Average over `width` of the sawtooth x - floor(x): 0..1.
fn filtered_saw(x: f32, width: f32) -> f32 {
    let span = filter_span(width);
    let near_zero = x - floor(x);
    let half_span = 0.5 * span;
    return clamp((saw_integral(near_zero + half_span) - saw_integral(near_zero - half_span)) / span, 0.0, 1.0);
}

/// Integral from 0 to `x` of the triangle wave that is 0 at whole numbers and 1 half way between them.
fn triangle_integral(x: f32) -> f32 {
    let whole = floor(x);
    let rest = x - whole;
    let back = 1.0 - rest;
    return 0.5 * whole + select(0.5 - back * back, rest * rest, rest < 0.5);
}

/// Average over `width` of the triangle wave that is 0 at whole numbers and 1 half way between them: 0..1.
fn filtered_triangle(x: f32, width: f32) -> f32 {
    let span = filter_span(width);
    let near_zero = x - floor(x);
    let half_span = 0.5 * span;
    let area = triangle_integral(near_zero + half_span) - triangle_integral(near_zero - half_span);
    return clamp(area / span, 0.0, 1.0);
}

/// Average over `width` of the wave that is 0 at whole numbers and 1 half way between them, shaped as a cosine: 0..1.
fn filtered_cosine(x: f32, width: f32) -> f32 {
    let half_angle = 3.1415927 * clamp(width, 1e-3, 1e4);
    return 0.5 - 0.5 * cos(6.2831853 * (x - floor(x))) * sin(half_angle) / half_angle;
}

/// 1 inside and 0 outside of an edge, blended over one pixel; `distance` is positive inside, `width` a pixel.
fn filtered_edge(distance: f32, width: f32) -> f32 {
    return clamp(distance / max(width, 1e-6) + 0.5, 0.0, 1.0);
}

/// 1 while a feature of size 1 is larger than about four pixels, 0 once it is smaller than two.
fn detail_left(width: f32) -> f32 {
    return clamp(2.0 - 4.0 * width, 0.0, 1.0);
}
