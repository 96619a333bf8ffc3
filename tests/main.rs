//! All tests that use the package from outside, in one binary.

mod errors;
mod graphs;
mod matrix;
mod support;
