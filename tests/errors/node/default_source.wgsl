//! label: Bend
//! category: math

/// x (scalar; = @noraml_world; 0..1): What is bent.
/// -> y (scalar): The bent.
fn default_source(x: f32) -> f32 {
    return x * x;
}
