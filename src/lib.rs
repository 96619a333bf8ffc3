//! shadetree: weaves abstract shade trees into WGSL.

pub mod compile;
pub mod diagnostic;
pub mod module;
pub mod node;
pub mod plan;
#[cfg(feature = "render")]
pub mod render;
pub mod scene;
pub mod semantic;
