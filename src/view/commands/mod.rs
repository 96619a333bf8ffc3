//! What a person does to a graph, as edits: each command looks at a graph and makes the one edit that does it, which is
//! one step of the history. None changes anything by itself. Names that are not in the graph are passed over.

mod add;
mod canvas;
mod clipboard;
mod connect;
mod delete;
mod kinds;
mod names;
mod replace;
mod subgraph;

pub use add::{Insert, add, add_linked, insert_on_link};
pub use canvas::{How, align, frame, move_all, move_frame, place_missing, set_collapsed, set_muted};
pub use clipboard::{copy, duplicate, paste};
pub use connect::{connect, pin};
pub use delete::delete;
pub use kinds::{change_kind, compatible_kinds, swap_kind};
pub use names::free_name;
pub use replace::replace;
pub use subgraph::{expose, expose_option, expose_output, make_subgraph, unexpose};

use crate::graph::{Edit, End, Graph, Link};

/// A wire whose other end is loose.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pending {
    /// The end that is not loose.
    pub end: End,
    /// Whether that end is an output.
    pub from_output: bool,
}

/// The link between two ends.
fn find_link<'a>(graph: &'a Graph, from: &End, to: &End) -> Option<&'a Link> {
    graph.links.iter().find(|link| link.from == *from && link.to == *to)
}

/// Edits that give a link other ends, with its note and its bends; where there is such a link already, it is left.
fn relink(graph: &Graph, link: &Link, from: End, to: End, out: &mut Vec<Edit>) {
    if (&link.from, &link.to) == (&from, &to) {
        return;
    }
    out.push(Edit::Unlink(link.from.clone(), link.to.clone()));
    let made = |edit: &Edit| matches!(edit, Edit::Link(other) if other.from == from && other.to == to);
    if find_link(graph, &from, &to).is_some() || out.iter().any(made) {
        return;
    }
    let moved = Link { from: from.clone(), to: to.clone(), span: None, ..link.clone() };
    out.push(Edit::Link(Box::new(moved)));
    if let Some(points) = graph.waypoints.get(&(link.from.clone(), link.to.clone())) {
        out.push(Edit::SetWaypoints(from, to, points.clone()));
    }
}
