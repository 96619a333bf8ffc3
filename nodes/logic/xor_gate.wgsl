//! label: Exclusive Or
//! category: logic
//! synonyms: xor, different, not equal, boolean math
//! inline
//! commutative
//! True where exactly one input is true.

/// a (bool): First condition.
/// b (bool; = false): Second condition.
/// -> one (bool): a or b, but not both.
fn xor_gate(a: bool, b: bool) -> bool {
    return a != b;
}
