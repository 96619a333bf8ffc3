//! label: Choose
//! category: logic
//! synonyms: branch, select, switch, if else, ternary, boolean switch
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! One of two values, by a condition; both are computed.

alias T = f32;

/// condition (bool): Which one.
/// if_true (number; = 1): The result where the condition is true.
/// if_false (number; = 0): The result elsewhere.
/// -> chosen (number): One of the two.
fn choose(condition: bool, if_true: T, if_false: T) -> T {
    return select(if_false, if_true, condition);
}
