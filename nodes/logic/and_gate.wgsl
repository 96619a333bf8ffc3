//! label: And
//! category: logic
//! synonyms: and, both, &&, boolean math, conjunction
//! inline
//! commutative
//! True where both inputs are true.

/// a (bool): First condition.
/// b (bool; = true): Second condition.
/// -> both (bool): a and b.
fn and_gate(a: bool, b: bool) -> bool {
    return a && b;
}
