//! Filter kernels in texels, shared by the map blur and by percentage-closer filtering, so that equal widths and weights are the same linear filter. Not normalised: divide by the sum of what was used.

/// Gaussian with sigma = width / 4, so that the window of `width` texels spans two standard deviations to either side
/// (95% of the mass; the rest is what normalising restores). Width 3 is then close to the binomial 1 2 1.
fn kernel_gaussian(offset: i32, width: i32) -> f32 {
    let x = 4.0 * f32(offset) / f32(width);
    return select(0.0, exp(-0.5 * x * x), 2 * abs(offset) < width);
}

/// Equal weights.
fn kernel_box(offset: i32, width: i32) -> f32 {
    return select(0.0, 1.0, 2 * abs(offset) < width);
}

/// Falls linearly to zero one texel beyond the window.
fn kernel_tent(offset: i32, width: i32) -> f32 {
    return max(1.0 - 2.0 * f32(abs(offset)) / f32(width + 1), 0.0);
}
