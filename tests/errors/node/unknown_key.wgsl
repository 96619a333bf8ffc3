//! label: Bend
//! category: math
//! catagory: math
//! optoin: x

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn unknown_key(x: f32) -> f32 {
    return x * x;
}
