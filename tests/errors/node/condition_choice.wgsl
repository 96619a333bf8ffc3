//! label: Bend
//! category: math
//! option mode: soft | hard = soft - How.

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn condition_choice(x: f32) -> f32 {
//#if mode == sotf
    return x * x;
//#elif moed == hard
    return x;
//#end
}
