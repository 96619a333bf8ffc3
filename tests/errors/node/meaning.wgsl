//! label: Bend
//! category: math

/// x (sclaar wrold; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn meaning(x: f32) -> f32 {
    return x * x;
}
