//! What the colour ramps share.

/// How far `x` has come from `start` to `end`, kept within 0..1; a step where both are equal.
fn ramp_share(x: f32, start: f32, end: f32) -> f32 {
    let span = end - start;
    // The smallest span keeps its sign, so that reversed ramps stay reversed.
    let safe_span = select(span, select(1e-6, -1e-6, span < 0.0), abs(span) < 1e-6);
    return clamp((x - start) / safe_span, 0.0, 1.0);
}
