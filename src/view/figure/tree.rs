//! The cards and wires of a figure: graph by graph, from left to right.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::{Across, Colors, Part, bold, cut, escaped, ink};
use crate::graph::{End, Graph};
use crate::view::placed;

const TITLE: f64 = 24.0;
/// Height of the line below the title, in points.
const KIND: f64 = 18.0;
const ROW: f64 = 15.0;
/// Narrowest and widest that a card is, in points.
const WIDTHS: (f64, f64) = (104.0, 220.0);
/// Most values that a card shows.
const VALUES: usize = 5;
/// Space around the cards of a graph that is framed, in points.
const FRAME: f64 = 16.0;
/// Height of the name of a frame, in points.
const NAME: f64 = 24.0;
/// Space between frames, in points.
const APART: f64 = 64.0;
/// Height of the way of a wire between graphs, in points.
const LANE: f64 = 18.0;
/// Room for the line that is drawn around what lies outermost, in points.
const EDGE: f64 = 2.0;

/// Room that a text needs, in points, with a margin for fonts that are wider than the first one.
fn room(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * size * 0.56
}

/// What of a text fits.
fn fitted(text: &str, size: f64, width: f64) -> String {
    cut(text, ((width / (size * 0.56)) as usize).max(3))
}

/// A card before it has a place.
struct Card {
    kind: String,
    outputs: Vec<String>,
    inputs: Vec<String>,
    /// Names and values that the graph gives.
    values: Vec<(String, String)>,
    size: [f64; 2],
}

impl Card {
    fn new(part: &Part, node: &str) -> Self {
        // The ports that links name: those alone are worth ink.
        let named = |leaves: bool| {
            let ends = part.graph.links.iter().map(|l| if leaves { &l.from } else { &l.to }).filter(|e| e.node == node);
            let mut names: Vec<String> = ends.filter_map(|e| e.port.clone()).collect();
            names.sort_unstable();
            names.dedup();
            names
        };
        let kind = part.cards.get(node).map_or_else(String::new, |v| v.title.clone());
        let params = part.graph.nodes.get(node).map(|n| &n.params);
        let mut values: Vec<(String, String)> =
            params.into_iter().flatten().map(|(name, value)| (name.replace('_', " "), value.to_string())).collect();
        if values.len() > VALUES {
            values.truncate(VALUES - 1);
            values.push(("…".to_owned(), String::new()));
        }
        let (outputs, inputs) = (named(true), named(false));
        let widest = [room(node, 13.0), room(&kind, 10.5)].into_iter();
        let widest = widest.chain(outputs.iter().chain(&inputs).map(|p| room(p, 11.0)));
        let widest = widest.chain(values.iter().map(|(n, v)| room(n, 10.5) + room(v, 10.5) + 10.0)).fold(0.0, f64::max);
        let rows = (outputs.len() + inputs.len() + values.len()) as f64;
        let height = TITLE + KIND + rows * ROW + if rows > 0.0 { 5.0 } else { 1.0 };
        Self { kind, outputs, inputs, values, size: [(widest + 20.0).clamp(WIDTHS.0, WIDTHS.1).ceil(), height] }
    }

    /// Where a wire begins or ends, from the top left.
    fn anchor(&self, port: Option<&str>, leaves: bool) -> [f64; 2] {
        let row = port.and_then(|port| match leaves {
            true => self.outputs.iter().position(|p| p == port),
            false => self.inputs.iter().position(|p| p == port).map(|i| i + self.outputs.len()),
        });
        let y = row.map_or(TITLE / 2.0, |row| TITLE + KIND + (row as f64 + 0.5) * ROW);
        [if leaves { self.size[0] } else { 0.0 }, y]
    }
}

/// All graphs with their nodes in place.
pub(super) struct Tree<'a> {
    parts: &'a [Part],
    across: &'a [Across],
    cards: Vec<BTreeMap<String, Card>>,
    places: Vec<BTreeMap<String, [f64; 2]>>,
    /// Left, top, width and height of each graph, where there are several.
    frames: Vec<[f64; 4]>,
    /// Of all, in points, as it is.
    pub(super) size: [f64; 2],
}

impl<'a> Tree<'a> {
    pub(super) fn new(parts: &'a [Part], across: &'a [Across]) -> Self {
        let mut tree =
            Self { parts, across, cards: Vec::new(), places: Vec::new(), frames: Vec::new(), size: [0.0; 2] };
        let mut sizes = Vec::new();
        let framed = parts.len() > 1;
        for part in parts {
            let cards: BTreeMap<String, Card> =
                part.graph.nodes.keys().map(|n| (n.clone(), Card::new(part, n))).collect();
            let size = |name: &str| cards.get(name).map_or([0.0; 2], |c| c.size);
            // Cards here are smaller than on a canvas, so that places made for that would leave holes.
            let loose = Graph { layout: BTreeMap::new(), frames: BTreeMap::new(), ..part.graph.clone() };
            let mut places = placed(&loose, &size);
            let low = |axis: usize| places.values().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
            let low = [low(0), low(1)];
            let mut far = [0.0_f64; 2];
            for (name, place) in &mut places {
                for axis in 0..2 {
                    place[axis] -= low[axis];
                    far[axis] = far[axis].max(place[axis] + size(name)[axis]);
                }
            }
            if framed {
                let name = room(&part.title, 13.0).min(400.0);
                far = [far[0].max(name) + 2.0 * FRAME, far[1] + FRAME + NAME];
            }
            sizes.push(far);
            tree.cards.push(cards);
            tree.places.push(places);
        }
        tree.place_frames(&sizes);
        if !framed {
            tree.frames.clear();
        }
        tree
    }

    /// Puts each graph right of those that feed it.
    fn place_frames(&mut self, sizes: &[[f64; 2]]) {
        let mut columns = vec![0_usize; sizes.len()];
        for _ in 0..sizes.len() {
            for wire in self.across {
                // A circle of graphs would go on for ever.
                columns[wire.to.0] = columns[wire.to.0].max((columns[wire.from.0] + 1).min(sizes.len() - 1));
            }
        }
        let heights: BTreeMap<usize, f64> = columns
            .iter()
            .map(|c| {
                let own = || sizes.iter().zip(&columns).filter(|(_, column)| *column == c).map(|(s, _)| s[1]);
                (*c, own().sum::<f64>() + own().skip(1).map(|_| FRAME).sum::<f64>())
            })
            .collect();
        let tallest = heights.values().copied().fold(0.0, f64::max);
        let mut x = EDGE;
        self.frames = vec![[0.0; 4]; sizes.len()];
        let mut far = 0.0_f64;
        for (column, height) in &heights {
            let mut y = EDGE + (tallest - height) / 2.0;
            let mut widest = 0.0_f64;
            let inset = if sizes.len() > 1 { [FRAME, NAME] } else { [0.0; 2] };
            for index in (0..sizes.len()).filter(|i| columns[*i] == *column) {
                let [width, height] = sizes[index];
                self.frames[index] = [x, y, width, height];
                for place in self.places[index].values_mut() {
                    *place = [place[0] + x + inset[0], place[1] + y + inset[1]];
                }
                y += height + FRAME;
                widest = widest.max(width);
            }
            far = x + widest;
            x = far + APART;
        }
        let lanes = if self.across.is_empty() { 0.0 } else { (self.across.len() as f64 + 0.5) * LANE };
        self.size = if self.places.iter().all(BTreeMap::is_empty) {
            [0.0; 2]
        } else {
            [far + EDGE, tallest + lanes + 2.0 * EDGE]
        };
    }

    /// Draws the tree no wider than `most`. Answers its text and its size.
    pub(super) fn draw(&self, colors: &Colors, most: f64) -> (String, [f64; 2]) {
        let scale = (most / self.size[0].max(1.0)).min(1.0);
        let mut out = String::new();
        let _ = writeln!(out, r#"<g transform="scale({scale:.4})">"#);
        for (part, [x, y, width, height]) in self.parts.iter().zip(&self.frames) {
            let _ = writeln!(
                out,
                r##"<rect x="{x:.1}" y="{y:.1}" width="{width:.1}" height="{height:.1}" rx="7" fill="#f1f3f6" stroke="#cdd2da" stroke-dasharray="5 3"/>"##
            );
            let name = escaped(&fitted(&part.title, 13.0, width - 2.0 * FRAME));
            let _ = writeln!(
                out,
                r##"<text x="{:.1}" y="{:.1}" font-size="13" fill="#454c57">{name}</text>"##,
                x + FRAME,
                y + 17.0
            );
        }
        for (index, part) in self.parts.iter().enumerate() {
            for link in &part.graph.links {
                let thick = if link.from.port.is_none() && link.to.port.is_none() { 3.0 } else { 1.8 };
                self.wire(
                    &mut out,
                    colors,
                    (index, &link.from),
                    (index, &link.to),
                    &format!(r#"stroke-width="{thick}""#),
                );
            }
        }
        for (index, wire) in self.across.iter().enumerate() {
            self.lane(&mut out, colors, wire, index);
        }
        for (index, part) in self.parts.iter().enumerate() {
            for (name, card) in &self.cards[index] {
                if let Some(at) = self.places[index].get(name) {
                    card.draw(&mut out, name, *at, &colors.of_node(&part.name, name));
                }
            }
        }
        out.push_str("</g>\n");
        (out, self.size.map(|x| x * scale))
    }

    /// Draws a wire between graphs: below all of them, so that it hides behind no card.
    fn lane(&self, out: &mut String, colors: &Colors, wire: &Across, index: usize) {
        let bottom = |(part, node): &(usize, String), leaves: bool| -> Option<[f64; 2]> {
            let (place, card) = (self.places.get(*part)?.get(node)?, self.cards[*part].get(node)?);
            // Several wires of a card lie side by side.
            let same = |w: &&Across| if leaves { w.from == wire.from } else { w.to == wire.to };
            let (all, own) =
                (self.across.iter().filter(same).count(), self.across[..index].iter().filter(same).count());
            let share = (own + 1) as f64 / (all + 1) as f64;
            Some([place[0] + card.size[0] * share, place[1] + card.size[1]])
        };
        let (Some(a), Some(b)) = (bottom(&wire.from, true), bottom(&wire.to, false)) else { return };
        let lane = self.size[1] - EDGE - (index as f64 + 0.5) * LANE;
        let color = colors.of_node(&self.parts[wire.from.0].name, &wire.from.1);
        let turn = if a[0] < b[0] { 8.0 } else { -8.0 };
        let _ = writeln!(
            out,
            r#"<path d="M{:.1} {:.1} V{:.1} q0 8 {turn} 8 H{:.1} q{turn} 0 {turn} -8 V{:.1}" fill="none" stroke="{color}" stroke-width="2.2" stroke-dasharray="7 4"/>"#,
            a[0],
            a[1],
            lane - 8.0,
            b[0] - turn,
            b[1]
        );
        let words = wire.ports.iter().map(|p| p.replace('_', " ")).collect::<Vec<_>>().join(", ");
        let (x, y) = (a[0].min(b[0]) + 16.0, lane + 3.5);
        label(out, [x, y], &fitted(&words, 10.5, ((a[0] - b[0]).abs() - 40.0).max(30.0)));
    }

    fn wire(&self, out: &mut String, colors: &Colors, from: (usize, &End), to: (usize, &End), style: &str) {
        let at = |(part, end): (usize, &End), leaves: bool| -> Option<[f64; 2]> {
            let place = self.places.get(part)?.get(&end.node)?;
            let anchor = self.cards[part].get(&end.node)?.anchor(end.port.as_deref(), leaves);
            Some([place[0] + anchor[0], place[1] + anchor[1]])
        };
        let (Some(a), Some(b)) = (at(from, true), at(to, false)) else { return };
        let reach = ((b[0] - a[0]).abs() / 2.0).max(20.0);
        let color = colors.of_node(&self.parts[from.0].name, &from.1.node);
        let (left, right) = (a[0] + reach, b[0] - reach);
        let _ = writeln!(
            out,
            r#"<path d="M{:.1} {:.1} C{left:.1} {:.1} {right:.1} {:.1} {:.1} {:.1}" fill="none" stroke="{color}" {style}/>"#,
            a[0], a[1], a[1], b[1], b[0], b[1]
        );
    }
}

/// A text on a white ground.
fn label(out: &mut String, [x, y]: [f64; 2], text: &str) {
    let attributes = r#"font-size="10.5""#;
    let text = escaped(text);
    let _ = writeln!(
        out,
        r##"<text x="{x:.1}" y="{y:.1}" {attributes} stroke="#ffffff" stroke-width="4" stroke-linejoin="round">{text}</text>"##
    );
    let _ = writeln!(out, r##"<text x="{x:.1}" y="{y:.1}" {attributes} fill="#454c57">{text}</text>"##);
}

impl Card {
    fn draw(&self, out: &mut String, name: &str, [x, y]: [f64; 2], color: &str) {
        let [width, height] = self.size;
        let _ = writeln!(
            out,
            r##"<rect x="{x:.1}" y="{y:.1}" width="{width}" height="{height:.1}" rx="5" fill="#ffffff" stroke="{color}" stroke-width="1.5"/>"##
        );
        let (side, across) = (TITLE - 5.0, width - 10.0);
        let _ = writeln!(
            out,
            r#"<path d="M{x:.1} {:.1} v-{side:.1} q0 -5 5 -5 h{across:.1} q5 0 5 5 v{side:.1} z" fill="{color}" stroke="{color}" stroke-width="1.5"/>"#,
            y + TITLE
        );
        let inner = width - 16.0;
        let ink = ink(color);
        let _ = writeln!(
            out,
            r#"<text x="{:.1}" y="{:.1}" font-size="13" fill="{ink}" {}>{}</text>"#,
            x + 9.0,
            y + 16.5,
            bold(ink),
            escaped(&fitted(name, 13.0, inner))
        );
        let _ = writeln!(
            out,
            r##"<text x="{:.1}" y="{:.1}" font-size="10.5" fill="#5e6672">{}</text>"##,
            x + 9.0,
            y + TITLE + 13.0,
            escaped(&fitted(&self.kind, 10.5, inner))
        );
        let mut row = y + TITLE + KIND + ROW * 0.5;
        let ports = self.outputs.iter().map(|p| (true, p)).chain(self.inputs.iter().map(|p| (false, p)));
        for (leaves, port) in ports {
            let (edge, anchor, inset) = if leaves { (x + width, "end", -9.0) } else { (x, "start", 9.0) };
            let _ = writeln!(
                out,
                r##"<circle cx="{edge:.1}" cy="{row:.1}" r="3.4" fill="{color}" stroke="#ffffff" stroke-width="0.8"/>"##
            );
            let _ = writeln!(
                out,
                r##"<text x="{:.1}" y="{:.1}" font-size="11" fill="#22262e" text-anchor="{anchor}">{}</text>"##,
                edge + inset,
                row + 4.0,
                escaped(&fitted(&port.replace('_', " "), 11.0, inner))
            );
            row += ROW;
        }
        for (name, value) in &self.values {
            let value = fitted(value, 10.5, (inner - room(name, 10.5) - 6.0).max(inner * 0.5));
            let name = fitted(name, 10.5, inner - room(&value, 10.5) - 6.0);
            let (left, right, base) = (x + 9.0, x + width - 9.0, row + 4.0);
            let _ = writeln!(
                out,
                r##"<text x="{left:.1}" y="{base:.1}" font-size="10.5" fill="#5e6672">{}</text>"##,
                escaped(&name)
            );
            let _ = writeln!(
                out,
                r##"<text x="{right:.1}" y="{base:.1}" font-size="10.5" fill="#22262e" text-anchor="end">{}</text>"##,
                escaped(&value)
            );
            row += ROW;
        }
    }
}
