//! label: Bend
//! category: math

/// x (scalar; = half; 0..1): What is bent.
/// -> y (scalar): The bent.
fn default_value(x: f32) -> f32 {
    return x * x;
}
