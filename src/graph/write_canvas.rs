//! The last part of a graph's text: where things lie on the canvas and how they are drawn.

use super::write::{block, remark};
use super::{Frame, Graph};
use crate::ron;

pub(super) fn canvas(out: &mut String, graph: &Graph) {
    let layout = graph.layout.iter().map(|(name, position)| format!("{}: {}", ron::text(name), tuple(position)));
    block(out, 1, "layout", ['{', '}'], layout);
    let frames = graph.frames.iter().map(|(name, frame)| format!("{}: {}", ron::text(name), frame_text(frame)));
    block(out, 1, "frames", ['{', '}'], frames);
    block(out, 1, "collapsed", ['[', ']'], graph.collapsed.iter().map(|name| ron::text(name)));
    let waypoints = graph.waypoints.iter().map(|((from, to), points)| {
        let points: Vec<String> = points.iter().map(|point| tuple(point)).collect();
        format!("{}: [{}]", ron::text(&format!("{from} -> {to}")), points.join(", "))
    });
    block(out, 1, "waypoints", ['{', '}'], waypoints);
}

fn frame_text(frame: &Frame) -> String {
    let mut fields = vec![format!("at: {}", tuple(&frame.at)), format!("size: {}", tuple(&frame.size))];
    fields.extend(frame.color.map(|color| format!("color: {}", tuple(&color))));
    if !frame.text.is_empty() {
        fields.push(format!("text: {}", ron::text(&frame.text)));
    }
    remark(&mut fields, "", &frame.unknown);
    format!("({})", fields.join(", "))
}

fn tuple(numbers: &[f64]) -> String {
    let numbers: Vec<String> = numbers.iter().map(|x| ron::number(*x)).collect();
    format!("({})", numbers.join(", "))
}
