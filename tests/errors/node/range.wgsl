//! label: Bend
//! category: math

/// x (scalar; = 0.5; 1..0): What is bent.
/// -> y (scalar): The bent.
fn range(x: f32) -> f32 {
    return x * x;
}
