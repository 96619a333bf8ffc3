//! What is drawn of a document from afar: boxes and lines. There may be thousands of them, so that all are one shape of
//! triangles, with soft edges as the toolkit gives them to its own.

use std::collections::BTreeMap;

use eframe::egui::{Color32, Mesh, Painter, Pos2, Rect, Shape, pos2, vec2};

use super::Surroundings;
use super::camera::{View, at};
use super::card::TITLE;
use super::wires::{Curve, curve};
use crate::diagnostic::Severity;
use crate::graph::Link;
use crate::gui::tab::Tab;
use crate::gui::theme::{self, Look};

/// Triangles with edges that fade over a pixel.
struct Soft {
    mesh: Mesh,
    /// Half a pixel, in points.
    fade: f32,
}

impl Soft {
    fn new(painter: &Painter) -> Self {
        Self { mesh: Mesh::default(), fade: 0.5 / painter.pixels_per_point() }
    }

    fn next(&self) -> u32 {
        u32::try_from(self.mesh.vertices.len()).unwrap_or(u32::MAX)
    }

    fn rect(&mut self, rect: Rect, color: Color32) {
        let first = self.next();
        let (inner, outer) = (rect.shrink(self.fade), rect.expand(self.fade));
        let corners = |r: Rect| [r.left_top(), r.right_top(), r.right_bottom(), r.left_bottom()];
        for corner in corners(inner) {
            self.mesh.colored_vertex(corner, color);
        }
        for corner in corners(outer) {
            self.mesh.colored_vertex(corner, Color32::TRANSPARENT);
        }
        self.mesh.add_triangle(first, first + 1, first + 2);
        self.mesh.add_triangle(first, first + 2, first + 3);
        for i in 0..4 {
            let j = (i + 1) % 4;
            self.mesh.add_triangle(first + i, first + 4 + i, first + 4 + j);
            self.mesh.add_triangle(first + i, first + 4 + j, first + j);
        }
    }

    /// A line about a pixel wide.
    fn line(&mut self, from: Pos2, to: Pos2, color: Color32) {
        let along = to - from;
        let length = along.length();
        if length == 0.0 {
            return;
        }
        let aside = vec2(-along.y, along.x) * (2.0 * self.fade / length);
        let first = self.next();
        for end in [from, to] {
            self.mesh.colored_vertex(end - aside, Color32::TRANSPARENT);
            self.mesh.colored_vertex(end, color);
            self.mesh.colored_vertex(end + aside, Color32::TRANSPARENT);
        }
        for i in [0, 1] {
            self.mesh.add_triangle(first + i, first + i + 1, first + i + 3);
            self.mesh.add_triangle(first + i + 1, first + i + 4, first + i + 3);
        }
    }

    fn paint(self, painter: &Painter) {
        painter.add(Shape::mesh(self.mesh));
    }
}

/// Links that may be seen, with where they begin and end on the screen.
fn links<'a>(tab: &'a Tab, view: &View) -> impl Iterator<Item = (&'a Link, Pos2, Pos2)> {
    let (view, seen) = (*view, view.seen());
    let bent = !tab.graph().waypoints.is_empty();
    std::iter::zip(&tab.graph().links, tab.cards.ends()).filter_map(move |(link, ends)| {
        let (from, to) = ends?;
        (bent || from.union(to).intersects(seen)).then(|| {
            let begin = pos2(from.right(), from.top() + TITLE / 2.0);
            let end = pos2(to.left(), to.top() + TITLE / 2.0);
            (link, view.to_screen(begin), view.to_screen(end))
        })
    })
}

/// The bends of a link, on the screen.
fn bends<'a>(tab: &'a Tab, view: &View, link: &Link) -> impl Iterator<Item = Pos2> + use<'a> {
    let (all, view) = (&tab.graph().waypoints, *view);
    let found = if all.is_empty() { None } else { all.get(&(link.from.clone(), link.to.clone())) };
    found.into_iter().flatten().map(move |bend| view.to_screen(at(*bend)))
}

/// Draws all links as straight lines.
pub(super) fn draw_links(painter: &Painter, tab: &Tab, view: &View, look: &Look) {
    let mut lines = Soft::new(painter);
    for (link, begin, end) in links(tab, view) {
        let chosen = tab.link.as_ref().is_some_and(|(from, to)| *from == link.from && *to == link.to);
        let color = if chosen { look.selected } else { look.weak.gamma_multiply(0.6) };
        let mut last = begin;
        for next in bends(tab, view, link).chain([end]) {
            lines.line(last, next, color);
            last = next;
        }
    }
    lines.paint(painter);
}

/// The link nearest to a point of the screen, if it is near.
pub(super) fn link_at<'a>(tab: &'a Tab, view: &View, p: Pos2, reach: f32) -> Option<&'a Link> {
    let far = |(link, begin, end): (&'a Link, Pos2, Pos2)| {
        let line: Curve = curve(begin, end, bends(tab, view, link), true);
        (line.distance(p), link)
    };
    let near = links(tab, view).map(far).min_by(|a, b| a.0.total_cmp(&b.0))?;
    (near.0 < reach).then_some(near.1)
}

/// Draws all cards as boxes, those that are selected above the others.
pub(super) fn draw_cards(painter: &Painter, tab: &Tab, around: &Surroundings<'_>, view: &View, look: &Look) {
    let mut colors: BTreeMap<&str, Color32> = BTreeMap::new();
    let seen = view.seen();
    let (mut below, mut above) = (Soft::new(painter), Soft::new(painter));
    for card in tab.cards.lying(&tab.selection).filter(|c| c.rect.intersects(seen)) {
        let rect = view.rect(card.rect);
        let boxes = if card.selected { &mut above } else { &mut below };
        let found = around.problems.get(card.name).map_or(&[][..], Vec::as_slice);
        let bad = found.iter().any(|d| d.severity == Severity::Error);
        match () {
            () if card.selected => boxes.rect(rect.expand(2.5), look.selected),
            () if bad => boxes.rect(rect.expand(2.0), look.error),
            () if !found.is_empty() => boxes.rect(rect.expand(1.5), look.warning),
            () => {}
        }
        let color = *colors.entry(&**card.category).or_insert_with(|| theme::category(card.category, look.dark));
        // Opaque, so that neither the frame below nor links shine through.
        let color = if card.muted { look.background.lerp_to_gamma(color, 0.45) } else { color };
        boxes.rect(rect, color);
    }
    below.paint(painter);
    above.paint(painter);
}
