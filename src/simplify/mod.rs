//! Cheaper shaders for a material: a ladder of levels of detail, each with what it costs and how far it is off.
//!
//! Nodes declare in their files in which cheaper forms they can stand for themselves ([`crate::node::Form`]). Every single
//! swap of a node for one of its forms is measured against the full material; then the swaps are made one after the other,
//! that first which saves most for the error that it adds, measuring anew after each (`search`). Of all that was measured
//! on the way, what nothing else beats in both cost and error is the front, and the rungs are taken from it (`front`).
//! This follows Pellacini, "User-Configurable Automatic Shader Simplification" (2005), with forms that authors declare in
//! the place of rules over code. What is measured, and how, is `trial`'s.

mod change;
pub mod front;
#[cfg(feature = "render")]
pub mod ladder;
#[cfg(feature = "render")]
pub mod material;
pub mod search;
pub mod swap;
#[cfg(feature = "render")]
pub mod trial;

pub use change::{Means, made, wanted_means};
pub use search::{Figures, Limits, Oracle, Point, Searched, Single, search, weighed};
pub use swap::{Swap, What, swaps};
