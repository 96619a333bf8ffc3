//! label: Bend
//! category: math
//! sampler y2: filter=linear

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn header_port(x: f32) -> f32 {
    return x * x;
}
