//! shadetree: weaves abstract shade trees into WGSL.

pub mod diagnostic;
pub mod semantic;
pub mod ron;
pub mod graph;
pub mod node;
