//! All tests that use the package from outside, in one binary.

mod cli;
mod graphs;
mod hostile;
mod matrix;
mod support;
