//! label: Bend
//! category: math

/// x (scalar; = 0.5; 0..1): What is bent.
/// -> y (scalar): The bent.
@group(0) @binding(0) var<uniform> more: f32;
@compute @workgroup_size(1) fn main() {}

fn entry(x: f32) -> f32 {
    return x * x;
}
