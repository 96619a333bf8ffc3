//! shadetree: weaves abstract shade trees into WGSL.

pub mod diagnostic;
mod hash;
mod markup;
pub mod semantic;
pub mod ron;
pub mod graph;
pub mod node;
pub mod weave;
pub mod program;
pub mod plan;
pub mod module;
pub mod emit;
pub mod compile;
pub mod verify;
pub mod cost;
pub mod export;
pub mod reflect;
pub mod scene;
pub mod reference;
pub mod choose;
pub mod view;
#[cfg(feature = "render")]
pub mod render;
pub mod studio;
pub mod study;
pub mod chart;
pub mod simplify;
#[cfg(feature = "render")]
pub mod preview;
#[cfg(feature = "gui")]
pub mod gui;
pub mod explain;
pub mod report;
pub mod cli;
