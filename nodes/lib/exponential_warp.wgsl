//! Exponential warps of depth, in which what lies nearer to the light counts for next to nothing (Lauritzen and McCool 2008).
//! Both are scaled by powers of two or so, as bounds do not depend on the scale, such that the far plane is warped to a
//! number that maps can be cleared to, and that the squares fit the format; at its lower end, too: variances are differences
//! of squares, and devices take what is below 2^-126 for nothing.

/// Greatest exponents c of e^(c (2 depth - 1)) whose squares fit 32 and 16 bits.
const SINGLE_EXPONENT: f32 = 42.0;
const HALF_EXPONENT: f32 = 5.54;
/// The far plane under the rising and the falling warp, 32 and 16 bits.
const SINGLE_RISING_FAR: f32 = 1152921504606846976.0;
const HALF_RISING_FAR: f32 = 240.0;
const SINGLE_FALLING_FAR: f32 = 1.0;
const HALF_FALLING_FAR: f32 = 0.00390625;
/// The same of falling exponents above this, whose squares need the whole range of 32 bits.
const STEEP_EXPONENT: f32 = 20.0;
const STEEP_FALLING_FAR: f32 = 5.551115123125783e-17;

/// The rising warp: e^(c (2 depth - 1)), scaled to `far` at depth 1.
fn rising_warp(depth: f32, exponent: f32, far: f32) -> f32 {
    return far * exp(2.0 * exponent * (depth - 1.0));
}

/// The falling warp, which also rises with depth: -e^(-c (2 depth - 1)), scaled to `-far` at depth 1.
fn falling_warp(depth: f32, exponent: f32, far: f32) -> f32 {
    return -far * exp(2.0 * exponent * (1.0 - depth));
}

/// What the falling warp of 32 bits makes of the far plane, but for the sign.
fn single_falling_far(exponent: f32) -> f32 {
    return select(SINGLE_FALLING_FAR, STEEP_FALLING_FAR, exponent > STEEP_EXPONENT);
}
