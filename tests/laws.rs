//! Laws that shadows obey, on a real adapter with woven modules, against float64.

mod lamp;
mod planar;
mod surfaces;
mod variance;
