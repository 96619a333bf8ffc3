//! Node definitions read from WGSL files, and the catalogue of them.

mod catalog;
mod cheaper;
mod check;
mod codes;
mod conditional;
mod custom;
mod definition;
mod document;
mod file;
mod formula;
mod functions;
mod header;
mod items;
mod pass;
mod pass_header;
mod ports;
mod projection;
mod report;
mod settings;
mod sources;
#[cfg(test)]
mod tests;
mod tokens;
mod verify;

pub use catalog::Catalog;
pub use cheaper::{CheaperSpec, Form};
pub use codes::CODES;
pub use custom::custom;
pub use definition::{
    Choices, Default, Definition, Function, Header, Item, Library, MapSpec, OptionSpec, Port, SamplerSpec, SpaceSpec,
    TextureSpec,
};
pub use document::{json, markdown, text};
pub use file::NodeFile;
pub use formula::{Formula, Known};
pub use header::CATEGORIES;
pub use pass::{PassFile, PassKind, Skip, reachable};
pub use projection::{MOST_VIEWS, PROJECTIONS, Projection};
pub use sources::{Source, source, sources};
pub use tokens::{Token, TokenKind, is_identifier, is_reserved, mentions, rename, tokenize};
