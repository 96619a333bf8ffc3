//! label: Exponential
//! category: math
//! synonyms: exp, exp2, e to the x, power of two, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! A fixed base raised to a value; the result is held within what a 32-bit number can hold.
//! option base: natural | binary = natural - The base: e, or 2.

alias T = f32;

/// x (number): The exponent.
/// -> power (number): The base to the x.
fn exponential(x: T) -> T {
//#if base == natural
    return exp(clamp(x, T(-87.0), T(88.0)));
//#else
    return exp2(clamp(x, T(-126.0), T(127.0)));
//#end
}
