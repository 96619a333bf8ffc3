//! Filter kernels whose width in texels need not be whole. At odd widths they are those of `kernel`. Not normalised.

/// Gaussian with sigma = width / 4, cut off at the width.
fn spread_gaussian(offset: i32, width: f32) -> f32 {
    let x = 4.0 * f32(offset) / width;
    return select(0.0, exp(-0.5 * x * x), 2.0 * f32(abs(offset)) < width);
}

/// The part of a texel that a box of the width covers.
fn spread_box(offset: i32, width: f32) -> f32 {
    return saturate(0.5 * width + 0.5 - f32(abs(offset)));
}

/// Falls linearly to zero half a texel beyond the width.
fn spread_tent(offset: i32, width: f32) -> f32 {
    return max(1.0 - 2.0 * f32(abs(offset)) / (width + 1.0), 0.0);
}
