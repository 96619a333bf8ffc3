//! label: Bend
//! category: math
//! category: math
//! option size: 3 | 3 = 3 - Size.

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn twice(x: f32) -> f32 {
    return x * x;
}
