//! label: Cheaper
//! category: math
//! option steps: 1 | 2 | 4 = 4 - How many.
//! cheaper: constant
//! cheaper: faster - Not a form.
//! cheaper: option stps = 4 > 2 - Not an option.
//! cheaper: option steps = 4 > 3 - Not a choice.
//! cheaper: option steps = 4 - Only one.
//! cheaper: input y - Not an input.
//! cheaper: kind sine(x = 2 * (x - 1) - Not closed.
//! cheaper: kind sine(x) - Not a formula.
//! cheaper: kind sine(x = 2 + * x) - Not a formula either.
//! cheaper: kind sine(x = 2 * w) - Not an input.
//! Wrong in every way.

/// x (number): X.
/// -> value (number): Y.
fn cheaper(x: f32) -> f32 {
    return x;
}
