//! All tests that use the package from outside, in one binary.

mod graphs;
mod layers;
mod matrix;
mod support;
mod tint;
