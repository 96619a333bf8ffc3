//! label: Smooth Minimum
//! category: math
//! synonyms: smooth min, smin, soft minimum, blend shapes, metaball, math
//! commutative
//! generic T: f32 | vec2f | vec3f | vec4f
//! The smaller of two values, with the corner where they cross rounded off.
//! Where they differ by less than the width, a parabola of the difference is taken away, which joins both branches with
//! an equal slope.

alias T = f32;

/// a (number): First value.
/// b (number; = 1): Second value.
/// width (scalar; = 0.1; 0..): How far apart the values may be and still round the corner.
/// -> minimum (number): At most the smaller value; a quarter of the width below it where both are equal.
fn smooth_minimum(a: T, b: T, width: f32) -> T {
    let reach = max(width, 1e-6);
    let overlap = max(T(reach) - abs(a - b), T(0.0)) / reach;
    return min(a, b) - overlap * overlap * (0.25 * reach);
}
