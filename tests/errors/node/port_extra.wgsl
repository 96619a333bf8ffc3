//! label: Bend
//! category: math

/// x (scalar; = 0.5; 0..1): What is bent.
/// strenght (scalar; = 1): How much.
/// -> y (scalar): The bent.
fn port_extra(x: f32) -> f32 {
    return x * x;
}
