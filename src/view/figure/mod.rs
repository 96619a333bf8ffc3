//! Graphs, their text and their picture in one drawing, matched by colour: for papers and documentation.
//!
//! The drawing is SVG. Every node has a colour that its card, its wires and its lines of text share. The tree lies top left, or
//! across where it is broad; the picture lies right; the text fills two columns below both.

mod code;
mod tree;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use base64::Engine as _;

use super::NodeView;
use crate::compile::Compiled;
use crate::graph::Graph;
use crate::markup::{cut, escaped};

/// Fonts of words; the first are what a picture of the drawing is made with.
const SANS: &str = "Ubuntu, 'Ubuntu Light', Helvetica, Arial, sans-serif";
/// Fonts of text.
const MONO: &str = "Hack, 'DejaVu Sans Mono', Menlo, Consolas, monospace";

/// A graph of the drawing.
#[derive(Clone, Debug)]
pub struct Part {
    /// What its nodes go by in the text, before a slash, where several graphs are woven.
    pub name: String,
    /// What people call it.
    pub title: String,
    /// Its nodes and links.
    pub graph: Graph,
    /// What its cards show, by node.
    pub cards: BTreeMap<String, NodeView>,
}

/// A wire between two graphs that nobody drew: it was found by what ports mean.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Across {
    /// Place of the graph among the parts, and node.
    pub from: (usize, String),
    /// Place of the graph among the parts, and node.
    pub to: (usize, String),
    /// The inputs that it feeds.
    pub ports: Vec<String>,
}

/// What is drawn.
pub struct Figure<'a> {
    /// Above it all.
    pub title: &'a str,
    /// The tree, graph by graph.
    pub parts: &'a [Part],
    /// Wires between graphs.
    pub across: &'a [Across],
    /// The text, with where it comes from.
    pub compiled: &'a Compiled,
    /// The picture as a PNG file, with its columns and rows.
    pub picture: Option<(&'a [u8], (u32, u32))>,
    /// Below the picture.
    pub caption: &'a str,
}

/// Width of a column, in points.
const COLUMN: f64 = 540.0;
const MARGIN: f64 = 24.0;
/// Height of the title, in points.
const HEAD: f64 = 58.0;
/// Smallest that a tree is drawn in one column; a larger one lies across both.
const SMALLEST: f64 = 0.72;

impl Figure<'_> {
    /// The drawing, as the text of an SVG file. The same figure gives the same bytes.
    pub fn svg(&self) -> String {
        let colors = Colors::new(self.parts);
        let tree = tree::Tree::new(self.parts, self.across);
        let across = tree.size[0] * SMALLEST > COLUMN;
        let (tree_text, tree_size) = tree.draw(&colors, if across { 2.0 * COLUMN + MARGIN } else { COLUMN });
        let picture = self.picture.filter(|(_, (w, h))| *w > 0 && *h > 0);
        let picture_height = picture.map_or(0.0, |(_, (w, h))| COLUMN * f64::from(h) / f64::from(w));
        let below_tree = if tree_size[1] > 0.0 { HEAD + tree_size[1] + MARGIN } else { HEAD };
        let picture_at = if across { below_tree } else { HEAD };
        let caption_height = if self.caption.is_empty() { 0.0 } else { 22.0 };
        let below_picture =
            if picture.is_some() { picture_at + picture_height + caption_height + MARGIN } else { picture_at };
        let left = MARGIN;
        let right = 2.0 * MARGIN + COLUMN;
        let rows = code::rows(self.compiled, &colors);
        let split = code::split(&rows, below_tree, below_picture);
        let mut columns = String::new();
        let mut bottom = (below_tree - MARGIN).max(below_picture - MARGIN);
        for (mut rows, x, y) in [(&rows[..split], left, below_tree), (&rows[split..], right, below_picture)] {
            while let [code::Row::Space, rest @ ..] | [rest @ .., code::Row::Space] = rows {
                rows = rest;
            }
            if rows.is_empty() {
                continue;
            }
            let (text, height) = code::draw(rows, COLUMN);
            let _ = writeln!(columns, "<g transform=\"translate({x:.1} {y:.1})\">\n{text}</g>");
            bottom = bottom.max(y + height);
        }
        let (width, height) = (3.0 * MARGIN + 2.0 * COLUMN, bottom + MARGIN);
        let mut out = String::new();
        let _ = writeln!(
            out,
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0}" height="{height:.0}" viewBox="0 0 {width:.0} {height:.0}" font-family="{SANS}">"#
        );
        let _ = writeln!(out, r##"<rect width="100%" height="100%" fill="#ffffff"/>"##);
        let title = escaped(&cut(self.title, 80));
        let _ = writeln!(
            out,
            r##"<text x="{MARGIN}" y="37" font-size="23" fill="#1d2026" {}>{title}</text>"##,
            bold("#1d2026")
        );
        let tree_at = if across { (width - tree_size[0]) / 2.0 } else { left + (COLUMN - tree_size[0]) / 2.0 };
        let _ = writeln!(out, "<g transform=\"translate({tree_at:.1} {HEAD:.1})\">\n{tree_text}</g>");
        if let Some((png, _)) = picture {
            let data = base64::engine::general_purpose::STANDARD.encode(png);
            let _ = writeln!(
                out,
                r#"<image x="{right:.1}" y="{picture_at:.1}" width="{COLUMN}" height="{picture_height:.1}" href="data:image/png;base64,{data}"/>"#,
            );
            let y = picture_at + picture_height + 17.0;
            let caption = escaped(&cut(self.caption, 92));
            let _ =
                writeln!(out, r##"<text x="{right:.1}" y="{y:.1}" font-size="12" fill="#454c57">{caption}</text>"##);
        }
        out.push_str(&columns);
        out.push_str("</svg>\n");
        out
    }
}

/// The colour of each node of each part.
struct Colors {
    /// Colours and names by what a node is called in the text.
    by_id: BTreeMap<String, (usize, String)>,
}

impl Colors {
    fn new(parts: &[Part]) -> Self {
        let mut by_id = BTreeMap::new();
        let mut count = 0;
        for part in parts {
            for node in part.graph.nodes.keys() {
                by_id.insert(format!("{}/{node}", part.name), (count, node.clone()));
                // A graph that is woven alone has no name in the text.
                if parts.len() == 1 {
                    by_id.insert(node.clone(), (count, node.clone()));
                }
                count += 1;
            }
        }
        Self { by_id }
    }

    fn of_node(&self, part: &str, node: &str) -> String {
        self.by_id.get(&format!("{part}/{node}")).map_or_else(|| "#888888".to_owned(), |(i, _)| shade(*i))
    }

    /// Number and name of the node that a name of the text stands for: itself, or the subgraph that it is in.
    fn of_text(&self, id: &str) -> Option<(usize, &str)> {
        let ends = id.match_indices('/').map(|(at, _)| at).chain([id.len()]);
        let found = ends.rev().find_map(|end| self.by_id.get(&id[..end]));
        found.map(|(i, name)| (*i, name.as_str()))
    }
}

/// A colour, told apart as well by those who see no red or no green (after Okabe and Ito 2008); more nodes take them again,
/// paler.
fn shade(index: usize) -> String {
    const BASE: [(u8, u8, u8); 7] =
        [(230, 159, 0), (86, 180, 233), (0, 158, 115), (204, 121, 167), (0, 114, 178), (213, 94, 0), (190, 170, 20)];
    let (r, g, b) = BASE[index % BASE.len()];
    let pale = u16::try_from((index / BASE.len()).min(3)).unwrap_or(0) * 20;
    let mix = |c: u8| (u16::from(c) * (100 - pale) + 255 * pale) / 100;
    format!("#{:02x}{:02x}{:02x}", mix(r), mix(g), mix(b))
}

/// Black or white, whichever is read more easily on a colour.
fn ink(color: &str) -> &'static str {
    let channel = |at: usize| color.get(at..at + 2).and_then(|t| u32::from_str_radix(t, 16).ok()).unwrap_or(128);
    let light = 299 * channel(1) + 587 * channel(3) + 114 * channel(5);
    if light > 120_000 { "#14161a" } else { "#ffffff" }
}

/// Attributes that make letters bold also where there is no bold font.
fn bold(color: &str) -> String {
    format!(r#"stroke="{color}" stroke-width="0.4""#)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_node_has_a_colour_and_dark_ones_white_letters() {
        let colors: std::collections::BTreeSet<String> = (0..28).map(shade).collect();
        assert_eq!(colors.len(), 28);
        assert!((0..90).map(shade).all(|c| c.len() == 7 && c.starts_with('#')));
        assert_eq!((ink("#0072b2"), ink("#e69f00"), ink("")), ("#ffffff", "#14161a", "#14161a"));
    }

    #[test]
    fn lines_of_a_subgraph_are_those_of_its_node() {
        let mut graph = Graph::default();
        graph.nodes.insert("mask".into(), Default::default());
        let part =
            |name: &str| Part { name: name.into(), title: String::new(), graph: graph.clone(), cards: BTreeMap::new() };
        let one = Colors::new(&[part("rust")]);
        for id in ["mask", "mask/noise", "rust/mask", "rust/mask/a/b"] {
            assert_eq!(one.of_text(id), Some((0, "mask")), "{id}");
        }
        assert_eq!((one.of_text("key/spot"), one.of_text("masks"), one.of_text("rust")), (None, None, None));
        let two = Colors::new(&[part("a"), part("b")]);
        assert_eq!((two.of_text("b/mask/x"), two.of_text("mask")), (Some((1, "mask")), None));
    }
}
