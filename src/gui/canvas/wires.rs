//! Links as curves: coloured by what flows, whole nodes as broad bands, ports as lines, and on each the conversions that
//! the weaver put in.

use eframe::egui::epaint::{CubicBezierShape, PathShape};
use eframe::egui::{self, Color32, Painter, Pos2, Rect, Shape, Stroke, Ui, Vec2, vec2};

use super::Surroundings;
use super::camera::{Detail, View, at};
use super::hit::{Seen, Under, Wire};
use crate::graph::End;
use crate::gui::tab::Tab;
use crate::gui::theme::{Look, badge};
use crate::preview::Resolved;

/// A link as drawn: the ends of its pieces.
pub(super) struct Curve {
    points: Vec<Pos2>,
    straight: bool,
}

/// A curve from one place to another through some bends.
pub(super) fn curve(begin: Pos2, end: Pos2, bends: impl Iterator<Item = Pos2>, straight: bool) -> Curve {
    let points = std::iter::once(begin).chain(bends).chain([end]).collect();
    Curve { points, straight }
}

impl Curve {
    /// Pieces with their control points.
    fn pieces(&self) -> impl Iterator<Item = [Pos2; 4]> + '_ {
        self.points.windows(2).map(|ends| {
            let (a, b) = (ends[0], ends[1]);
            let reach =
                if self.straight { 0.0 } else { ((b.x - a.x).abs() * 0.5).clamp(12.0, 120.0).max((a.x - b.x) * 0.35) };
            [a, a + vec2(reach, 0.0), b - vec2(reach, 0.0), b]
        })
    }

    pub(super) fn bounds(&self) -> Rect {
        self.pieces().flatten().fold(Rect::NOTHING, |mut r, p| {
            r.extend_with(p);
            r
        })
    }

    /// A point of the curve from 0 at its begin to 1 at its end.
    pub(super) fn point(&self, t: f32) -> Pos2 {
        #[allow(clippy::cast_precision_loss, reason = "a link has few bends")]
        let count = (self.points.len() - 1) as f32;
        let whole = (t * count).clamp(0.0, count - 1e-3);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped just above")]
        let piece = self.pieces().nth(whole as usize);
        piece.map_or(self.points[0], |piece| bezier(&piece, whole.fract()))
    }

    /// How far a point is from the curve.
    pub(super) fn distance(&self, p: Pos2) -> f32 {
        if !self.bounds().expand(10.0).contains(p) {
            return f32::INFINITY;
        }
        let mut least = f32::INFINITY;
        for piece in self.pieces() {
            let mut before = piece[0];
            for step in 1..=16_u8 {
                let next = bezier(&piece, f32::from(step) / 16.0);
                least = least.min(to_segment(p, before, next));
                before = next;
            }
        }
        least
    }

    /// Number of the piece that is nearest to a point.
    pub(super) fn piece_at(&self, p: Pos2) -> usize {
        let far = |piece: &[Pos2; 4]| {
            (0..=16_u8).map(|i| (bezier(piece, f32::from(i) / 16.0) - p).length()).fold(f32::INFINITY, f32::min)
        };
        let pieces: Vec<f32> = self.pieces().map(|piece| far(&piece)).collect();
        (0..pieces.len()).min_by(|a, b| pieces[*a].total_cmp(&pieces[*b])).unwrap_or(0)
    }

    pub(super) fn draw(&self, painter: &Painter, stroke: Stroke) {
        for piece in self.pieces() {
            if self.straight {
                painter.line_segment([piece[0], piece[3]], stroke);
            } else {
                painter.add(CubicBezierShape::from_points_stroke(piece, false, Color32::TRANSPARENT, stroke));
            }
        }
    }

    fn dashed(&self, painter: &Painter, stroke: Stroke) {
        let mut path = Vec::new();
        for piece in self.pieces() {
            path.extend((0..=24_u8).map(|i| bezier(&piece, f32::from(i) / 24.0)));
        }
        painter.extend(Shape::dashed_line(&path, stroke, 6.0, 4.0));
    }
}

fn bezier([a, b, c, d]: &[Pos2; 4], t: f32) -> Pos2 {
    let u = 1.0 - t;
    let sum = a.to_vec2() * (u * u * u)
        + b.to_vec2() * (3.0 * u * u * t)
        + c.to_vec2() * (3.0 * u * t * t)
        + d.to_vec2() * (t * t * t);
    sum.to_pos2()
}

fn to_segment(p: Pos2, a: Pos2, b: Pos2) -> f32 {
    let along = b - a;
    let t = if along == Vec2::ZERO { 0.0 } else { ((p - a).dot(along) / along.length_sq()).clamp(0.0, 1.0) };
    (a + along * t - p).length()
}

/// What a link came to.
fn resolved<'a>(around: &'a Surroundings<'_>, from: &End, to: &End) -> Vec<&'a Resolved> {
    let all = around.wiring.get(&(from.node.clone(), to.node.clone()));
    let fits = |wanted: &Option<String>, port: &str| wanted.as_deref().is_none_or(|w| w == port);
    all.into_iter().flatten().filter(|r| fits(&from.port, &r.from.1) && fits(&to.port, &r.to.1)).collect()
}

/// The colour of what flows through a link.
fn color(tab: &mut Tab, around: &Surroundings<'_>, wire: &Wire, look: &Look) -> Color32 {
    let graph = tab.document.graph();
    let view = tab.cards.view(graph, around.catalog, around.subgraphs, &wire.from.node);
    let port = match &wire.from.port {
        Some(port) => view.outputs.iter().find(|p| p.name == *port),
        None => view.outputs.first(),
    };
    port.map_or(look.weak, |p| badge(&p.ty).0)
}

/// What a person is told of a link.
pub(super) fn told(from: &End, to: &End, found: &[&Resolved]) -> String {
    let mut text = format!("{from} -> {to}");
    for wire in found {
        text.push_str(&format!("\n{}.{} -> {}.{}", wire.from.0, wire.from.1, wire.to.0, wire.to.1));
        if !wire.conversions.is_empty() {
            text.push_str(&format!("  through {} (cost {})", wire.conversions.join(", "), wire.cost));
        }
    }
    if found.is_empty() {
        text.push_str("\nnot resolved: see the problems");
    } else if from.port.is_none() || to.port.is_none() {
        text.push_str("\nCtrl+click or P pins these ports");
    }
    text
}

#[allow(clippy::too_many_arguments, reason = "what is drawn, where, and how it looks")]
pub(super) fn draw(
    ui: &Ui,
    painter: &Painter,
    tab: &mut Tab,
    around: &Surroundings<'_>,
    view: &View,
    seen: &Seen,
    under: Option<&Under>,
    look: &Look,
) {
    let detail = view.detail();
    let zoom = view.camera.zoom;
    for wire in &seen.wires {
        let chosen = tab.link.as_ref().is_some_and(|(from, to)| *from == wire.from && *to == wire.to);
        let hovered = matches!(under, Some(Under::Wire { from, to }) if *from == wire.from && *to == wire.to);
        let color = color(tab, around, wire, look);
        let whole = wire.from.port.is_none() || wire.to.port.is_none();
        let found = resolved(around, &wire.from, &wire.to);
        let width = (if whole { 3.5 } else { 2.0 }) * zoom.clamp(0.6, 1.4);
        if chosen || hovered {
            let around_it = if chosen { look.selected } else { look.text };
            wire.curve.draw(painter, Stroke::new(width + 4.0, around_it.gamma_multiply(0.55)));
        }
        let muted = tab.graph().nodes.get(&wire.from.node).is_some_and(|n| n.muted);
        if muted {
            wire.curve.dashed(painter, Stroke::new(width, color.gamma_multiply(0.6)));
        } else if whole && found.is_empty() && !around.wiring.is_empty() {
            wire.curve.dashed(painter, Stroke::new(width, color));
        } else {
            wire.curve.draw(painter, Stroke::new(width, color));
        }
        if let Some(bends) = tab.graph().waypoints.get(&(wire.from.clone(), wire.to.clone())) {
            for bend in bends {
                painter.circle(view.to_screen(at(*bend)), 4.0 * zoom.max(0.6), color, Stroke::new(1.0, look.outline));
            }
        }
        if detail == Detail::Full {
            details(ui, painter, wire, &found, hovered || chosen, color, look, zoom);
        }
        if hovered && matches!(tab.gesture, super::Gesture::None) {
            egui::Tooltip::always_open(
                ui.ctx().clone(),
                ui.layer_id(),
                ui.id().with("wire told"),
                egui::PopupAnchor::Pointer,
            )
            .show(|ui| ui.label(told(&wire.from, &wire.to, &found)));
            if whole {
                ghosts(painter, tab, around, view, seen, &found, look);
            }
        }
    }
}

/// The name of a link for assistive tools, and the mark of conversions.
#[allow(clippy::too_many_arguments, reason = "what is drawn, where, and how it looks")]
fn details(
    ui: &Ui,
    painter: &Painter,
    wire: &Wire,
    found: &[&Resolved],
    lively: bool,
    color: Color32,
    look: &Look,
    zoom: f32,
) {
    let middle = wire.curve.point(0.5);
    let id = ui.id().with(("wire", &wire.from, &wire.to));
    let response = ui.interact(Rect::from_center_size(middle, vec2(14.0, 14.0)), id, egui::Sense::hover());
    let name = format!("Link {} -> {}", wire.from, wire.to);
    response.widget_info(|| egui::WidgetInfo::selected(egui::WidgetType::Other, true, lively, &name));
    let converted: u32 = found.iter().map(|r| r.cost).sum();
    if converted > 0 && zoom > 0.6 {
        let text = format!("↔ {converted}");
        let galley = painter.layout_no_wrap(text, egui::FontId::proportional((10.0 * zoom).round()), look.text);
        let rect = Rect::from_center_size(middle, galley.size() + vec2(8.0, 3.0));
        painter.rect(rect, 6.0, look.card, Stroke::new(1.0, color), egui::StrokeKind::Inside);
        painter.galley(rect.center() - galley.size() / 2.0, galley, look.text);
    }
}

/// Thin lines between the ports that a link of whole nodes came to.
fn ghosts(
    painter: &Painter,
    tab: &mut Tab,
    around: &Surroundings<'_>,
    view: &View,
    seen: &Seen,
    found: &[&Resolved],
    look: &Look,
) {
    for wire in found {
        let graph = tab.document.graph();
        let from_view = tab.cards.view(graph, around.catalog, around.subgraphs, &wire.from.0);
        let color = from_view.outputs.iter().find(|p| p.name == wire.from.1).map_or(look.weak, |p| badge(&p.ty).0);
        let (from, to) = (End::port(&wire.from.0, &wire.from.1), End::port(&wire.to.0, &wire.to.1));
        if let (Some(a), Some(b)) =
            (super::hit::place(seen, view, &from, true), super::hit::place(seen, view, &to, false))
        {
            curve(a, b, std::iter::empty(), false).dashed(painter, Stroke::new(1.5, color));
        }
    }
}

/// A wire that is being drawn.
pub(super) fn pending(painter: &Painter, from: Pos2, to: Pos2, stroke: Stroke) {
    curve(from, to, std::iter::empty(), false).draw(painter, stroke);
    painter.add(PathShape::line(vec![to - vec2(4.0, 0.0), to + vec2(4.0, 0.0)], stroke));
}
