//! label: Bend
//! category: math

/// x (normal world unit; = 0.5): What is bent.
/// -> y (scalar): The bent.
fn meaning_shape(x: f32) -> f32 {
    return x * x;
}
