//! What an editor does to graphs, without a toolkit: documents with their history, commands that make edits, where nodes
//! lie, what a node's card shows and what can be added. Nothing here draws, reads files or knows the time.

mod document;
mod history;

#[cfg(test)]
mod tests;

pub use document::Document;
