//! The cards and wires of a figure.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::{cut, escaped};
use crate::graph::{End, Graph};
use crate::view::{NodeView, placed};

const WIDTH: f64 = 150.0;
const TITLE: f64 = 24.0;
const ROW: f64 = 16.0;

/// The ports of a card that links name: those alone are worth ink.
fn ports<'a>(graph: &'a Graph, node: &str, leaves: bool) -> Vec<&'a str> {
    let ends = graph.links.iter().map(|l| if leaves { &l.from } else { &l.to }).filter(|e| e.node == node);
    let mut names: Vec<&str> = ends.filter_map(|e| e.port.as_deref()).collect();
    names.sort_unstable();
    names.dedup();
    names
}

fn size(graph: &Graph, node: &str) -> [f64; 2] {
    #[allow(clippy::cast_precision_loss, reason = "a node has few ports")]
    let rows = (ports(graph, node, true).len() + ports(graph, node, false).len()) as f64;
    [WIDTH, TITLE + 16.0 + rows * ROW]
}

/// Where an end of a link lies on its card.
fn anchor(graph: &Graph, at: [f64; 2], end: &End, leaves: bool) -> [f64; 2] {
    let x = at[0] + if leaves { WIDTH } else { 0.0 };
    let outputs = ports(graph, &end.node, true);
    let row = end.port.as_deref().and_then(|port| match leaves {
        true => outputs.iter().position(|p| *p == port),
        false => ports(graph, &end.node, false).iter().position(|p| *p == port).map(|i| i + outputs.len()),
    });
    #[allow(clippy::cast_precision_loss, reason = "a node has few ports")]
    let y = row.map_or(TITLE / 2.0, |row| TITLE + 16.0 + (row as f64 + 0.5) * ROW - 2.0);
    [x, at[1] + y]
}

/// Draws the tree no wider than `most`. Answers its text and its size.
pub(super) fn draw(
    graph: &Graph,
    cards: &BTreeMap<String, NodeView>,
    colors: &BTreeMap<&str, String>,
    most: f64,
) -> (String, [f64; 2]) {
    // Cards here are smaller than on a canvas, so that places made for that would leave holes.
    let loose = Graph { layout: BTreeMap::new(), ..graph.clone() };
    let places = placed(&loose, &|name| size(graph, name));
    if places.is_empty() {
        return (String::new(), [0.0, 0.0]);
    }
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for (name, at) in &places {
        let size = size(graph, name);
        for axis in 0..2 {
            low[axis] = low[axis].min(at[axis]);
            high[axis] = high[axis].max(at[axis] + size[axis]);
        }
    }
    let (width, height) = (high[0] - low[0] + 12.0, high[1] - low[1] + 12.0);
    let scale = (most / width).min(1.0);
    let mut out = String::new();
    let _ = writeln!(out, r#"<g transform="scale({scale:.3}) translate({:.1} {:.1})">"#, 6.0 - low[0], 6.0 - low[1]);
    for link in &graph.links {
        let (Some(from), Some(to)) = (places.get(&link.from.node), places.get(&link.to.node)) else { continue };
        let (a, b) = (anchor(graph, *from, &link.from, true), anchor(graph, *to, &link.to, false));
        let reach = ((b[0] - a[0]).abs() / 2.0).max(20.0);
        let color = colors.get(link.from.node.as_str()).map_or("#888888", String::as_str);
        let thick = if link.from.port.is_none() && link.to.port.is_none() { 3.0 } else { 1.8 };
        let _ = writeln!(
            out,
            r#"<path d="M{:.1} {:.1} C{:.1} {:.1} {:.1} {:.1} {:.1} {:.1}" fill="none" stroke="{color}" stroke-width="{thick}"/>"#,
            a[0],
            a[1],
            a[0] + reach,
            a[1],
            b[0] - reach,
            b[1],
            b[0],
            b[1]
        );
    }
    for (name, at) in &places {
        card(&mut out, graph, name, cards.get(name), *at, colors.get(name.as_str()).map_or("#888888", String::as_str));
    }
    out.push_str("</g>\n");
    (out, [width * scale, height * scale])
}

fn card(out: &mut String, graph: &Graph, name: &str, view: Option<&NodeView>, [x, y]: [f64; 2], color: &str) {
    let [width, height] = size(graph, name);
    let _ = writeln!(
        out,
        r##"<rect x="{x:.1}" y="{y:.1}" width="{width}" height="{height:.1}" rx="5" fill="#f6f7f9" stroke="{color}" stroke-width="1.5"/>"##
    );
    let _ = writeln!(
        out,
        r#"<path d="M{x:.1} {:.1} v{:.1} q0 -5 5 -5 h{:.1} q5 0 5 5 v{:.1} z" fill="{color}"/>"#,
        y + TITLE,
        5.0 - TITLE,
        width - 10.0,
        TITLE - 5.0
    );
    let _ = writeln!(
        out,
        r##"<text x="{:.1}" y="{:.1}" font-size="13" font-weight="bold" fill="#14161a">{}</text>"##,
        x + 8.0,
        y + 17.0,
        escaped(&cut(name, 19))
    );
    let kind = view.map_or_else(String::new, |v| v.title.clone());
    let _ = writeln!(
        out,
        r##"<text x="{:.1}" y="{:.1}" font-size="10.5" fill="#5e6672">{}</text>"##,
        x + 8.0,
        y + TITLE + 12.0,
        escaped(&cut(&kind, 26))
    );
    let mut row = y + TITLE + 16.0 + ROW * 0.5 - 2.0;
    for (leaves, port) in ports(graph, name, true)
        .into_iter()
        .map(|p| (true, p))
        .chain(ports(graph, name, false).into_iter().map(|p| (false, p)))
    {
        let (edge, anchor, inset) = if leaves { (x + width, "end", -9.0) } else { (x, "start", 9.0) };
        let _ = writeln!(out, r#"<circle cx="{edge:.1}" cy="{row:.1}" r="3.2" fill="{color}"/>"#);
        let _ = writeln!(
            out,
            r##"<text x="{:.1}" y="{:.1}" font-size="11" fill="#2a2e36" text-anchor="{anchor}">{}</text>"##,
            edge + inset,
            row + 4.0,
            escaped(&cut(port, 20))
        );
        row += ROW;
    }
}
