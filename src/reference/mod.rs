//! What shadows ought to be, in float64 and without a line in common with the shaders: filter kernels, closed forms of
//! percentage-closer filtering and of variance shadow maps over planes, and the exhaustive filter over planar layers.
//!
//! Conventions: depth runs from 0 at the light's near plane to 1 at its far plane. Map positions are in texels, with
//! texel (i, j) covering [i, i + 1) x [j, j + 1) and sampled at its centre. Visibility is the lit share, 1 or less.

mod kernel;
mod layers;
mod variance;

pub use kernel::{Weights, box_ramp, edge_visibility, gaussian_ramp, kernel};
pub use layers::{Layer, Layers, Taps};
pub use variance::{Mix, chebyshev, reduce_bleeding, spread_cured_by, worst_bleeding};
