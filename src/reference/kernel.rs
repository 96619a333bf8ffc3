//! Filter kernels and what they make of a straight shadow edge.

/// Shape of a filter kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weights {
    /// Equal weights.
    Box,
    /// A Gaussian whose standard deviation is a quarter of the width, cut off at the width.
    Gaussian,
    /// Falls linearly to zero one texel beyond the width.
    Tent,
}

impl Weights {
    /// Every shape with the name that options give it.
    pub const ALL: [(&'static str, Self); 3] = [("box", Self::Box), ("gaussian", Self::Gaussian), ("tent", Self::Tent)];
}

/// Weights of `width` (odd) texels around a middle one; they sum to 1.
pub fn kernel(weights: Weights, width: usize) -> Vec<f64> {
    let width_f = width as f64;
    let middle = (width_f - 1.0) / 2.0;
    let weight = |i: usize| {
        let offset = i as f64 - middle;
        match weights {
            Weights::Box => 1.0,
            Weights::Gaussian => (-(offset / (width_f / 4.0)).powi(2) / 2.0).exp(),
            Weights::Tent => 1.0 - offset.abs() / ((width_f + 1.0) / 2.0),
        }
    };
    let all: Vec<f64> = (0..width).map(weight).collect();
    let sum: f64 = all.iter().sum();
    all.into_iter().map(|w| w / sum).collect()
}

/// Visibility at `x` texels beyond a straight edge that runs along texel boundaries, lit where x is positive: the
/// kernel over texels, each interpolated linearly with its neighbour. Exact for percentage-closer filtering with
/// bilinear taps, and for a blurred and bilinearly sampled variance map of one plane above another.
pub fn edge_visibility(kernel: &[f64], x: f64) -> f64 {
    let middle = (kernel.len() as f64 - 1.0) / 2.0;
    let ramp = |x: f64| (x + 0.5).clamp(0.0, 1.0);
    kernel.iter().enumerate().map(|(i, w)| w * ramp(x + i as f64 - middle)).sum()
}

/// [`edge_visibility`] of equal weights in closed form: a ramp as wide as the kernel.
pub fn box_ramp(width: f64, x: f64) -> f64 {
    (0.5 + x / width).clamp(0.0, 1.0)
}

/// Visibility beyond a straight edge under a Gaussian that is neither cut off nor sampled: what [`edge_visibility`]
/// of [`Weights::Gaussian`] approximates.
pub fn gaussian_ramp(deviation: f64, x: f64) -> f64 {
    // The integral of the density by Simpson's rule: its error is far below 1e-9 at these 400 steps.
    const STEPS: u32 = 400;
    let end = (x / deviation).clamp(-8.0, 8.0);
    let step = end / f64::from(STEPS);
    let density = |t: f64| (-t * t / 2.0).exp() / std::f64::consts::TAU.sqrt();
    let inner: f64 = (1..STEPS).map(|i| density(step * f64::from(i)) * if i % 2 == 1 { 4.0 } else { 2.0 }).sum();
    0.5 + (density(0.0) + inner + density(end)) * step / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_are_normalised_symmetric_and_fall_outwards() {
        for (name, weights) in Weights::ALL {
            for width in [1, 3, 5, 7, 9, 11] {
                let kernel = kernel(weights, width);
                assert!((kernel.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{name} {width}");
                let mirrored: Vec<f64> = kernel.iter().rev().copied().collect();
                assert!(kernel.iter().zip(&mirrored).all(|(a, b)| (a - b).abs() < 1e-15), "{name} {width}");
                assert!(kernel[..=width / 2].is_sorted(), "{name} {width}");
            }
        }
        assert_eq!(kernel(Weights::Tent, 3), [0.25, 0.5, 0.25]);
    }

    #[test]
    fn an_edge_under_equal_weights_is_a_ramp_of_their_width() {
        for width in [1, 3, 5, 7, 11] {
            let kernel = kernel(Weights::Box, width);
            for step in -100..=100 {
                let x = f64::from(step) * 0.07;
                assert!((edge_visibility(&kernel, x) - box_ramp(width as f64, x)).abs() < 1e-12, "{width} {x}");
            }
        }
    }

    /// What is cut off, 2.3% at each end, is all that tells them apart where the kernel has many texels.
    #[test]
    fn an_edge_under_gaussian_weights_is_near_the_error_function() {
        let worst = |width: usize| {
            let kernel = kernel(Weights::Gaussian, width);
            let off = |x: f64| (edge_visibility(&kernel, x) - gaussian_ramp(width as f64 / 4.0, x)).abs();
            (-100..=100).map(|i| off(f64::from(i) * 0.1)).fold(0.0, f64::max)
        };
        let tail = gaussian_ramp(1.0, -2.0);
        assert!((worst(11) - tail).abs() < 1e-3 && (worst(3) - tail).abs() < 5e-3, "{} {}", worst(11), worst(3));
        assert!((gaussian_ramp(1.0, 1.0) - 0.841_344_746).abs() < 1e-9);
        assert!((gaussian_ramp(1.0, 0.0) - 0.5).abs() < 1e-15);
    }

    #[test]
    fn edges_are_half_lit_on_the_edge_and_mirror_about_it() {
        for (name, weights) in Weights::ALL {
            for width in [1, 3, 5, 11] {
                let kernel = kernel(weights, width);
                assert!((edge_visibility(&kernel, 0.0) - 0.5).abs() < 1e-12, "{name} {width}");
                for x in [0.3, 1.0, 2.7] {
                    let sum = edge_visibility(&kernel, x) + edge_visibility(&kernel, -x);
                    assert!((sum - 1.0).abs() < 1e-12, "{name} {width} {x}");
                }
            }
        }
    }
}
