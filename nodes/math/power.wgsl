//! label: Power
//! category: math
//! synonyms: pow, exponent, raise, ^, square, cube, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! A value raised to an exponent.
//! A negative base has a power for whole exponents only; for others, and for zero to a negative exponent, the result is 0.

alias T = f32;

/// base (number): The value that is raised.
/// exponent (number; = 2): How far.
/// -> power (number): The base to the exponent.
fn power(base: T, exponent: T) -> T {
    let zero = base == T(0.0);
    let magnitude = pow(select(abs(base), T(1.0), zero), exponent);
    let half = exponent * 0.5;
    let whole = floor(exponent) == exponent;
    let even = floor(half) == half;
    let negative = select(T(0.0), select(-magnitude, magnitude, even), whole);
    let of_zero = select(T(0.0), T(1.0), exponent == T(0.0));
    return select(select(magnitude, negative, base < T(0.0)), of_zero, zero);
}
