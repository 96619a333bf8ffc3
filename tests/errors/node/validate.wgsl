//! label: Bend
//! category: math

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn validate(x: f32) -> f32 {
    return vec2f(x);
}
