//! label: Ping-Pong
//! category: math
//! synonyms: triangle wave, bounce, mirror repeat, zigzag, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! Goes up to a limit and back to zero, again and again.

alias T = f32;

/// x (number): The value.
/// limit (number; = 1): Where it turns; zero gives zero.
/// -> bounced (number): From 0 to the limit.
fn ping_pong(x: T, limit: T) -> T {
    let top = abs(limit);
    let period = select(2.0 * top, T(1.0), top == T(0.0));
    return min(abs(fract((x - top) / period) * period - top), top);
}
