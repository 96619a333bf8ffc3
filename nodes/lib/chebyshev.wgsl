//! Bounds on visibility from a mean and a variance.

/// The lit share of a filter at most, of a receiver that is not in front of the mean (Cantelli's inequality; Donnelly and
/// Lauritzen 2006, section 3). `variance` is above 0.
fn chebyshev_bound(variance: f32, behind: f32) -> f32 {
    return variance / (variance + behind * behind);
}

/// Counts lit shares up to `amount` as dark and stretches the rest to [0, 1].
fn reduce_bleeding(visibility: f32, amount: f32) -> f32 {
    let least = clamp(amount, 0.0, 0.99);
    return saturate((visibility - least) / (1.0 - least));
}
