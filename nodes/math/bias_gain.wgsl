//! label: Bias / Gain
//! category: math
//! synonyms: bias, gain, contrast curve, midtones, ease, sharpen, schlick, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! Bends the line from 0 to 1: bias moves the middle up or down, gain steepens or flattens it.
//! Rational forms of Perlin's curves (Schlick 1994, "Fast Alternatives to Perlin's Bias and Gain Functions").
//! option curve: bias | gain = bias - Which of the two.

alias T = f32;

/// x (number): The value; it is held within 0..1.
/// amount (scalar; = 0.5; 0..1): 0.5 leaves the line straight. Bias: the result at one half. Gain: less is steeper in the middle.
/// -> bent (number): From 0 to 1.
fn bias_gain(x: T, amount: f32) -> T {
    let a = 1.0 / clamp(amount, 0.0001, 0.9999) - 2.0;
    let t = clamp(x, T(0.0), T(1.0));
//#if curve == bias
    return t / (a * (T(1.0) - t) + T(1.0));
//#else
    let lower = t < T(0.5);
    let scaled = a * (T(1.0) - 2.0 * t);
    return select((scaled - t) / (scaled - T(1.0)), t / (scaled + T(1.0)), lower);
//#end
}
