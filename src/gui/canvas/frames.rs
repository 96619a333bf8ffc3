//! Frames and comments: titled rectangles behind the nodes.

use eframe::egui::{self, Align2, Color32, CornerRadius, Painter, Rect, Stroke, StrokeKind, Ui, vec2};

use super::camera::{View, at};
use super::draw::text;
use crate::gui::tab::Tab;
use crate::gui::theme::Look;

/// The colour of a frame in files: linear, as all colours there.
pub(super) fn tint(color: Option<[f64; 3]>, look: &Look) -> Color32 {
    color.map_or(look.weak, |c| super::super::values::shown_color(&c))
}

pub(super) fn draw(ui: &Ui, painter: &Painter, tab: &Tab, view: &View, look: &Look) {
    for (name, frame) in &tab.graph().frames {
        let rect = view.rect(Rect::from_min_size(at(frame.at), at(frame.size).to_vec2()));
        if !rect.intersects(view.screen) {
            continue;
        }
        let tint = tint(frame.color, look);
        let selected = tab.frame.as_ref() == Some(name);
        let zoom = view.camera.zoom;
        let stroke =
            if selected { Stroke::new(2.0, look.selected) } else { Stroke::new(1.0, tint.gamma_multiply(0.7)) };
        painter.rect(rect, CornerRadius::same(6), tint.gamma_multiply(0.13), stroke, StrokeKind::Inside);
        let top = rect.left_top() + vec2(10.0, 7.0) * zoom;
        text(painter, top, Align2::LEFT_TOP, name, 15.0 * zoom.max(0.45), rect.width() - 16.0 * zoom, look.text);
        if !frame.text.is_empty() && zoom > 0.35 {
            let font = egui::FontId::proportional((12.0 * zoom * 2.0).round() / 2.0);
            let galley = painter.layout(frame.text.clone(), font, look.weak, rect.width() - 20.0 * zoom);
            painter.with_clip_rect(rect.intersect(painter.clip_rect())).galley(
                top + vec2(0.0, 22.0 * zoom),
                galley,
                look.weak,
            );
        }
        let corner = rect.max - vec2(4.0, 4.0) * zoom;
        for step in [0.0, 4.0, 8.0] {
            let d = step * zoom;
            painter.line_segment([corner - vec2(d, 0.0), corner - vec2(0.0, d)], Stroke::new(1.0, tint));
        }
        let response = ui.interact(rect, ui.id().with(("frame", name)), egui::Sense::hover());
        response.widget_info(|| {
            egui::WidgetInfo::selected(egui::WidgetType::Other, true, selected, format!("Frame {name}"))
        });
    }
}
