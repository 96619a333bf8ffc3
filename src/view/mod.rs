//! What an editor does to graphs, without a toolkit: documents with their history, commands that make edits, where nodes
//! lie, what a node's card shows and what can be added. Nothing here draws, reads files or knows the time.

pub mod commands;
mod document;
mod fit;
mod history;
pub mod layout;
pub mod palette;
pub mod ports;

#[cfg(test)]
mod tests;

pub use document::Document;
