//! label: Bend
//! category: math
//! option width: 3 | 5 = 3 - Taps.
//! sampler x: filter=$widht

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn header_option(x: f32) -> f32 {
    return x * x;
}
