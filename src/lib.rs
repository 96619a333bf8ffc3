//! shadetree: weaves abstract shade trees into WGSL.

pub mod compile;
pub mod diagnostic;
pub mod emit;
pub mod graph;
pub mod module;
pub mod node;
pub mod plan;
pub mod program;
pub mod ron;
pub mod scene;
pub mod semantic;
pub mod weave;
