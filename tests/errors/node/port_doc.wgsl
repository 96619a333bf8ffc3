//! label: Bend
//! category: math

/// x (scalar; = 0.5; 0..1; hiden; in feet):
/// -> y (scalar): The bent.
fn port_doc(x: f32) -> f32 {
    return x * x;
}
