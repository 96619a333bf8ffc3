//! label: Bend
//! category: math

/// x scalar: What is bent.
/// -> y (scalar): The bent.
fn port_form(x: f32) -> f32 {
    return x * x;
}
