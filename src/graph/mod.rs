//! The document a person edits: nodes, links, what is exposed, where things lie on the canvas.
//!
//! This module knows no catalog, no WGSL and no files. It reads and writes the text of a graph, edits it in steps that
//! return their inverse, and expands subgraphs that somebody else loads.
//!
//! **Comments** become data. A `//` or `/* */` comment is read as if it were part of the `note` of what it stands at:
//! the node or link whose line it ends, that begins right below it or that it stands inside; the graph otherwise. The
//! writer writes notes, so rewriting a file moves comments but loses none.
//!
//! **The canvas** is data, too: `layout`, `frames`, `collapsed` and `waypoints` say where things lie and how they are
//! drawn. They come last in the file, and no shader depends on them. What they say of a node or link that is not there is
//! passed over, with a warning.
//!
//! **Unknown fields** of the graph, a node, a link, a frame or `expose` are kept and written back after the known ones, with a
//! warning.

mod check;
mod comments;
mod document;
mod edit;
mod edit_canvas;
mod expand;
mod migrate;
mod read;
mod read_canvas;
mod read_node;
mod reroute;
mod write;
mod write_canvas;

#[cfg(test)]
mod tests;

pub use document::{End, Expose, Frame, Graph, Link, Node, Setting, Spans, check_name};
pub use edit::{Edit, EditError, apply};
pub use expand::{Loader, expand};
pub use read::read;
pub use write::write;

/// The version of the file format that is written.
pub const VERSION: u32 = 1;
/// Most nodes of a graph, also after its subgraphs are expanded.
pub const MAX_NODES: usize = 20_000;
/// Most links of a graph, also after its subgraphs are expanded.
pub const MAX_LINKS: usize = 100_000;
/// Most bends of a link on the canvas.
pub const MAX_WAYPOINTS: usize = 64;
/// Deepest nesting of subgraphs.
pub const MAX_NESTING: usize = 32;

/// What each code of this module means, for `shadetree explain`.
pub const CODES: &[(&str, &str)] = &[
    ("ST0050", "The file does not hold a `Graph(...)`."),
    ("ST0051", "The graph does not say `version: 1`, or says something that is not a version."),
    ("ST0052", "The graph was written by a newer version of shadetree."),
    ("ST0053", "A node has a name that links cannot spell. Names consist of letters, digits, `_`, `-` and spaces."),
    ("ST0054", "A node must say either which `kind` it is or which `graph` file stands in its place."),
    ("ST0055", "A link, output or exposed end is not written as `node`, `node.port` or `from -> to`."),
    ("ST0056", "A link, output, exposed end or something on the canvas names a node or link that is not in the graph."),
    ("ST0057", "A link leads from a node to itself."),
    ("ST0058", "The same link is given twice."),
    ("ST0059", "The links form a cycle, so no node of it can be computed first."),
    ("ST0060", "The graph has more nodes or links than are handled."),
    ("ST0061", "A parameter has a value that is neither a truth value, nor numbers, nor a text."),
    ("ST0062", "Subgraph files contain each other in a cycle."),
    ("ST0063", "Subgraphs are nested more deeply than 32 levels."),
    ("ST0064", "A subgraph does not expose the input, output, parameter or option that is used."),
    ("ST0065", "A link to or from a subgraph names no port, and the subgraph offers several."),
    ("ST0066", "The graph has too many mistakes to list them all."),
    ("ST0067", "A parameter or option inside a subgraph is set twice, through two names."),
    ("ST0068", "A subgraph could not be loaded."),
    (
        "ST0069",
        "Something on the canvas cannot be drawn: a frame without a title or a size, or a link of too many bends.",
    ),
];
