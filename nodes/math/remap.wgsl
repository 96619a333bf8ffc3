//! label: Remap
//! category: math
//! synonyms: map range, range, rescale, fit, normalize range, inverse lerp, remap value, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! Takes a value from one range to another.
//! option clamp_result: on | off = on - Whether a value outside the first range stays at the end of the second one.
//! option ramp: linear | smooth | smoother = linear - The curve between: straight, 3t^2 - 2t^3, or 6t^5 - 15t^4 + 10t^3 (Perlin 2002).

alias T = f32;

/// x (number): The value.
/// from_low (number; = 0): Start of the range that the value lies in.
/// from_high (number; = 1): End of that range; an empty range gives the start of the other.
/// to_low (number; = 0): Start of the range of the result.
/// to_high (number; = 1): End of that range.
/// -> remapped (number): The value in its new range.
fn remap(x: T, from_low: T, from_high: T, to_low: T, to_high: T) -> T {
    let span = from_high - from_low;
    let none = span == T(0.0);
    let share = select((x - from_low) / select(span, T(1.0), none), T(0.0), none);
//#if ramp == linear
//#if clamp_result == on
    let t = clamp(share, T(0.0), T(1.0));
//#else
    let t = share;
//#end
    return to_low + (to_high - to_low) * t;
//#else
    let t = clamp(share, T(0.0), T(1.0));
//#if ramp == smooth
    let eased = t * t * (3.0 - 2.0 * t);
//#else
    let eased = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
//#end
//#if clamp_result == on
    return to_low + (to_high - to_low) * eased;
//#else
    // Beyond the ends, where the curve has no slope, the straight line goes on.
    return to_low + (to_high - to_low) * (eased + share - t);
//#end
//#end
}
