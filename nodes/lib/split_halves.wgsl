//! Two numbers in four half floats, each in two parts: a multiple of 1/1024 and 1024 times the rest. A half float has 11
//! bits, so both parts of a number below 2 are exact but for the last bits of the rest: errors stay below 2^-21. Both parts
//! are linear in what is stored, so any filter may run over them before they are joined; but the sum of a filter must be
//! split anew when it is stored, as the first part is then no multiple any more.

/// What the rest is multiplied by.
const SPLIT_FACTOR: f32 = 1024.0;

fn split_halves(value: vec2f) -> vec4f {
    let scaled = value * SPLIT_FACTOR;
    let whole = floor(scaled);
    let rest = scaled - whole;
    return vec4f(whole.x / SPLIT_FACTOR, rest.x, whole.y / SPLIT_FACTOR, rest.y);
}

fn join_halves(parts: vec4f) -> vec2f {
    return parts.xz + parts.yw / SPLIT_FACTOR;
}
