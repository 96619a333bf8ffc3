//! label: Value
//! category: math
//! synonyms: number, float, constant, scalar, parameter, slider
//! inline
//! A number to set by hand and to use in several places.

/// value (number; = 1): The number.
/// -> value (number): The same number.
fn value(value: f32) -> f32 {
    return value;
}
