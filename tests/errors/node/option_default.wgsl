//! label: Bend
//! category: math
//! option mode: soft | hard = sotf - How.

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn option_default(x: f32) -> f32 {
    return x * x;
}
