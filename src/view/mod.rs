//! What an editor does to graphs, without a toolkit: documents with their history, commands that make edits, where nodes
//! lie, what a node's card shows and what can be added. Nothing here draws, reads files or knows the time.

pub mod commands;
mod document;
pub mod figure;
mod fit;
mod history;
pub mod layout;
pub mod palette;
pub mod ports;

#[cfg(test)]
mod tests;

pub use commands::*;
pub use document::Document;
pub use layout::{arrange, placed};
pub use palette::{Fit, Hit, find, fit_of};
pub use ports::{NodeView, PortView, node_view};
