//! label: If Greater
//! category: logic
//! synonyms: if, branch, comparison, greater than, switch, condition, threshold
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! One of two values, by whether a number is greater than another; both are computed.

alias T = f32;

/// a (scalar): The number that is asked about.
/// b (scalar; = 0.5): The number that it is compared with.
/// greater (number; = 1): The result where a is greater than b.
/// otherwise (number; = 0): The result elsewhere.
/// -> chosen (number): One of the two.
fn if_greater(a: f32, b: f32, greater: T, otherwise: T) -> T {
    return select(otherwise, greater, a > b);
}
