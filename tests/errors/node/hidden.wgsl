//! label: Bend
//! category: math

/// x (scalar; hidden): What is bent.
/// -> y (scalar): The bent.
fn hidden(x: f32) -> f32 {
    return x * x;
}
