//! label: Reciprocal
//! category: math
//! synonyms: inverse, one over, 1/x, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! One divided by a value; zero where the value is zero.

alias T = f32;

/// x (number): The value.
/// -> reciprocal (number): 1 / x.
fn reciprocal(x: T) -> T {
    let none = x == T(0.0);
    return select(T(1.0) / select(x, T(1.0), none), T(0.0), none);
}
