//! What is seen, and what lies under the pointer.

use std::sync::Arc;

use eframe::egui::{Pos2, Rect, vec2};

use super::Surroundings;
use super::camera::{Detail, View, at};
use super::card::{ROW, TITLE, anchor, inputs, outputs};
use super::far;
use super::wires::{self, Curve};
use crate::graph::End;
use crate::gui::tab::Tab;
use crate::view::NodeView;

/// How near a pointer is to a link that it means, in points of the screen.
const NEAR: f32 = 7.0;

/// A card that is seen, in points of the plane.
pub(super) struct Card {
    pub(super) name: String,
    pub(super) rect: Rect,
    pub(super) selected: bool,
    pub(super) muted: bool,
    /// Family of the node; empty if it is not known.
    pub(super) category: Arc<str>,
    /// Only where ports are drawn.
    pub(super) view: Option<Arc<NodeView>>,
}

/// A link of which something may be seen.
pub(super) struct Wire {
    pub(super) from: End,
    pub(super) to: End,
    /// In points of the screen.
    pub(super) curve: Curve,
}

/// What is seen of a document.
pub(super) struct Seen {
    /// Those drawn last come last.
    pub(super) cards: Vec<Card>,
    /// None from afar.
    pub(super) wires: Vec<Wire>,
}

impl Seen {
    pub(super) fn card(&self, name: &str) -> Option<&Card> {
        self.cards.iter().find(|c| c.name == name)
    }
}

/// What lies under a point.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Under {
    /// A port, or the whole node where none is named, on the side where it gives (`output`) or takes.
    Pin {
        end: End,
        output: bool,
    },
    Node(String),
    /// The corner that changes a frame's size.
    Corner(String),
    Frame(String),
    /// A bend of a link.
    Bend {
        from: End,
        to: End,
        index: usize,
    },
    Wire {
        from: End,
        to: End,
    },
    Nothing,
}

/// Finds what is seen.
pub(super) fn seen(tab: &mut Tab, around: &Surroundings<'_>, view: &View) -> Seen {
    let seen = view.seen().expand(8.0);
    let detail = view.detail();
    let graph = tab.document.graph();
    let (mut cards, mut above) = (Vec::new(), Vec::new());
    for card in tab.cards.lying(&tab.selection).filter(|c| c.rect.intersects(seen)) {
        // Selected cards lie above the others.
        let list = if card.selected { &mut above } else { &mut cards };
        list.push(Card {
            name: card.name.to_owned(),
            rect: card.rect,
            selected: card.selected,
            muted: card.muted,
            category: card.category.clone(),
            view: None,
        });
    }
    cards.append(&mut above);
    if detail == Detail::Full {
        for card in &mut cards {
            card.view = Some(tab.cards.view(graph, around.catalog, around.subgraphs, &card.name));
        }
    }
    let wires = if detail == Detail::Box { Vec::new() } else { wires_seen(tab, around, view, seen) };
    Seen { cards, wires }
}

/// The links of which something may be seen.
fn wires_seen(tab: &mut Tab, around: &Surroundings<'_>, view: &View, seen: Rect) -> Vec<Wire> {
    let full = view.detail() == Detail::Full;
    let graph = tab.document.graph();
    let near: Vec<_> = std::iter::zip(&graph.links, tab.cards.ends())
        .filter_map(|(link, ends)| ends.map(|(from, to)| (link, from, to)))
        .filter(|(_, from, to)| from.union(*to).expand(80.0).intersects(seen))
        .collect();
    let mut wires = Vec::new();
    for (link, from, to) in near {
        let ports = |end: &End, cards: &mut super::Cards| {
            (full && end.port.is_some()).then(|| cards.view(graph, around.catalog, around.subgraphs, &end.node))
        };
        let (from_view, to_view) = (ports(&link.from, &mut tab.cards), ports(&link.to, &mut tab.cards));
        let begin = view.to_screen(anchor(from, from_view.as_deref(), &link.from, true));
        let end = view.to_screen(anchor(to, to_view.as_deref(), &link.to, false));
        let bends = graph.waypoints.get(&(link.from.clone(), link.to.clone()));
        let curve = wires::curve(begin, end, bends.into_iter().flatten().map(|p| view.to_screen(at(*p))), false);
        if !full || curve.bounds().expand(4.0).intersects(view.screen) {
            wires.push(Wire { from: link.from.clone(), to: link.to.clone(), curve });
        }
    }
    wires
}

/// Finds what lies under a point of the screen.
pub(super) fn under(tab: &Tab, seen: &Seen, view: &View, p: Pos2) -> Under {
    let plane = view.to_plane(p);
    let graph = tab.document.graph();
    // Pins reach a little beyond their cards.
    for card in seen.cards.iter().rev() {
        if let Some(ports) = &card.view
            && let Some((end, output)) = pin(card, ports, plane)
        {
            return Under::Pin { end, output };
        }
        if card.rect.contains(plane) {
            return Under::Node(card.name.clone());
        }
    }
    for ((from, to), bends) in &graph.waypoints {
        if let Some(index) = bends.iter().position(|b| (view.to_screen(at(*b)) - p).length() < 8.0) {
            return Under::Bend { from: from.clone(), to: to.clone(), index };
        }
    }
    if view.detail() == Detail::Box
        && let Some(link) = far::link_at(tab, view, p, NEAR)
    {
        return Under::Wire { from: link.from.clone(), to: link.to.clone() };
    }
    let near = seen.wires.iter().map(|w| (w.curve.distance(p), w)).min_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((_, wire)) = near.filter(|(d, _)| *d < NEAR) {
        return Under::Wire { from: wire.from.clone(), to: wire.to.clone() };
    }
    for (name, frame) in graph.frames.iter().rev() {
        let rect = Rect::from_min_size(at(frame.at), at(frame.size).to_vec2());
        let corner = Rect::from_min_max(rect.max - vec2(16.0, 16.0), rect.max);
        if corner.contains(plane) {
            return Under::Corner(name.clone());
        }
        let title = Rect::from_min_size(rect.min, vec2(rect.width(), 30.0));
        if title.contains(plane) {
            return Under::Frame(name.clone());
        }
    }
    Under::Nothing
}

/// The pin of a card at a place of the plane.
fn pin(card: &Card, view: &NodeView, p: Pos2) -> Option<(End, bool)> {
    const REACH: f32 = 9.0;
    if !card.rect.expand(REACH).contains(p) {
        return None;
    }
    let output = if (p.x - card.rect.right()).abs() < REACH {
        true
    } else if (p.x - card.rect.left()).abs() < REACH {
        false
    } else {
        return None;
    };
    let y = p.y - card.rect.top();
    if y < TITLE {
        return Some((End::node(&card.name), output));
    }
    if card.rect.height() <= TITLE + 1.0 {
        return None;
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a row of a card below its title")]
    let row = ((y - TITLE) / ROW) as usize;
    let count = outputs(view).count();
    let port = if output { outputs(view).nth(row) } else { row.checked_sub(count).and_then(|i| inputs(view).nth(i)) };
    port.map(|p| (End::port(&card.name, &p.name), output))
}

/// The card whose body is at a place of the plane.
pub(super) fn card_at<'a>(seen: &'a Seen, plane: Pos2, but: Option<&str>) -> Option<&'a Card> {
    seen.cards.iter().rev().find(|c| c.rect.contains(plane) && Some(c.name.as_str()) != but)
}

/// Where a pin lies on the screen.
pub(super) fn place(seen: &Seen, view: &View, end: &End, output: bool) -> Option<Pos2> {
    let card = seen.card(&end.node)?;
    Some(view.to_screen(anchor(card.rect, card.view.as_deref(), end, output)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::pos2;

    #[test]
    fn a_title_is_the_pin_of_the_whole_node() {
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(200.0, 100.0));
        let card = Card { name: "a".into(), rect, selected: false, muted: false, category: "".into(), view: None };
        let view = NodeView::default();
        assert_eq!(pin(&card, &view, pos2(199.0, 5.0)), Some((End::node("a"), true)));
        assert_eq!(pin(&card, &view, pos2(-4.0, 20.0)), Some((End::node("a"), false)));
        assert_eq!(pin(&card, &view, pos2(100.0, 5.0)), None);
        assert_eq!(pin(&card, &view, pos2(199.0, 60.0)), None, "no such port");
    }
}
