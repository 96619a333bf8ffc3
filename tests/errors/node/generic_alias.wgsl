//! label: Bend
//! category: math
//! generic T: f32 | vec3f

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn generic_alias(x: f32) -> f32 {
    return x * x;
}
