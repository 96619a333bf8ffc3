//! label: Snap
//! category: math
//! synonyms: snap, quantize, round to multiple, steps, grid, posterize, math
//! generic T: f32 | vec2f | vec3f | vec4f
//! Rounds a value down to a multiple of a step.

alias T = f32;

/// x (number): The value.
/// increment (number; = 0.1): Distance between the multiples; zero leaves the value as it is.
/// -> snapped (number): The nearest multiple that is not above x.
fn snap_value(x: T, increment: T) -> T {
    let none = increment == T(0.0);
    let distance_apart = abs(select(increment, T(1.0), none));
    return select(floor(x / distance_apart) * distance_apart, x, none);
}
