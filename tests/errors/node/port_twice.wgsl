//! label: Bend
//! category: math

/// x (scalar; = 0.5; 0..1): What is bent.
/// x (scalar; = 0.5): Again.
/// -> y (scalar): The bent.
fn port_twice(x: f32) -> f32 {
    return x * x;
}
