//! label: Bend
//! category: math

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn conditions(x: f32) -> f32 {
//#if mode == soft
    return x * x;
//#else
    return x;

}
