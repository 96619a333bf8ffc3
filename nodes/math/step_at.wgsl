//! label: Step
//! category: math
//! synonyms: step, threshold, cutoff, heaviside, greater than, hard edge, math
//! inline
//! generic T: f32 | vec2f | vec3f | vec4f
//! Zero below an edge, one from the edge on.

alias T = f32;

/// x (number): The value.
/// edge (number; = 0.5): Where the result jumps.
/// -> stepped (number): 0 or 1.
fn step_at(x: T, edge: T) -> T {
    return step(edge, x);
}
