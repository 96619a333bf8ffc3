//! Changes to what lies on the canvas beside nodes.

use super::edit::{Edit, EditError};
use super::{End, Frame, Graph, MAX_NODES, MAX_WAYPOINTS};

/// Longest title of a frame, in bytes.
const MAX_TITLE: usize = 200;

/// Whether a frame can be drawn. The error says why not.
pub(super) fn check_frame(name: &str, frame: &Frame) -> Result<(), String> {
    if name.trim().is_empty() || name.len() > MAX_TITLE {
        return Err(format!("the title of a frame has 1 to {MAX_TITLE} bytes that are not only spaces"));
    }
    let numbers = frame.at.iter().chain(&frame.size).chain(frame.color.iter().flatten());
    if !numbers.into_iter().all(|x| x.is_finite()) {
        return Err(format!("the frame `{name}` must have finite numbers"));
    }
    if !frame.size.iter().all(|x| *x > 0.0) {
        return Err(format!("the frame `{name}` has no size"));
    }
    if !frame.color.iter().flatten().all(|x| (0.0..=1.0).contains(x)) {
        return Err(format!("the color of the frame `{name}` is not between 0 and 1"));
    }
    Ok(())
}

pub(super) fn set_frame(graph: &mut Graph, name: String, frame: Option<Box<Frame>>) -> Result<Edit, EditError> {
    let before = match frame {
        Some(frame) => {
            check_frame(&name, &frame).map_err(EditError::BadFrame)?;
            if graph.frames.len() >= MAX_NODES && !graph.frames.contains_key(&name) {
                return Err(EditError::Full("frames"));
            }
            graph.frames.insert(name.clone(), *frame)
        }
        None => graph.frames.remove(&name),
    };
    Ok(Edit::SetFrame(name, before.map(Box::new)))
}

pub(super) fn rename_frame(graph: &mut Graph, from: String, to: String) -> Result<Edit, EditError> {
    let frame = graph.frames.get(&from).ok_or_else(|| EditError::NoFrame(from.clone()))?;
    if from != to {
        check_frame(&to, frame).map_err(EditError::BadFrame)?;
        if graph.frames.contains_key(&to) {
            return Err(EditError::FrameTaken(to));
        }
        if let Some(frame) = graph.frames.remove(&from) {
            graph.frames.insert(to.clone(), frame);
        }
    }
    Ok(Edit::RenameFrame(to, from))
}

pub(super) fn set_collapsed(graph: &mut Graph, node: String, collapsed: bool) -> Edit {
    let before = if collapsed { !graph.collapsed.insert(node.clone()) } else { graph.collapsed.remove(&node) };
    Edit::SetCollapsed(node, before)
}

pub(super) fn set_waypoints(graph: &mut Graph, from: End, to: End, points: Vec<[f64; 2]>) -> Result<Edit, EditError> {
    if points.len() > MAX_WAYPOINTS {
        return Err(EditError::Full("bends in one link"));
    }
    if !points.iter().flatten().all(|x| x.is_finite()) {
        return Err(EditError::NotFinite(format!("{from} -> {to}")));
    }
    let key = (from.clone(), to.clone());
    let before = if points.is_empty() { graph.waypoints.remove(&key) } else { graph.waypoints.insert(key, points) };
    Ok(Edit::SetWaypoints(from, to, before.unwrap_or_default()))
}

/// Gives everything on the canvas that says the name of a node the other name.
pub(super) fn rename_node(graph: &mut Graph, from: &str, to: &str) {
    if let Some(position) = graph.layout.remove(from) {
        graph.layout.insert(to.to_owned(), position);
    }
    if graph.collapsed.remove(from) {
        graph.collapsed.insert(to.to_owned());
    }
    let touched = |(a, b): &(End, End), _: &mut Vec<[f64; 2]>| a.node == from || b.node == from;
    let moved: Vec<_> = graph.waypoints.extract_if(.., touched).collect();
    for ((mut a, mut b), points) in moved {
        for end in [&mut a, &mut b] {
            if end.node == from {
                to.clone_into(&mut end.node);
            }
        }
        graph.waypoints.insert((a, b), points);
    }
}
