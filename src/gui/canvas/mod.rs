//! The canvas: nodes, links and frames on a plane, drawn and edited. It is drawn in points of the screen, so that text
//! stays sharp and what assistive tools are told of places is true. Only what is seen is drawn.

mod camera;
mod card;
mod draw;
mod far;
mod frames;
mod hit;
mod input;
mod minimap;
mod wires;

use std::collections::BTreeMap;

use eframe::egui::{self, Rect, Sense, Ui};

pub(super) use camera::{Camera, ZOOM, position};
pub(super) use card::{Cards, Subgraphs};
pub(super) use input::Gesture;

use super::tab::Tab;
use super::theme::Look;
use crate::diagnostic::Diagnostic;
use crate::graph::End;
use crate::node::Catalog;
use crate::preview::Resolved;
use crate::view::Pending;
use camera::{Detail, View};

/// What the canvas shows besides the document.
pub(super) struct Surroundings<'a> {
    pub(super) catalog: &'a Catalog,
    pub(super) subgraphs: Subgraphs<'a>,
    /// What links came to, by the nodes at their ends.
    pub(super) wiring: &'a BTreeMap<(String, String), Vec<Resolved>>,
    /// What is wrong, by node.
    pub(super) problems: &'a BTreeMap<String, Vec<Diagnostic>>,
    /// What each node costs, in words, where that is to be shown.
    pub(super) costs: &'a BTreeMap<String, (f32, String)>,
    /// Pictures of nodes, where they are to be shown.
    pub(super) thumbnails: Option<&'a BTreeMap<String, egui::TextureId>>,
    /// Distance between grid points that nodes stay on while they are dragged; 0 for none.
    pub(super) grid: f32,
    pub(super) minimap: bool,
}

/// What the canvas asks of the rest of the editor.
#[derive(Clone, Debug)]
pub(super) enum Wish {
    /// Search for a node to put at this place of the plane, at the end of this wire.
    Add { at: [f64; 2], screen: egui::Pos2, wire: Option<Pending> },
    /// Search for a node to put into this link.
    Insert { link: (End, End), at: [f64; 2], screen: egui::Pos2 },
    /// Open the graph that this node stands for.
    Enter(String),
    /// Give this node another name.
    Rename(String),
    /// A menu for what was clicked.
    Menu(Target, egui::Pos2),
    /// Say this to the person.
    Say(String),
}

/// What a menu is for.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Target {
    Plane([f64; 2]),
    Node(String),
    Link(End, End),
    Frame(String),
}

/// Draws the canvas and does what the pointer says.
pub(super) fn show(ui: &mut Ui, tab: &mut Tab, around: &Surroundings<'_>) -> (egui::Response, Vec<Wish>) {
    let screen = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(screen, Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Other, true, "Canvas"));
    let look = Look::of(ui.visuals());
    tab.cards.refresh(&tab.document, around.catalog, around.subgraphs, around.thumbnails.is_some());
    if !tab.fitted && screen.width() > 80.0 {
        tab.fitted = true;
        if let Some(bounds) = tab.cards.bounds(tab.document.graph()) {
            tab.camera.fit(bounds, screen.size());
        }
    }
    let mut wishes = Vec::new();
    input::camera(ui, &response, tab, screen);
    let view = View { camera: tab.camera, screen };
    let before = tab.document.revision();
    let seen = hit::seen(tab, around, &view);
    let under =
        response.hover_pos().or_else(|| response.interact_pointer_pos()).map(|p| hit::under(tab, &seen, &view, p));
    input::pointer(ui, &response, tab, around, &view, &seen, under.as_ref(), &mut wishes);
    // What was moved is drawn where it is now.
    let moved = (tab.camera, tab.document.revision()) != (view.camera, before);
    let view = View { camera: tab.camera, screen };
    let seen = if moved {
        tab.cards.refresh(&tab.document, around.catalog, around.subgraphs, around.thumbnails.is_some());
        hit::seen(tab, around, &view)
    } else {
        seen
    };
    let painter = ui.painter_at(screen);
    draw::background(&painter, &view, &look);
    frames::draw(ui, &painter, tab, &view, &look);
    if view.detail() == Detail::Box {
        far::draw_links(&painter, tab, &view, &look);
        far::draw_cards(&painter, tab, around, &view, &look);
    } else {
        wires::draw(ui, &painter, tab, around, &view, &seen, under.as_ref(), &look);
        draw::nodes(ui, &painter, tab, around, &view, &seen, under.as_ref(), &look);
    }
    input::draw(ui, &painter, tab, &view, &seen, &look);
    if around.minimap && !tab.graph().nodes.is_empty() {
        minimap::show(ui, tab, &view, &look);
    }
    (response, wishes)
}

/// The rectangle of the plane that some nodes cover.
pub(super) fn bounds_of<'a>(tab: &Tab, names: impl Iterator<Item = &'a String>) -> Option<Rect> {
    names.map(|name| tab.cards.rect(tab.graph(), name)).reduce(Rect::union)
}
