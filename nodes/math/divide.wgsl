//! label: Divide
//! category: math
//! synonyms: quotient, ratio, over, /, safe divide, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! The quotient of two values, component by component; zero where the divisor is zero.

alias T = f32;

/// a (number): Dividend.
/// b (number; = 1): Divisor.
/// -> quotient (number): a / b.
fn divide(a: T, b: T) -> T {
    let none = b == T(0.0);
    return select(a / select(b, T(1.0), none), T(0.0), none);
}
