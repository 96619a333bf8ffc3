//! What shadows ought to be, in float64 and without a line in common with the shaders or their hosts: filter kernels,
//! closed forms of percentage-closer filtering and of variance shadow maps over planes, the exhaustive filter over planar
//! layers, boxes over summed-area tables; and for any scene ([`World`], [`Light`]) the exhaustive filter over a map many times finer ([`FineMap`]), and
//! visibility by rays ([`rays`]), for points or whole pictures ([`picture`]).
//!
//! Conventions: depth runs from 0 at the light's near plane to 1 at its far plane. Map positions are in texels, with
//! texel (i, j) covering [i, i + 1) x [j, j + 1) and sampled at its centre. Visibility is the lit share, 1 or less.

mod area;
mod bvh;
mod fine_map;
mod footprint;
mod exponential;
mod eye;
mod hamburger;
mod kernel;
mod layers;
mod metrics;
mod light;
mod parts;
pub mod picture;
mod ray;
pub mod rays;
mod source;
mod summed;
mod variance;
mod view;
mod world;

pub use area::{Emitter, penumbra_scale, rectangle_irradiance};
pub use bvh::Bvh;
pub use exponential::{exponential, warped_bound, worst_warped_bleeding};
pub use fine_map::{Filter, FineMap};
pub use footprint::filter_below;
pub use hamburger::{hamburger, signed_moments};
pub use kernel::{Weights, box_ramp, edge_visibility, gaussian_ramp, kernel};
pub use layers::{Layer, Layers, Taps};
pub use light::{Choice, Light};
pub use metrics::Metrics;
pub use parts::Cut;
pub use ray::Ray;
pub use rays::Estimate;
pub use source::Source;
pub use summed::{box_mean, float_mean_bound, table_additions, variance_bound, whole_mean_bound};
pub use variance::{Mix, chebyshev, reduce_bleeding, spread_cured_by, worst_bleeding};
pub use view::{Projection, View};
pub use world::{Body, Point, World};
