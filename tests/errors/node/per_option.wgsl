//! label: Bend
//! category: math
//! option mode: soft | hard = soft - How.

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
fn per_option(x: f32) -> f32 {
//#if mode == soft
    return x * x;
//#else
    return x * z;
//#end
}
