//! label: Bend
//! category: math

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn bend(x: f32) -> f32 {
    return x * x;
}
