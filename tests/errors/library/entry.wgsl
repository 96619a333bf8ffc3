@group(0) @binding(0) var t: texture_2d<f32>;
fn twice(x: f32) -> f32 { return 2.0 * x; }
