//! label: Bend
//! category: math
//! use: hsah, kernel2

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn library(x: f32) -> f32 {
    return x * x;
}
