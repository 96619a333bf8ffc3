//! label: Bend
//! category: math

/// x (scalar; = 0.5; zero..1): What is bent.
/// -> y (scalar): The bent.
fn range_form(x: f32) -> f32 {
    return x * x;
}
