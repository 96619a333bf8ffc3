//! Laws that shadows obey, on a real adapter with woven modules, against float64.

mod adapters;
mod discs;
mod exponential;
mod kept;
pub(crate) mod lamp;
mod lights;
mod many;
mod methods;
mod minification;
mod pairs;
mod penumbra;
mod percentage;
mod planar;
mod precision;
mod rectangle;
mod seams;
pub(crate) mod splits;
mod storage;
mod summed;
mod surfaces;
mod truth;
mod variance;
