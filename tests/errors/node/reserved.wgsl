//! label: Bend
//! category: math

/// x (scalar; = 0.5; 0..1): What is bent.
/// loop (scalar; = 1): How often.
/// -> y (scalar): The bent.
fn reserved(x: f32, loop: f32) -> f32 {
    return x * x;
}
