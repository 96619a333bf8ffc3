//! label: Wrap
//! category: math
//! synonyms: wrap, repeat, loop, cycle, modulo range, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! Repeats a range: what leaves it at one end comes in at the other.

alias T = f32;

/// x (number): The value.
/// low (number; = 0): Lower end of the range, included.
/// high (number; = 1): Upper end of the range, left out; equal ends give the lower one.
/// -> wrapped (number): The value within the range.
fn wrap_value(x: T, low: T, high: T) -> T {
    let span = high - low;
    let none = span == T(0.0);
    let share = fract((x - low) / select(span, T(1.0), none));
    // The fraction of a tiny negative number rounds to one, which is the range's start.
    return low + span * select(share, T(0.0), none | (share >= T(1.0)));
}
