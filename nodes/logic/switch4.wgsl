//! label: Switch
//! category: logic
//! synonyms: index switch, select, multiplexer, choose, case, pick
//! generic T: f32 | vec2f | vec3f | vec4f
//! One of four values, by a number; all are computed.

alias T = f32;

/// index (scalar; = 0; 0..3): Which one, rounded to a whole number; beyond the ends the first or the last.
/// zero (number; = 0): The result at 0.
/// one (number; = 1): The result at 1.
/// two (number; = 0): The result at 2.
/// three (number; = 1): The result at 3.
/// -> chosen (number): One of the four.
fn switch4(index: f32, zero: T, one: T, two: T, three: T) -> T {
    let lower = select(zero, one, index >= 0.5);
    let upper = select(two, three, index >= 2.5);
    return select(lower, upper, index >= 1.5);
}
