//! Runs woven modules on a graphics adapter without a window: maps of lights, the picture, and back to the host.
//!
//! It runs any [`crate::module::Module`] with its [`crate::plan::Plan`], also one written by hand, and knows no node,
//! graph or shadow method. It reads no environment variables and no files except through the job's image loader.

mod adapter;
mod blocks;
mod compute;
mod device;
mod error;
mod fingerprint;
mod format;
mod gpu;
pub mod image_file;
mod job;
mod light_space;
mod main_pass;
mod map_passes;
mod map_store;
mod maps;
mod picture_levels;
mod pipeline;
mod read_back;
mod shelf;
mod timing;
mod uploads;

pub use adapter::{AdapterChoice, AdapterOptions, AdapterSummary, adapters};
pub use error::RenderError;
pub use format::Abilities;
pub use gpu::Gpu;
pub use job::{
    ColorFormat, Draw, Frame, ImageLoader, Job, MapPicture, MapSummary, PassTiming, Picture, Surroundings,
    SurroundingsLevel, Texels,
};
pub use light_space::{Bounds, Eye, LIGHT_SPACE_BYTES, LightSpace, Surroundings as LightSurroundings, light_spaces};

#[cfg(test)]
mod tests;
