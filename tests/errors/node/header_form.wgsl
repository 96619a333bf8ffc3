//! label: Bend
//! category: math
//! label:
//! option size
//! option mode: soft | hard
//! space: perspective(x)
//! use: a b

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn header_form(x: f32) -> f32 {
    return x * x;
}
