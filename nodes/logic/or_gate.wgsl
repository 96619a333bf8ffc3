//! label: Or
//! category: logic
//! synonyms: or, either, ||, boolean math, disjunction
//! inline
//! commutative
//! True where at least one input is true.

/// a (bool): First condition.
/// b (bool; = false): Second condition.
/// -> either (bool): a or b.
fn or_gate(a: bool, b: bool) -> bool {
    return a || b;
}
