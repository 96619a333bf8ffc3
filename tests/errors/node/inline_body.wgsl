//! label: Bend
//! category: math
//! inline

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn inline_body(x: f32) -> f32 {
    let y = x * x;
    return y;
}
