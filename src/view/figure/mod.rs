//! A graph, its text and its picture in one drawing, matched by colour: for papers and documentation.
//!
//! The drawing is SVG. Every node has a colour that its card, its wires and its lines of text share.

mod code;
mod tree;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use base64::Engine as _;

use super::NodeView;
use crate::compile::Compiled;
use crate::graph::Graph;

/// What is drawn.
pub struct Figure<'a> {
    /// Above it all.
    pub title: &'a str,
    /// The tree.
    pub graph: &'a Graph,
    /// What its cards show, by node.
    pub cards: &'a BTreeMap<String, NodeView>,
    /// The text, with where it comes from.
    pub compiled: &'a Compiled,
    /// The picture as a PNG file, with its columns and rows.
    pub picture: Option<(&'a [u8], (u32, u32))>,
    /// Below the picture.
    pub caption: &'a str,
}

/// Width of the column of text, in points.
const CODE: f64 = 600.0;
/// Width of the picture, in points.
const PICTURE: f64 = 460.0;
/// Widest that a tree is drawn, in points.
const TREE: f64 = 640.0;
const MARGIN: f64 = 24.0;
/// Height of the title, in points.
const HEAD: f64 = 56.0;

impl Figure<'_> {
    /// The drawing, as the text of an SVG file. The same figure gives the same bytes.
    pub fn svg(&self) -> String {
        let colors = colors(self.graph.nodes.keys());
        let (tree, tree_size) = tree::draw(self.graph, self.cards, &colors, TREE);
        let (code, code_height) = code::draw(self.compiled, &colors, CODE);
        let picture = self.picture.filter(|(_, (w, h))| *w > 0 && *h > 0);
        let picture_height = picture.map_or(0.0, |(_, (w, h))| PICTURE * f64::from(h) / f64::from(w));
        // A broad tree lies over the text and the picture, a tall one beside them.
        let broad = tree_size[0] > 1.6 * tree_size[1];
        let right = if picture.is_some() { CODE + MARGIN + PICTURE } else { CODE };
        let below = code_height.max(picture_height + 30.0);
        let (tree_at, code_at, width, height) = if broad {
            let width = 2.0 * MARGIN + right.max(tree_size[0]);
            let tree_at = [(width - tree_size[0]) / 2.0, HEAD];
            (tree_at, [MARGIN, HEAD + tree_size[1] + MARGIN], width, HEAD + tree_size[1] + below + 2.0 * MARGIN)
        } else {
            let width = 3.0 * MARGIN + tree_size[0] + right;
            ([MARGIN, HEAD], [2.0 * MARGIN + tree_size[0], HEAD], width, HEAD + tree_size[1].max(below) + MARGIN)
        };
        let mut out = String::new();
        let _ = writeln!(
            out,
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0}" height="{height:.0}" viewBox="0 0 {width:.0} {height:.0}" font-family="Ubuntu, Helvetica, Arial, sans-serif">"#
        );
        let _ = writeln!(out, r##"<rect width="100%" height="100%" fill="#ffffff"/>"##);
        let _ = writeln!(
            out,
            r##"<text x="{MARGIN}" y="36" font-size="22" fill="#1d2026">{}</text>"##,
            escaped(self.title)
        );
        let _ = writeln!(out, r#"<g transform="translate({:.1} {:.1})">"#, tree_at[0], tree_at[1]);
        out.push_str(&tree);
        let _ = writeln!(out, "</g>\n<g transform=\"translate({:.1} {:.1})\">", code_at[0], code_at[1]);
        out.push_str(&code);
        out.push_str("</g>\n");
        if let Some((png, _)) = picture {
            let x = code_at[0] + CODE + MARGIN;
            let data = base64::engine::general_purpose::STANDARD.encode(png);
            let _ = writeln!(
                out,
                r#"<image x="{x:.1}" y="{:.1}" width="{PICTURE}" height="{picture_height:.1}" href="data:image/png;base64,{data}"/>"#,
                code_at[1]
            );
            let y = code_at[1] + picture_height + 18.0;
            let _ = writeln!(
                out,
                r##"<text x="{x:.1}" y="{y:.1}" font-size="12" fill="#5e6672">{}</text>"##,
                escaped(self.caption)
            );
        }
        out.push_str("</svg>\n");
        out
    }
}

/// A colour for each node, told apart as well by those who see no red or no green (after Okabe and Ito 2008); more nodes
/// take them again, paler.
fn colors<'a>(names: impl Iterator<Item = &'a String>) -> BTreeMap<&'a str, String> {
    const BASE: [(u8, u8, u8); 7] =
        [(230, 159, 0), (86, 180, 233), (0, 158, 115), (204, 121, 167), (0, 114, 178), (213, 94, 0), (190, 170, 20)];
    let shade = |i: usize| {
        let (r, g, b) = BASE[i % BASE.len()];
        let pale = u16::try_from((i / BASE.len()).min(3)).unwrap_or(0) * 18;
        let mix = |c: u8| (u16::from(c) * (100 - pale) + 255 * pale) / 100;
        format!("#{:02x}{:02x}{:02x}", mix(r), mix(g), mix(b))
    };
    names.enumerate().map(|(i, name)| (name.as_str(), shade(i))).collect()
}

/// A text as XML holds it; what XML cannot hold is left out.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\t' => out.push(' '),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => {}
            c => out.push(c),
        }
    }
    out
}

/// A text of at most so many letters.
fn cut(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        text.to_owned()
    } else {
        text.chars().take(most.saturating_sub(1)).chain(['…']).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_breaks_out_of_the_xml() {
        assert_eq!(escaped("a<b & \"c\"\u{7}\t>"), "a&lt;b &amp; &quot;c&quot; &gt;");
        assert_eq!((cut("abcdef", 4), cut("abc", 4)), ("abc…".to_owned(), "abc".to_owned()));
    }

    #[test]
    fn every_node_has_a_colour() {
        let names: Vec<String> = (0..60).map(|i| format!("n{i:02}")).collect();
        let colors = colors(names.iter());
        assert_eq!(colors.len(), 60);
        assert!(colors.values().all(|c| c.len() == 7 && c.starts_with('#')));
        assert_ne!(colors["n00"], colors["n07"]);
    }
}
