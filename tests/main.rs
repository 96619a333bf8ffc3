//! All tests that use the package from outside, in one binary.
#![allow(unreachable_pub, reason = "modules of one test binary see each other")]
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "tests say what they skip and how much they did")]

mod chart;
mod cli;
mod errors;
mod graphs;
mod hostile;
#[cfg(feature = "render")]
mod images;
#[cfg(feature = "render")]
mod laws;
mod layers;
mod made_study;
mod matrix;
#[cfg(feature = "render")]
mod minimal;
mod simplify;
#[cfg(feature = "render")]
mod stability;
#[cfg(feature = "render")]
mod stage;
mod support;
mod tint;
