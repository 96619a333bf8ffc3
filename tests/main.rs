//! All tests that use the package from outside, in one binary.
#![allow(unreachable_pub, reason = "modules of one test binary see each other")]

mod errors;
mod graphs;
mod layers;
mod matrix;
mod support;
mod tint;
