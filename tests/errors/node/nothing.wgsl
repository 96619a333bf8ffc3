//! label: Bend
//! category: math

/// x (scalar; = 0.5; 0..1): What is bent.
fn nothing(x: f32) {

}
