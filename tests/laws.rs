//! Laws that shadows obey, on a real adapter with woven modules, against float64.

mod adapters;
pub(crate) mod lamp;
mod lights;
mod percentage;
mod planar;
<<<<<<< HEAD
mod splits;
=======
mod summed;
>>>>>>> 2c937fc (Add shadows from summed-area tables, filtered and soft)
mod surfaces;
mod truth;
mod variance;
