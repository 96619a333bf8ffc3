//! label: Bend
//! category: math

/// x (scalar; = 0.5; 1..2): What is bent.
/// -> y (scalar): The bent.
fn range_default(x: f32) -> f32 {
    return x * x;
}
