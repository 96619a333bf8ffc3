//! Where things lie and how they are drawn.

use std::collections::BTreeSet;

use super::names::Names;
use crate::graph::{Edit, Frame, Graph};
use crate::view::layout::placed;

/// Space between a frame and what it stands around, in points.
const AROUND: f64 = 24.0;
/// Space for a frame's title, in points.
const TITLE: f64 = 32.0;

/// How nodes are put in line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum How {
    /// Left edges at the leftmost.
    Left,
    /// Right edges at the rightmost.
    Right,
    /// Top edges at the topmost.
    Top,
    /// Bottom edges at the bottommost.
    Bottom,
    /// Middles above each other.
    CenterX,
    /// Middles beside each other.
    CenterY,
    /// Equal gaps from left to right.
    DistributeX,
    /// Equal gaps from top to bottom.
    DistributeY,
}

/// Passes nodes over, or not.
pub fn set_muted(graph: &Graph, nodes: &BTreeSet<String>, muted: bool) -> Edit {
    let other = |name: &&String| graph.nodes.get(*name).is_some_and(|node| node.muted != muted);
    Edit::Batch(nodes.iter().filter(other).map(|name| Edit::SetMuted(name.clone(), muted)).collect())
}

/// Draws nodes small, or not.
pub fn set_collapsed(graph: &Graph, nodes: &BTreeSet<String>, collapsed: bool) -> Edit {
    let there = |name: &&String| graph.nodes.contains_key(*name);
    let other = |name: &&String| graph.collapsed.contains(*name) != collapsed;
    let changed = nodes.iter().filter(there).filter(other);
    Edit::Batch(changed.map(|name| Edit::SetCollapsed(name.clone(), collapsed)).collect())
}

/// Gives a place to every node that has none, as [`placed`] does.
pub fn place_missing(graph: &Graph, sizes: &dyn Fn(&str) -> [f64; 2]) -> Edit {
    if graph.nodes.keys().all(|name| graph.layout.contains_key(name)) {
        return Edit::Batch(Vec::new());
    }
    let places = placed(graph, sizes).into_iter().filter(|(name, _)| !graph.layout.contains_key(name));
    Edit::Batch(places.map(|(name, at)| Edit::Move(name, Some(at))).collect())
}

/// Moves nodes. Those that have no place yet stay without; [`place_missing`] gives them one.
pub fn move_all(graph: &Graph, nodes: &BTreeSet<String>, delta: [f64; 2]) -> Edit {
    let mut edits = Vec::new();
    for name in nodes {
        let place = graph.layout.get(name).filter(|_| graph.nodes.contains_key(name));
        edits.extend(place.map(|[x, y]| Edit::Move(name.clone(), Some([x + delta[0], y + delta[1]]))));
    }
    // Bends between two nodes that move go along.
    for ((from, to), points) in &graph.waypoints {
        if nodes.contains(&from.node) && nodes.contains(&to.node) {
            let points = points.iter().map(|[x, y]| [x + delta[0], y + delta[1]]).collect();
            edits.push(Edit::SetWaypoints(from.clone(), to.clone(), points));
        }
    }
    Edit::Batch(edits)
}

/// Moves a frame with the nodes whose middles, and the frames of which all, lie in it.
pub fn move_frame(graph: &Graph, name: &str, delta: [f64; 2], sizes: &dyn Fn(&str) -> [f64; 2]) -> Edit {
    let Some(frame) = graph.frames.get(name) else { return Edit::Batch(Vec::new()) };
    let inside = |x: f64, y: f64| {
        let [left, top] = frame.at;
        (left..=left + frame.size[0]).contains(&x) && (top..=top + frame.size[1]).contains(&y)
    };
    let middle = |node: &str, [x, y]: [f64; 2]| {
        let [width, height] = sizes(node);
        (x + width / 2.0, y + height / 2.0)
    };
    let held = graph.layout.iter().filter(|(node, at)| {
        let (x, y) = middle(node, **at);
        inside(x, y)
    });
    let nodes: BTreeSet<String> = held.map(|(node, _)| node.clone()).collect();
    let mut edits = vec![move_all(graph, &nodes, delta)];
    for (other, held) in &graph.frames {
        let [x, y] = held.at;
        if other == name || (inside(x, y) && inside(x + held.size[0], y + held.size[1])) {
            let moved = Frame { at: [x + delta[0], y + delta[1]], ..held.clone() };
            edits.push(Edit::SetFrame(other.clone(), Some(Box::new(moved))));
        }
    }
    Edit::Batch(edits)
}

/// A frame around nodes, and its title. Around nothing it is an empty one at the origin.
pub fn frame(graph: &Graph, nodes: &BTreeSet<String>, sizes: &dyn Fn(&str) -> [f64; 2]) -> (Edit, String) {
    let title = Names::default().numbered("Frame", ' ', &|name| graph.frames.contains_key(name));
    let boxes = boxes(graph, nodes, sizes);
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for (_, at, size) in &boxes {
        for axis in 0..2 {
            low[axis] = low[axis].min(at[axis]);
            high[axis] = high[axis].max(at[axis] + size[axis]);
        }
    }
    if boxes.is_empty() {
        (low, high) = ([0.0; 2], [200.0, 100.0]);
    }
    let at = [low[0] - AROUND, low[1] - AROUND - TITLE];
    let size = [high[0] - at[0] + AROUND, high[1] - at[1] + AROUND];
    let frame = Frame { at, size, ..Frame::default() };
    (Edit::SetFrame(title.clone(), Some(Box::new(frame))), title)
}

/// A node's name, place and size.
type Box2 = (String, [f64; 2], [f64; 2]);

fn boxes(graph: &Graph, nodes: &BTreeSet<String>, sizes: &dyn Fn(&str) -> [f64; 2]) -> Vec<Box2> {
    let placed = nodes.iter().filter_map(|name| Some((name, graph.layout.get(name)?)));
    let there = placed.filter(|(name, _)| graph.nodes.contains_key(*name));
    let finite = |size: [f64; 2]| size.map(|x| if x.is_finite() { x.max(0.0) } else { 0.0 });
    there.map(|(name, at)| (name.clone(), *at, finite(sizes(name)))).collect()
}

/// Puts nodes in line.
pub fn align(graph: &Graph, nodes: &BTreeSet<String>, sizes: &dyn Fn(&str) -> [f64; 2], how: How) -> Edit {
    let mut boxes = boxes(graph, nodes, sizes);
    let axis = usize::from(matches!(how, How::Top | How::Bottom | How::CenterY | How::DistributeY));
    let start = boxes.iter().map(|(_, at, _)| at[axis]).fold(f64::INFINITY, f64::min);
    let end = boxes.iter().map(|(_, at, size)| at[axis] + size[axis]).fold(f64::NEG_INFINITY, f64::max);
    let total: f64 = boxes.iter().map(|(_, _, size)| size[axis]).sum();
    if matches!(how, How::DistributeX | How::DistributeY) {
        boxes.sort_by(|a, b| (a.1[axis] + a.2[axis] / 2.0).total_cmp(&(b.1[axis] + b.2[axis] / 2.0)));
    }
    let gap = (end - start - total) / boxes.len().saturating_sub(1).max(1) as f64;
    let mut cursor = start;
    let mut edits = Vec::new();
    for (name, at, size) in boxes {
        let mut place = at;
        place[axis] = match how {
            How::Left | How::Top => start,
            How::Right | How::Bottom => end - size[axis],
            How::CenterX | How::CenterY => f64::midpoint(start, end) - size[axis] / 2.0,
            How::DistributeX | How::DistributeY => cursor,
        };
        cursor += size[axis] + gap;
        if place != at {
            edits.push(Edit::Move(name, Some(place)));
        }
    }
    Edit::Batch(edits)
}
