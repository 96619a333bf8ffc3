//! Laws that shadows obey, on a real adapter with woven modules, against float64.

mod adapters;
pub(crate) mod lamp;
mod lights;
mod percentage;
mod planar;
mod splits;
mod surfaces;
mod truth;
mod variance;
