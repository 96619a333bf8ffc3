//! Changes to a graph, each of which returns the change that takes it back.

use super::check::{find_cycles, spell};
use super::edit_canvas;
use super::{End, Expose, Frame, Graph, Link, MAX_LINKS, MAX_NODES, Node, check_name};
use crate::semantic::Value;

/// A change to a graph.
#[derive(Clone, Debug)]
pub enum Edit {
    /// Adds a node under a name that is free.
    AddNode(String, Box<Node>),
    /// Removes a node, its links, all that the canvas says of them, and its part in `output` and `expose`.
    RemoveNode(String),
    /// Gives a node another name, everywhere.
    RenameNode(String, String),
    /// Sets the definition that a node is an instance of, or the subgraph that stands in its place.
    SetKind {
        /// The node.
        node: String,
        /// The kind; empty for a subgraph.
        kind: String,
        /// The path of the subgraph, where it is one.
        graph: Option<String>,
    },
    /// Sets or unsets the value of a port.
    SetParam {
        /// The node.
        node: String,
        /// The port.
        param: String,
        /// The value; none unsets it.
        value: Option<Value>,
    },
    /// Sets or unsets an option.
    SetOption {
        /// The node.
        node: String,
        /// The option.
        option: String,
        /// The choice; none unsets it.
        value: Option<String>,
    },
    /// Sets or unsets the WGSL of a node that is defined in place.
    SetWgsl(String, Option<String>),
    /// Passes a node over, or not.
    SetMuted(String, bool),
    /// Sets the remark of a node.
    SetNodeNote(String, String),
    /// Sets the remark of the link between two ends.
    SetLinkNote(End, End, String),
    /// Sets the remark of the graph.
    SetNote(String),
    /// Sets the title of the graph.
    SetName(String),
    /// Adds a link.
    Link(Box<Link>),
    /// Removes the link between two ends, with its bends.
    Unlink(End, End),
    /// Puts a node somewhere on the canvas, or nowhere.
    Move(String, Option<[f64; 2]>),
    /// Sets or removes the frame of a title.
    SetFrame(String, Option<Box<Frame>>),
    /// Gives a frame another title, which is free.
    RenameFrame(String, String),
    /// Draws a node small, or not.
    SetCollapsed(String, bool),
    /// Sets where the link between two ends bends; nowhere, if there are no points.
    SetWaypoints(End, End, Vec<[f64; 2]>),
    /// Sets or unsets what the graph exports.
    SetOutput(Option<End>),
    /// Sets what the graph exposes.
    SetExpose(Box<Expose>),
    /// Several changes, one after the other, all or none. Links may form a cycle on the way, if none is left at the end.
    Batch(Vec<Edit>),
}

/// Why a change cannot be made. The graph is then as it was.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// The node does not exist.
    #[error("there is no node `{0}`")]
    NoNode(String),
    /// The link does not exist.
    #[error("there is no link `{0}`")]
    NoLink(String),
    /// The name is taken.
    #[error("there is already a node `{0}`")]
    NameTaken(String),
    /// The name cannot be a node's.
    #[error("{0}")]
    BadName(String),
    /// The link exists.
    #[error("there is already a link `{0}`")]
    LinkTaken(String),
    /// The link would lead from a node to itself.
    #[error("a link cannot lead from `{0}` to itself")]
    SelfLink(String),
    /// The link would close a cycle.
    #[error("the link would close a cycle: {0}")]
    Cycle(String),
    /// The frame does not exist.
    #[error("there is no frame `{0}`")]
    NoFrame(String),
    /// The title is another frame's.
    #[error("there is already a frame `{0}`")]
    FrameTaken(String),
    /// The frame cannot be drawn.
    #[error("{0}")]
    BadFrame(String),
    /// A number is NaN or infinite.
    #[error("`{0}` must be a finite number")]
    NotFinite(String),
    /// The graph is as large as graphs get.
    #[error("the graph cannot have more {0}")]
    Full(&'static str),
}

/// Makes a change and returns the one that takes it back. The graph is one that was read without errors or made by edits:
/// taking back needs what edits demand, and a link to a node that is not there could not be put back.
pub fn apply(graph: &mut Graph, edit: Edit) -> Result<Edit, EditError> {
    let mut linked = false;
    let inverse = change(graph, edit, &mut linked)?;
    // Looked for once, as putting a thousand links back would otherwise look at the whole graph a thousand times.
    if linked && let Some(cycle) = find_cycles(graph, 1).first() {
        let error = EditError::Cycle(spell(&cycle.nodes));
        // An inverse was made from the very state that it meets, so it cannot fail.
        let _ = change(graph, inverse, &mut linked);
        return Err(error);
    }
    Ok(inverse)
}

/// Makes a change without looking for cycles, and says whether it added a link.
fn change(graph: &mut Graph, edit: Edit, linked: &mut bool) -> Result<Edit, EditError> {
    use std::mem::replace;
    Ok(match edit {
        Edit::AddNode(name, node) => add_node(graph, name, *node)?,
        Edit::RemoveNode(name) => remove_node(graph, name)?,
        Edit::RenameNode(from, to) => rename_node(graph, from, to)?,
        Edit::SetKind { node, kind, graph: path } => {
            let target = node_mut(graph, &node)?;
            target.spans.kind = None;
            // A way through a subgraph is no cycle; through the node that takes its place it is.
            *linked |= target.graph.is_some() && path.is_none();
            let (kind, path) = (replace(&mut target.kind, kind), replace(&mut target.graph, path));
            Edit::SetKind { node, kind, graph: path }
        }
        Edit::SetParam { node, param, value } => {
            let target = node_mut(graph, &node)?;
            if let Some(Value::Numbers(numbers)) = &value
                && !numbers.iter().all(|x| x.is_finite())
            {
                return Err(EditError::NotFinite(param));
            }
            target.spans.params.remove(&param);
            let before = match value {
                Some(value) => target.params.insert(param.clone(), value),
                None => target.params.remove(&param),
            };
            Edit::SetParam { node, param, value: before }
        }
        Edit::SetOption { node, option, value } => {
            let target = node_mut(graph, &node)?;
            target.spans.options.remove(&option);
            let before = match value {
                Some(value) => target.options.insert(option.clone(), value),
                None => target.options.remove(&option),
            };
            Edit::SetOption { node, option, value: before }
        }
        Edit::SetWgsl(node, wgsl) => {
            let target = node_mut(graph, &node)?;
            target.spans.wgsl = None;
            let before = replace(&mut target.wgsl, wgsl);
            Edit::SetWgsl(node, before)
        }
        Edit::SetMuted(node, muted) => {
            let before = replace(&mut node_mut(graph, &node)?.muted, muted);
            Edit::SetMuted(node, before)
        }
        Edit::SetNodeNote(node, note) => {
            let before = replace(&mut node_mut(graph, &node)?.note, note);
            Edit::SetNodeNote(node, before)
        }
        Edit::SetLinkNote(from, to, note) => {
            let index = find_link(graph, &from, &to)?;
            let before = replace(&mut graph.links[index].note, note);
            Edit::SetLinkNote(from, to, before)
        }
        Edit::SetNote(note) => Edit::SetNote(replace(&mut graph.note, note)),
        Edit::SetName(name) => Edit::SetName(replace(&mut graph.name, name)),
        Edit::Link(link) => {
            *linked = true;
            add_link(graph, *link)?
        }
        Edit::Unlink(from, to) => {
            let index = find_link(graph, &from, &to)?;
            let link = Edit::Link(Box::new(graph.links.remove(index)));
            match graph.waypoints.remove(&(from.clone(), to.clone())) {
                Some(points) => Edit::Batch(vec![link, Edit::SetWaypoints(from, to, points)]),
                None => link,
            }
        }
        Edit::Move(node, position) => {
            has_node(graph, &node)?;
            if position.is_some_and(|p| !p.iter().all(|x| x.is_finite())) {
                return Err(EditError::NotFinite(node));
            }
            let before = match position {
                Some(position) => graph.layout.insert(node.clone(), position),
                None => graph.layout.remove(&node),
            };
            Edit::Move(node, before)
        }
        Edit::SetFrame(name, frame) => edit_canvas::set_frame(graph, name, frame)?,
        Edit::RenameFrame(from, to) => edit_canvas::rename_frame(graph, from, to)?,
        Edit::SetCollapsed(node, collapsed) => {
            has_node(graph, &node)?;
            edit_canvas::set_collapsed(graph, node, collapsed)
        }
        Edit::SetWaypoints(from, to, points) => {
            find_link(graph, &from, &to)?;
            edit_canvas::set_waypoints(graph, from, to, points)?
        }
        Edit::SetOutput(output) => {
            output.iter().try_for_each(|end| has_node(graph, &end.node))?;
            Edit::SetOutput(replace(&mut graph.output, output))
        }
        Edit::SetExpose(expose) => {
            expose.ends().try_for_each(|end| has_node(graph, &end.node))?;
            Edit::SetExpose(Box::new(replace(&mut graph.expose, *expose)))
        }
        Edit::Batch(edits) => batch(graph, edits, linked)?,
    })
}

fn has_node(graph: &Graph, name: &str) -> Result<(), EditError> {
    if graph.nodes.contains_key(name) { Ok(()) } else { Err(EditError::NoNode(name.into())) }
}

fn node_mut<'a>(graph: &'a mut Graph, name: &str) -> Result<&'a mut Node, EditError> {
    graph.nodes.get_mut(name).ok_or_else(|| EditError::NoNode(name.into()))
}

fn find_link(graph: &Graph, from: &End, to: &End) -> Result<usize, EditError> {
    let found = graph.links.binary_search_by(|link| link.ends().cmp(&(from, to)));
    found.map_err(|_| EditError::NoLink(format!("{from} -> {to}")))
}

fn free_name(graph: &Graph, name: &str) -> Result<(), EditError> {
    check_name(name).map_err(EditError::BadName)?;
    if graph.nodes.contains_key(name) { Err(EditError::NameTaken(name.into())) } else { Ok(()) }
}

fn add_node(graph: &mut Graph, name: String, node: Node) -> Result<Edit, EditError> {
    free_name(graph, &name)?;
    if graph.nodes.len() >= MAX_NODES {
        return Err(EditError::Full("nodes"));
    }
    for (param, value) in &node.params {
        if value.numbers().is_some_and(|numbers| !numbers.iter().all(|x| x.is_finite())) {
            return Err(EditError::NotFinite(param.clone()));
        }
    }
    graph.nodes.insert(name.clone(), node);
    Ok(Edit::RemoveNode(name))
}

fn remove_node(graph: &mut Graph, name: String) -> Result<Edit, EditError> {
    let node = graph.nodes.remove(&name).ok_or_else(|| EditError::NoNode(name.clone()))?;
    let mut undo = vec![Edit::AddNode(name.clone(), Box::new(node))];
    let gone = |link: &mut Link| link.from.node == name || link.to.node == name;
    undo.extend(graph.links.extract_if(.., gone).map(|link| Edit::Link(Box::new(link))));
    if graph.output.as_ref().is_some_and(|end| end.node == name) {
        undo.push(Edit::SetOutput(graph.output.take()));
    }
    if graph.expose.ends().any(|end| end.node == name) {
        undo.push(Edit::SetExpose(Box::new(graph.expose.clone())));
        for fans in [&mut graph.expose.inputs, &mut graph.expose.options] {
            fans.retain(|_, ends| {
                let before = ends.len();
                ends.retain(|end| end.node != name);
                !ends.is_empty() || before == 0
            });
        }
        graph.expose.outputs.retain(|_, end| end.node != name);
    }
    if let Some(position) = graph.layout.remove(&name) {
        undo.push(Edit::Move(name.clone(), Some(position)));
    }
    if graph.collapsed.remove(&name) {
        undo.push(Edit::SetCollapsed(name.clone(), true));
    }
    let bends = graph.waypoints.extract_if(.., |(from, to), _| from.node == name || to.node == name);
    undo.extend(bends.map(|((from, to), points)| Edit::SetWaypoints(from, to, points)));
    Ok(Edit::Batch(undo))
}

fn rename_node(graph: &mut Graph, from: String, to: String) -> Result<Edit, EditError> {
    has_node(graph, &from)?;
    if from == to {
        return Ok(Edit::RenameNode(to, from));
    }
    free_name(graph, &to)?;
    if let Some(node) = graph.nodes.remove(&from) {
        graph.nodes.insert(to.clone(), node);
    }
    edit_canvas::rename_node(graph, &from, &to);
    let links = graph.links.iter_mut().flat_map(|link| [&mut link.from, &mut link.to]);
    for end in links.chain(&mut graph.output).chain(graph.expose.ends_mut()) {
        if end.node == from {
            end.node.clone_from(&to);
        }
    }
    graph.sort_links();
    Ok(Edit::RenameNode(to, from))
}

fn add_link(graph: &mut Graph, link: Link) -> Result<Edit, EditError> {
    has_node(graph, &link.from.node)?;
    has_node(graph, &link.to.node)?;
    if link.from.node == link.to.node {
        return Err(EditError::SelfLink(link.from.node));
    }
    if graph.links.len() >= MAX_LINKS {
        return Err(EditError::Full("links"));
    }
    let (from, to) = (link.from.clone(), link.to.clone());
    let Err(index) = graph.links.binary_search_by(|other| other.ends().cmp(&link.ends())) else {
        return Err(EditError::LinkTaken(link.to_string()));
    };
    graph.links.insert(index, link);
    Ok(Edit::Unlink(from, to))
}

fn batch(graph: &mut Graph, edits: Vec<Edit>, linked: &mut bool) -> Result<Edit, EditError> {
    let mut undo = Vec::new();
    for edit in edits {
        match change(graph, edit, linked) {
            Ok(inverse) => undo.push(inverse),
            Err(error) => {
                for inverse in undo.into_iter().rev() {
                    // An inverse was made from the very state that it meets, so it cannot fail.
                    let _ = change(graph, inverse, linked);
                }
                return Err(error);
            }
        }
    }
    undo.reverse();
    Ok(Edit::Batch(undo))
}
