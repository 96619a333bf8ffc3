//! use: box_filter
//! What sums of noise octaves share: octaves too fine for the pixel fade to their average instead of aliasing.

/// Moves an octave away from the origin, where the lattices of all octaves would meet.
fn octave_shift2(octave: i32) -> vec2f {
    return vec2f(17.31, 5.77) * f32(octave);
}

/// `octave_shift2` in space.
fn octave_shift3(octave: i32) -> vec3f {
    return vec3f(17.31, 5.77, 11.19) * f32(octave);
}

/// Largest size of a pixel along the axes of the noise domain.
fn octave_footprint2(p: vec2f) -> f32 {
    let width = pixel_width2(p);
    return max(width.x, width.y);
}

/// `octave_footprint2` in space.
fn octave_footprint3(p: vec3f) -> f32 {
    let width = pixel_width3(p);
    return max(width.x, max(width.y, width.z));
}
