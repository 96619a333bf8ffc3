//! label: Logarithm
//! category: math
//! synonyms: log, ln, log2, log10, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! The exponent that a base must be raised to to give a value; zero where the value is not positive.
//! option base: natural | binary | decimal = natural - The base: e, 2 or 10.

alias T = f32;

/// x (number): The value.
/// -> logarithm (number): The exponent.
fn logarithm(x: T) -> T {
    let positive = select(T(1.0), x, x > T(0.0));
//#if base == natural
    return log(positive);
//#elif base == binary
    return log2(positive);
//#else
    return log2(positive) * 0.30102999;
//#end
}
