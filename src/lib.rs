//! shadetree: weaves abstract shade trees into WGSL.

pub mod diagnostic;
pub mod semantic;
pub mod node;
