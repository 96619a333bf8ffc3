//! label: Not
//! category: logic
//! synonyms: not, negate, invert, !, boolean math
//! inline
//! True where the input is false.

/// a (bool): The condition.
/// -> opposite (bool): Not a.
fn not_gate(a: bool) -> bool {
    return !a;
}
