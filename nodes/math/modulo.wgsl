//! label: Modulo
//! category: math
//! synonyms: mod, remainder, floored modulo, fmod, %, repeat, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! The remainder of a floored division: it repeats without a break through zero and has the divisor's sign.

alias T = f32;

/// x (number): Dividend.
/// divisor (number; = 1): Length of a period; zero gives zero.
/// -> remainder (number): From 0 up to, not including, the divisor.
fn modulo(x: T, divisor: T) -> T {
    let period = select(divisor, T(1.0), divisor == T(0.0));
    let remainder = x - period * floor(x / period);
    // Rounding can end on the divisor itself, or a hair on the other side of zero.
    let outside = (abs(remainder) >= abs(divisor)) | (remainder * sign(divisor) < T(0.0));
    return select(remainder, T(0.0), outside);
}
