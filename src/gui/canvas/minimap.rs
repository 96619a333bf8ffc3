//! The small map of all nodes; a click or drag on it goes there.

use eframe::egui::{self, Mesh, Rect, Sense, Stroke, StrokeKind, Ui, vec2};

use super::camera::View;
use crate::gui::tab::Tab;
use crate::gui::theme::Look;

pub(super) fn show(ui: &Ui, tab: &mut Tab, view: &View, look: &Look) {
    let Some(bounds) = tab.cards.bounds(tab.document.graph()) else { return };
    if view.screen.width() < 420.0 || view.screen.height() < 260.0 {
        return;
    }
    let all = bounds.union(view.seen().intersect(bounds.expand(bounds.size().max_elem()))).expand(20.0);
    let scale = (170.0 / all.width()).min(110.0 / all.height());
    let size = all.size() * scale;
    let place = Rect::from_min_size(view.screen.right_bottom() - size - vec2(12.0, 12.0), size);
    let painter = ui.painter_at(place.expand(1.0));
    painter.rect(place, 4.0, look.card.gamma_multiply(0.92), Stroke::new(1.0, look.outline), StrokeKind::Outside);
    let on_map =
        |r: Rect| Rect::from_min_max(place.min + (r.min - all.min) * scale, place.min + (r.max - all.min) * scale);
    // All boxes are one shape, as there may be thousands.
    let mut boxes = Mesh::default();
    for card in tab.cards.lying(&tab.selection) {
        let color = if card.selected { look.selected } else { look.weak };
        boxes.add_colored_rect(on_map(card.rect).expand(0.5), color);
    }
    painter.add(boxes);
    painter.rect_stroke(on_map(view.seen()).intersect(place), 0.0, Stroke::new(1.5, look.selected), StrokeKind::Inside);
    let response = ui.interact(place, ui.id().with("minimap"), Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Other, true, "Map of the graph"));
    if let Some(p) = response.interact_pointer_pos() {
        tab.camera.center = all.min + (p - place.min) / scale;
    }
}
