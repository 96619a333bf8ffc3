//! label: True / False
//! category: logic
//! synonyms: boolean, bool, toggle, switch, constant, checkbox
//! inline
//! A truth value to set by hand.

/// truth (bool; = true): The value.
/// -> truth (bool): The same value.
fn true_false(truth: bool) -> bool {
    return truth;
}
