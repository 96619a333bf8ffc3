//! A triangle that covers the whole target.

/// Clip position of vertex 0, 1 or 2.
fn fullscreen_position(vertex: u32) -> vec4f {
    let corner = vec2f(f32(vertex & 1u), f32(vertex >> 1u));
    return vec4f(corner * 4.0 - 1.0, 0.0, 1.0);
}
