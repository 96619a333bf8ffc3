//! label: Smoothstep
//! category: math
//! synonyms: smoothstep, smooth threshold, ease, s-curve, soft edge, hermite, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! Goes from zero to one between two edges, with no slope at both.
//! The cubic 3t^2 - 2t^3. Edges in falling order go from one to zero; equal edges make a hard step.

alias T = f32;

/// x (number): The value.
/// low (number; = 0): Where the result is still 0.
/// high (number; = 1): Where the result has become 1.
/// -> stepped (number): From 0 to 1.
fn smooth_step(x: T, low: T, high: T) -> T {
    let span = high - low;
    let none = span == T(0.0);
    let t = clamp((x - low) / select(span, T(1.0), none), T(0.0), T(1.0));
    return select(t * t * (3.0 - 2.0 * t), step(low, x), none);
}
