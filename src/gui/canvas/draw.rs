//! Cards of nodes and the ground that they lie on.

use eframe::egui::{
    self, Align2, Color32, CornerRadius, FontId, Painter, Pos2, Rect, Stroke, StrokeKind, Ui, pos2, vec2,
};

use super::Surroundings;
use super::camera::{Detail, View};
use super::card::{ROW, THUMBNAIL, TITLE, inputs, outputs};
use super::hit::{Card, Seen, Under};
use super::input::Gesture;
use crate::diagnostic::{Diagnostic, Severity};
use crate::graph::End;
use crate::gui::tab::Tab;
use crate::gui::theme::{self, Look, badge};
use crate::semantic::Value;
use crate::view::{NodeView, PortView};

/// Distance of the lines of the ground, in points of the plane.
const GROUND: f32 = 100.0;

pub(super) fn background(painter: &Painter, view: &View, look: &Look) {
    painter.rect_filled(view.screen, 0.0, look.background);
    if view.camera.zoom < 0.15 {
        return;
    }
    let seen = view.seen();
    let stroke = Stroke::new(1.0, look.grid);
    let mut x = (seen.left() / GROUND).floor() * GROUND;
    while x < seen.right() {
        painter.vline(view.to_screen(pos2(x, 0.0)).x, view.screen.y_range(), stroke);
        x += GROUND;
    }
    let mut y = (seen.top() / GROUND).floor() * GROUND;
    while y < seen.bottom() {
        painter.hline(view.screen.x_range(), view.to_screen(pos2(0.0, y)).y, stroke);
        y += GROUND;
    }
}

/// Text on one line, cut where it is too long.
pub(super) fn text(painter: &Painter, at: Pos2, anchor: Align2, text: &str, size: f32, width: f32, color: Color32) {
    if size < 4.0 || width < size {
        return;
    }
    let font = FontId::proportional((size * 2.0).round() / 2.0);
    let mut job = egui::text::LayoutJob::simple_singleline(text.to_owned(), font, color);
    job.wrap = egui::text::TextWrapping::truncate_at_width(width);
    let galley = painter.fonts_mut(|f| f.layout_job(job));
    let rect = anchor.anchor_size(at, galley.size());
    painter.galley(rect.min, galley, color);
}

#[allow(clippy::too_many_arguments, reason = "what is drawn, where, and how it looks")]
pub(super) fn nodes(
    ui: &Ui,
    painter: &Painter,
    tab: &mut Tab,
    around: &Surroundings<'_>,
    view: &View,
    seen: &Seen,
    under: Option<&Under>,
    look: &Look,
) {
    for card in &seen.cards {
        let rect = view.rect(card.rect);
        let selected = card.selected;
        let found: &[Diagnostic] = around.problems.get(&card.name).map_or(&[], Vec::as_slice);
        let fade = if card.muted { 0.45 } else { 1.0 };
        let title = theme::category(&card.category, look.dark).gamma_multiply(fade);
        let zoom = view.camera.zoom;
        let round = CornerRadius::same(if zoom > 0.3 { 6 } else { 1 });
        painter.rect_filled(rect, round, look.card.gamma_multiply(fade.max(0.6)));
        let bar = Rect::from_min_max(rect.min, pos2(rect.right(), rect.top() + TITLE * zoom));
        let flat = if card.rect.height() > TITLE + 1.0 { 0 } else { 6 };
        painter.rect_filled(bar, CornerRadius { nw: 6, ne: 6, sw: flat, se: flat }, title);
        let size = if view.detail() == Detail::Full { 13.5 * zoom } else { (13.5 * zoom).max(9.0) };
        let (middle, room) = (bar.left_center() + vec2(10.0 * zoom, 0.0), bar.width() - 16.0 * zoom);
        text(painter, middle, Align2::LEFT_CENTER, &card.name, size, room, look.text);
        if let Some(ports) = &card.view {
            details(ui, painter, tab, around, view, card, ports, under, look);
        }
        let worst = found.iter().map(|d| d.severity).max_by_key(|s| *s == Severity::Error);
        let (width, color) = match worst {
            _ if selected => (2.5, look.selected),
            Some(Severity::Error) => (2.0, look.error),
            Some(_) => (1.5, look.warning),
            None => (1.0, look.outline),
        };
        painter.rect_stroke(rect, round, Stroke::new(width, color), StrokeKind::Outside);
        if let Some(worst) = worst {
            let color = if worst == Severity::Error { look.error } else { look.warning };
            let at = rect.right_top() + vec2(-9.0, 0.0) * zoom;
            painter.circle(at, 8.0 * zoom.max(0.5), color, Stroke::new(1.0, look.outline));
            text(painter, at, Align2::CENTER_CENTER, "!", 12.0 * zoom.max(0.5), 20.0, Color32::WHITE);
        }
        accessible(ui, card, rect, found);
    }
}

/// What assistive tools are told of a card, and what a person sees who rests on its title.
fn accessible(ui: &Ui, card: &Card, rect: Rect, found: &[Diagnostic]) {
    let response = ui.interact(rect, ui.id().with(("node", &card.name)), egui::Sense::hover());
    let mut name = format!("Node {}", card.name);
    if !card.category.is_empty() {
        name.push_str(&format!(", {}", card.category));
    }
    if card.muted {
        name.push_str(", muted");
    }
    if !found.is_empty() {
        name.push_str(&format!(", {} problems", found.len()));
    }
    response.widget_info(|| egui::WidgetInfo::selected(egui::WidgetType::Other, true, card.selected, &name));
}

#[allow(clippy::too_many_arguments, reason = "what is drawn, where, and how it looks")]
fn details(
    ui: &Ui,
    painter: &Painter,
    tab: &Tab,
    around: &Surroundings<'_>,
    view: &View,
    card: &Card,
    ports: &NodeView,
    under: Option<&Under>,
    look: &Look,
) {
    let rect = view.rect(card.rect);
    let zoom = view.camera.zoom;
    let small = 10.5 * zoom;
    let right = pos2(rect.right() - 8.0 * zoom, rect.top() + TITLE * zoom / 2.0);
    let node = tab.graph().nodes.get(&card.name);
    let tag = if node.is_some_and(|n| n.muted) {
        "muted"
    } else if ports.subgraph.is_some() {
        "file"
    } else {
        ports.title.as_str()
    };
    if tag != card.name && card.rect.height() > TITLE + 1.0 {
        let name = painter.layout_no_wrap(card.name.clone(), FontId::proportional(13.5 * zoom), look.text).size().x;
        text(
            painter,
            right,
            Align2::RIGHT_CENTER,
            tag,
            small,
            rect.width() - name - 28.0 * zoom,
            look.text.gamma_multiply(0.75),
        );
    }
    // The pins of the whole node.
    for output in [false, true] {
        let x = if output { rect.right() } else { rect.left() };
        let has = if output { outputs(ports).next().is_some() } else { inputs(ports).next().is_some() };
        if has {
            let at = pos2(x, rect.top() + TITLE * zoom / 2.0);
            let hot = matches!(under, Some(Under::Pin { end, output: o }) if *o == output && end.port.is_none() && end.node == card.name);
            let half = vec2(3.0, 7.0) * zoom * if hot { 1.3 } else { 1.0 };
            painter.rect(
                Rect::from_center_size(at, half * 2.0),
                2.0,
                look.weak,
                Stroke::new(1.0, look.outline),
                StrokeKind::Inside,
            );
            pin_name(ui, at, &End::node(&card.name), output, "whole node", None, false);
        }
    }
    if card.rect.height() <= TITLE + 1.0 {
        return;
    }
    let mut y = rect.top() + TITLE * zoom;
    let given = outputs(ports).map(|p| (p, true));
    for (port, output) in given.chain(inputs(ports).map(|p| (p, false))) {
        let middle = y + ROW * zoom / 2.0;
        y += ROW * zoom;
        let x = if output { rect.right() } else { rect.left() };
        let at = pos2(x, middle);
        let (mut color, shape, letter) = badge(&port.ty);
        if !fits(tab, &card.name, port, output) {
            color = color.gamma_multiply(0.2);
        }
        let hot = matches!(under, Some(Under::Pin { end, output: o }) if *o == output && end.port.as_deref() == Some(&port.name) && end.node == card.name);
        let radius = if hot { 6.5 } else { 4.8 } * zoom;
        let fill = if port.linked || output { color } else { look.card };
        painter.add(theme::mark(shape, at, radius, fill, Stroke::new(1.5, color)));
        let found = around.problems.get(&card.name).into_iter().flatten();
        let bad = found.clone().find(|d| d.place.port.as_deref() == Some(&port.name));
        let ink = if bad.is_some() { look.error } else { look.text };
        let inset = 12.0 * zoom;
        if output {
            text(
                painter,
                at - vec2(inset, 0.0),
                Align2::RIGHT_CENTER,
                &port.label,
                12.0 * zoom,
                rect.width() * 0.7,
                ink,
            );
        } else {
            text(
                painter,
                at + vec2(inset, 0.0),
                Align2::LEFT_CENTER,
                &port.label,
                12.0 * zoom,
                rect.width() * 0.55,
                ink,
            );
            if !port.linked {
                value(painter, port, pos2(rect.right() - 10.0 * zoom, middle), zoom, look);
            }
        }
        if zoom >= 0.9 {
            let beside = at + vec2(if output { 9.0 } else { -9.0 } * zoom, -6.0 * zoom);
            text(painter, beside, Align2::CENTER_CENTER, &letter.to_string(), 8.0 * zoom, 20.0, look.weak);
        }
        let end = End::port(&card.name, &port.name);
        let response = pin_name(ui, at, &end, output, &port.ty.meaning.to_string(), Some(port), port.linked);
        if hot && matches!(tab.gesture, Gesture::None) {
            let why = bad.map(|d| d.message.clone());
            response.show_tooltip_ui(|ui| {
                ui.set_max_width(320.0);
                ui.strong(format!("{end}: {} ({})", port.ty.meaning, port.ty.shape.wgsl()));
                if !port.doc.is_empty() {
                    ui.label(&port.doc);
                }
                if let Some(why) = why {
                    ui.colored_label(look.error, why);
                }
            });
        }
    }
    if let Some(texture) = around.thumbnails.and_then(|t| t.get(&card.name)) {
        let side = THUMBNAIL * zoom;
        let square = Rect::from_center_size(pos2(rect.center().x, y + 4.0 * zoom + side / 2.0), vec2(side, side));
        painter.image(*texture, square, Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0)), Color32::WHITE);
    }
    if let Some((share, cost)) = around.costs.get(&card.name) {
        let galley = painter.layout_no_wrap(cost.clone(), FontId::proportional(11.0 * zoom), Color32::WHITE);
        let place = Rect::from_min_size(rect.left_bottom() + vec2(0.0, 3.0), galley.size() + vec2(10.0, 4.0));
        let heat =
            Color32::from_rgb(60, 120, 90).lerp_to_gamma(Color32::from_rgb(0xd0, 0x40, 0x30), share.clamp(0.0, 1.0));
        painter.rect_filled(place, 4.0, heat);
        painter.galley(place.min + vec2(5.0, 2.0), galley, Color32::WHITE);
    }
}

/// The value of an input that nothing is linked to, in short.
fn value(painter: &Painter, port: &PortView, at: Pos2, zoom: f32, look: &Look) {
    let default = match &port.default {
        Some(crate::node::Default::Value(value)) => Some(value),
        Some(crate::node::Default::Source(_)) | None => None,
    };
    let set = port.value.is_some();
    let ink = if set { look.text } else { look.weak };
    match (port.value.as_ref().or(default), &port.default) {
        (Some(Value::Numbers(n)), _) if n.len() == 3 && port.ty.meaning.kind == crate::semantic::Kind::Color => {
            let swatch = Rect::from_center_size(at - vec2(13.0 * zoom, 0.0), vec2(26.0, 11.0) * zoom);
            painter.rect(
                swatch,
                2.0,
                super::super::values::shown_color(n),
                Stroke::new(1.0, look.outline),
                StrokeKind::Inside,
            );
        }
        (Some(value), _) => text(painter, at, Align2::RIGHT_CENTER, &short(value), 10.5 * zoom, 90.0 * zoom, ink),
        (None, Some(crate::node::Default::Source(name))) => {
            text(painter, at, Align2::RIGHT_CENTER, &format!("@{name}"), 10.5 * zoom, 90.0 * zoom, look.weak);
        }
        (None, _) => {}
    }
}

/// A value in few letters.
fn short(value: &Value) -> String {
    match value {
        Value::Bool(b) => if *b { "yes" } else { "no" }.into(),
        Value::Numbers(n) => {
            n.iter().map(|x| format!("{}", (x * 1000.0).round() / 1000.0)).collect::<Vec<_>>().join(" ")
        }
        Value::Text(t) => t.rsplit('/').next().unwrap_or(t).to_owned(),
    }
}

/// Whether a port could take the wire that is being drawn.
fn fits(tab: &Tab, node: &str, port: &PortView, output: bool) -> bool {
    match &tab.gesture {
        Gesture::Wire { end, output: from_output, ty, .. } => {
            if end.node == node || output == *from_output {
                return end.node == node && end.port.as_deref() == Some(&port.name);
            }
            let Some(ty) = ty else { return true };
            let (from, to) = if *from_output { (ty, &port.ty) } else { (&port.ty, ty) };
            super::input::converts(from, to)
        }
        _ => true,
    }
}

/// What assistive tools are told of a pin.
fn pin_name(
    ui: &Ui,
    at: Pos2,
    end: &End,
    output: bool,
    meaning: &str,
    port: Option<&PortView>,
    linked: bool,
) -> egui::Response {
    let id = ui.id().with(("pin", end, output));
    let response = ui.interact(Rect::from_center_size(at, vec2(14.0, 14.0)), id, egui::Sense::hover());
    let side = if output { "output" } else { "input" };
    let state = if linked { ", linked" } else { "" };
    let name = match port {
        Some(port) => format!("{} / {side} {} ({meaning}){state}", end.node, port.name),
        None => format!("{} / {side} ({meaning})", end.node),
    };
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Other, true, &name));
    response
}
