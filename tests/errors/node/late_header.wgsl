//! label: Bend
//! category: math

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn late_header(x: f32) -> f32 {
//! use: hash
    return x * x;
}
