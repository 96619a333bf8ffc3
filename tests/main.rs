//! All tests that use the package from outside, in one binary.

mod graphs;
#[cfg(feature = "render")]
mod images;
#[cfg(feature = "render")]
mod laws;
mod layers;
mod matrix;
#[cfg(feature = "render")]
mod stage;
mod support;
mod tint;
