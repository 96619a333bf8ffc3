//! label: Square Root
//! category: math
//! synonyms: sqrt, root, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! The square root of a value; zero where the value is negative.

alias T = f32;

/// x (number): The value.
/// -> root (number): The number that gives x when it is squared.
fn square_root(x: T) -> T {
    return sqrt(max(x, T(0.0)));
}
