//! What the pointer does on the canvas. A gesture is one step of the history.

use std::collections::{BTreeMap, BTreeSet};

use eframe::egui::{self, CursorIcon, Key, PointerButton, Pos2, Rect, Response, Stroke, StrokeKind, Ui, Vec2, vec2};

use super::camera::{Detail, View, at, position};
use super::hit::{self, Seen, Under};
use super::{Surroundings, Target, Wish, wires};
use crate::graph::{Edit, End, apply};
use crate::gui::tab::Tab;
use crate::gui::theme::{Look, badge};
use crate::semantic::{Conversions, Type};
use crate::view::{Insert, Pending, connect, insert_on_link, move_frame, place_missing};

/// What a drag does.
#[derive(Clone, Debug, Default)]
pub(in crate::gui) enum Gesture {
    #[default]
    None,
    /// Moves nodes, from where they were.
    Nodes {
        start: BTreeMap<String, Pos2>,
        grabbed: Pos2,
    },
    /// Draws a wire from a pin; perhaps one that was linked elsewhere before.
    Wire {
        end: End,
        output: bool,
        ty: Option<Type>,
        replaced: Option<(End, End)>,
    },
    /// Selects what is in a box.
    Box {
        from: Pos2,
        before: BTreeSet<String>,
    },
    Pan,
    Frame {
        name: String,
        last: Pos2,
    },
    Corner {
        name: String,
    },
    Bend {
        from: End,
        to: End,
        index: usize,
    },
}

/// Whether a value of one type can become one of another.
pub(super) fn converts(from: &Type, to: &Type) -> bool {
    thread_local! { static ALL: Conversions = Conversions::default(); }
    ALL.with(|all| all.chain(from, to).is_some())
}

/// Moves the camera.
pub(super) fn camera(ui: &Ui, response: &Response, tab: &mut Tab, screen: Rect) {
    if let Some(cursor) = response.hover_pos() {
        let (scroll, pinch, shift) = ui.input(|i| (i.smooth_scroll_delta(), i.zoom_delta(), i.modifiers.shift));
        if (pinch - 1.0).abs() > 1e-4 {
            tab.camera.zoom_at(screen, cursor, pinch);
        } else if shift {
            tab.camera.center -= vec2(scroll.x + scroll.y, 0.0) / tab.camera.zoom;
        } else if scroll.y != 0.0 {
            tab.camera.zoom_at(screen, cursor, (scroll.y * 0.004).exp());
        } else if scroll.x != 0.0 {
            tab.camera.center.x -= scroll.x / tab.camera.zoom;
        }
    }
    let space = ui.input(|i| i.key_down(Key::Space));
    let pans = response.dragged_by(PointerButton::Middle)
        || response.dragged_by(PointerButton::Secondary)
        || (space && response.dragged_by(PointerButton::Primary));
    if pans {
        tab.camera.center -= response.drag_delta() / tab.camera.zoom;
        if !matches!(tab.gesture, Gesture::Wire { .. } | Gesture::Nodes { .. }) {
            tab.gesture = Gesture::Pan;
        }
        ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
    }
}

/// Does what the pointer says.
#[allow(clippy::too_many_arguments, reason = "what was done, where, and to what")]
pub(super) fn pointer(
    ui: &Ui,
    response: &Response,
    tab: &mut Tab,
    around: &Surroundings<'_>,
    view: &View,
    seen: &Seen,
    under: Option<&Under>,
    wishes: &mut Vec<Wish>,
) {
    let modifiers = ui.input(|i| i.modifiers);
    let more = modifiers.shift || modifiers.command;
    if response.clicked() || response.secondary_clicked() || response.drag_started() {
        response.request_focus();
    }
    if response.drag_started_by(PointerButton::Primary)
        && matches!(tab.gesture, Gesture::None)
        && let Some(origin) = ui.input(|i| i.pointer.press_origin())
    {
        let pressed = hit::under(tab, seen, view, origin);
        begin(tab, seen, view, origin, &pressed, more);
    }
    if response.dragged()
        && let Some(p) = response.interact_pointer_pos()
    {
        drag(ui, tab, around, view, p, response.drag_delta(), wishes);
    }
    if response.drag_stopped() {
        let p = ui.input(|i| i.pointer.latest_pos()).unwrap_or(view.screen.center());
        end(tab, around, view, seen, p, wishes);
    }
    let Some(p) = response.interact_pointer_pos() else { return };
    let plane = view.to_plane(p);
    if response.double_clicked() {
        match under {
            Some(Under::Node(name)) if tab.graph().nodes.get(name).is_some_and(|n| n.graph.is_some()) => {
                wishes.push(Wish::Enter(name.clone()));
            }
            Some(Under::Node(name)) => wishes.push(Wish::Rename(name.clone())),
            Some(Under::Wire { from, to }) => bend(tab, seen, from, to, p, plane),
            Some(Under::Nothing) => wishes.push(Wish::Add { at: position(plane), screen: p, wire: None }),
            _ => {}
        }
    } else if response.clicked() {
        click(tab, around, under, modifiers.command, more);
    } else if response.secondary_clicked() {
        let target = match under {
            Some(Under::Node(name) | Under::Pin { end: End { node: name, .. }, .. }) => {
                if !tab.selection.contains(name) {
                    tab.select(name);
                }
                Target::Node(name.clone())
            }
            Some(Under::Wire { from, to } | Under::Bend { from, to, .. }) => {
                tab.link = Some((from.clone(), to.clone()));
                Target::Link(from.clone(), to.clone())
            }
            Some(Under::Frame(name) | Under::Corner(name)) => {
                tab.frame = Some(name.clone());
                Target::Frame(name.clone())
            }
            _ => Target::Plane(position(plane)),
        };
        wishes.push(Wish::Menu(target, p));
    }
}

fn click(tab: &mut Tab, around: &Surroundings<'_>, under: Option<&Under>, command: bool, more: bool) {
    match under {
        Some(Under::Node(name) | Under::Pin { end: End { node: name, .. }, .. }) => {
            if !more {
                tab.select(name);
            } else if !tab.selection.remove(name) {
                tab.selection.insert(name.clone());
            }
        }
        Some(Under::Wire { from, to }) => {
            if command {
                let _ = tab.pin(around.wiring, from, to);
            }
            tab.selection.clear();
            tab.frame = None;
            tab.link = tab
                .graph()
                .links
                .iter()
                .find(|l| l.from.node == from.node && l.to.node == to.node)
                .map(|l| (l.from.clone(), l.to.clone()));
        }
        Some(Under::Frame(name) | Under::Corner(name)) => {
            tab.selection.clear();
            tab.link = None;
            tab.frame = Some(name.clone());
        }
        Some(Under::Bend { from, to, index }) if command => {
            let mut bends = tab.graph().waypoints.get(&(from.clone(), to.clone())).cloned().unwrap_or_default();
            if *index < bends.len() {
                bends.remove(*index);
                let _ = tab.document.change("Straighten link", Edit::SetWaypoints(from.clone(), to.clone(), bends));
            }
        }
        _ if !more => {
            tab.selection.clear();
            tab.link = None;
            tab.frame = None;
        }
        _ => {}
    }
}

/// Adds a bend to a link where it was clicked.
fn bend(tab: &mut Tab, seen: &Seen, from: &End, to: &End, p: Pos2, plane: Pos2) {
    let mut bends = tab.graph().waypoints.get(&(from.clone(), to.clone())).cloned().unwrap_or_default();
    let wire = seen.wires.iter().find(|w| w.from == *from && w.to == *to);
    // From afar there is none to be bent.
    let Some(wire) = wire else { return };
    let index = wire.curve.piece_at(p).min(bends.len());
    bends.insert(index, position(plane));
    let _ = tab.document.change("Bend link", Edit::SetWaypoints(from.clone(), to.clone(), bends));
}

fn begin(tab: &mut Tab, seen: &Seen, view: &View, origin: Pos2, pressed: &Under, more: bool) {
    let plane = view.to_plane(origin);
    tab.gesture = match pressed {
        Under::Pin { end, output } if view.detail() == Detail::Full => {
            let ports = seen.card(&end.node).and_then(|c| c.view.clone());
            let list = ports.as_ref().map(|v| if *output { &v.outputs } else { &v.inputs });
            let ty = list.and_then(|l| l.iter().find(|p| Some(&p.name) == end.port.as_ref())).map(|p| p.ty.clone());
            // Dragging from an input that a link is pinned to takes up that link.
            let held = tab.graph().links.iter().find(|l| !output && end.port.is_some() && l.to == *end);
            match held {
                Some(link) => Gesture::Wire {
                    end: link.from.clone(),
                    output: true,
                    ty: None,
                    replaced: Some((link.from.clone(), link.to.clone())),
                },
                None => Gesture::Wire { end: end.clone(), output: *output, ty, replaced: None },
            }
        }
        Under::Node(name) | Under::Pin { end: End { node: name, .. }, .. } => {
            if !tab.selection.contains(name) {
                if !more {
                    tab.selection.clear();
                }
                tab.selection.insert(name.clone());
                tab.link = None;
            }
            let graph = tab.document.graph();
            let start = tab.selection.iter().map(|n| (n.clone(), tab.cards.rect(graph, n).min)).collect();
            Gesture::Nodes { start, grabbed: plane }
        }
        Under::Frame(name) => {
            // What lies in the frame moves with it, and so needs a place of its own.
            let graph = tab.document.graph();
            let places = place_missing(graph, &|n| tab.cards.size_of(graph, n));
            let _ = tab.document.gesture("Move frame", &format!("move frame {name}"), places);
            Gesture::Frame { name: name.clone(), last: plane }
        }
        Under::Corner(name) => Gesture::Corner { name: name.clone() },
        Under::Bend { from, to, index } => Gesture::Bend { from: from.clone(), to: to.clone(), index: *index },
        Under::Wire { .. } | Under::Nothing => {
            let before = if more { tab.selection.clone() } else { BTreeSet::new() };
            Gesture::Box { from: plane, before }
        }
    };
}

fn drag(ui: &Ui, tab: &mut Tab, around: &Surroundings<'_>, view: &View, p: Pos2, delta: Vec2, wishes: &mut Vec<Wish>) {
    let plane = view.to_plane(p);
    let changed = match &mut tab.gesture {
        Gesture::Nodes { start, grabbed } => {
            let free = ui.input(|i| i.modifiers.alt);
            let step = if free { 0.0 } else { around.grid };
            let mut shift = plane - *grabbed;
            // The first of the nodes stays on the grid; the others keep their distance from it.
            if step > 0.0
                && let Some(first) = start.values().next()
            {
                let there = *first + shift;
                shift = vec2((there.x / step).round(), (there.y / step).round()) * step - first.to_vec2();
            }
            let edits =
                start.iter().map(|(name, from)| Edit::Move(name.clone(), Some(position(*from + shift)))).collect();
            tab.document.gesture("Move", "move nodes", Edit::Batch(edits))
        }
        Gesture::Box { from, before } => {
            let area = Rect::from_two_pos(*from, plane);
            let inside = tab.cards.lying(before).filter(|card| card.rect.intersects(area)).map(|c| c.name.to_owned());
            tab.selection = before.iter().cloned().chain(inside).collect();
            tab.link = None;
            Ok(())
        }
        Gesture::Frame { name, last } => {
            let shift = plane - *last;
            if shift.length() < 0.5 {
                return;
            }
            *last = plane;
            let graph = tab.document.graph();
            let edit =
                move_frame(graph, name, [f64::from(shift.x), f64::from(shift.y)], &|n| tab.cards.size_of(graph, n));
            let key = format!("move frame {name}");
            tab.document.gesture("Move frame", &key, edit)
        }
        Gesture::Corner { name } => match tab.document.graph().frames.get(name).cloned() {
            Some(mut frame) => {
                frame.size = position((plane - at(frame.at)).max(vec2(80.0, 40.0)).to_pos2());
                let edit = Edit::SetFrame(name.clone(), Some(Box::new(frame)));
                let key = format!("size frame {name}");
                tab.document.gesture("Resize frame", &key, edit)
            }
            None => Ok(()),
        },
        Gesture::Bend { from, to, index } => {
            let mut bends =
                tab.document.graph().waypoints.get(&(from.clone(), to.clone())).cloned().unwrap_or_default();
            if let Some(bend) = bends.get_mut(*index) {
                *bend = position(plane);
            }
            let edit = Edit::SetWaypoints(from.clone(), to.clone(), bends);
            tab.document.gesture("Bend link", "bend", edit)
        }
        Gesture::Wire { .. } | Gesture::Pan | Gesture::None => Ok(()),
    };
    if let Err(error) = changed {
        wishes.push(Wish::Say(error.to_string()));
    }
    // At the edge the plane follows.
    if matches!(tab.gesture, Gesture::Nodes { .. } | Gesture::Wire { .. } | Gesture::Box { .. }) && delta != Vec2::ZERO
    {
        let inside = view.screen.shrink(14.0);
        let beyond = p - inside.clamp(p);
        tab.camera.center += beyond * 0.35 / tab.camera.zoom;
    }
}

fn end(tab: &mut Tab, around: &Surroundings<'_>, view: &View, seen: &Seen, p: Pos2, wishes: &mut Vec<Wish>) {
    let gesture = std::mem::take(&mut tab.gesture);
    match gesture {
        Gesture::Wire { end, output, replaced, .. } => {
            let target = hit::under(tab, seen, view, p);
            release(tab, around, view, seen, (&end, output, replaced), &target, p, wishes);
        }
        Gesture::Nodes { start, .. } if start.len() == 1 => {
            if let Some(name) = start.keys().next() {
                drop_on_link(tab, around, seen, name, p, wishes);
            }
        }
        _ => {}
    }
    tab.document.end_gesture();
}

/// A node without links that is dropped on a link goes into it.
fn drop_on_link(tab: &mut Tab, around: &Surroundings<'_>, seen: &Seen, name: &str, p: Pos2, wishes: &mut Vec<Wish>) {
    if tab.graph().links.iter().any(|l| l.from.node == name || l.to.node == name) {
        return;
    }
    let near = seen.wires.iter().find(|w| w.curve.distance(p) < 24.0);
    let Some(wire) = near else { return };
    let place = position(tab.cards.rect(tab.graph(), name).min);
    match insert_on_link(tab.graph(), around.catalog, &wire.from, &wire.to, Insert::Node(name), place) {
        Some((edit, _)) => {
            // The drag and what came of it are one step.
            if let Err(error) = tab.document.gesture("Insert", "move nodes", edit) {
                wishes.push(Wish::Say(error.to_string()));
            }
        }
        None => wishes.push(Wish::Say(format!("`{name}` does not fit into {} -> {}", wire.from, wire.to))),
    }
}

/// Ends a wire on what lies under the pointer.
#[allow(clippy::too_many_arguments, reason = "what was drawn, and onto what")]
fn release(
    tab: &mut Tab,
    around: &Surroundings<'_>,
    view: &View,
    seen: &Seen,
    (end, output, replaced): (&End, bool, Option<(End, End)>),
    target: &Under,
    p: Pos2,
    wishes: &mut Vec<Wish>,
) {
    let other = match target {
        Under::Pin { end: there, output: side } if *side != output => Some(there.clone()),
        Under::Pin { end: there, .. } => Some(End::node(&there.node)),
        Under::Node(name) => Some(End::node(name)),
        _ => hit::card_at(seen, view.to_plane(p), Some(&end.node)).map(|c| End::node(&c.name)),
    };
    let unlink = replaced.as_ref().map(|(from, to)| Edit::Unlink(from.clone(), to.clone()));
    let Some(other) = other else {
        match unlink {
            // A link that was taken up and let go in the open is gone.
            Some(unlink) => drop(tab.document.change("Unlink", unlink)),
            None => {
                let wire = Some(Pending { end: end.clone(), from_output: output });
                wishes.push(Wish::Add { at: position(view.to_plane(p)), screen: p, wire });
            }
        }
        return;
    };
    if other.node == end.node {
        return;
    }
    let (from, to) = if output { (end, &other) } else { (&other, end) };
    if replaced.as_ref().is_some_and(|(f, t)| f == from && t == to) {
        return;
    }
    let mut trial = tab.graph().clone();
    if let Some(unlink) = &unlink
        && apply(&mut trial, unlink.clone()).is_err()
    {
        return;
    }
    match connect(&trial, around.catalog, from, to) {
        Ok(edit) => {
            let edit = match unlink {
                Some(unlink) => Edit::Batch(vec![unlink, edit]),
                None => edit,
            };
            if let Err(error) = tab.document.change("Link", edit) {
                wishes.push(Wish::Say(error.to_string()));
            }
        }
        Err(why) => wishes.push(Wish::Say(why)),
    }
}

/// Draws what a gesture shows on the way.
pub(super) fn draw(ui: &Ui, painter: &egui::Painter, tab: &Tab, view: &View, seen: &Seen, look: &Look) {
    let pointer = ui.input(|i| i.pointer.latest_pos());
    match (&tab.gesture, pointer) {
        (Gesture::Wire { end, output, ty, .. }, Some(p)) => {
            let Some(begin) = hit::place(seen, view, end, *output) else { return };
            let color = ty.as_ref().map_or(look.selected, |ty| badge(ty).0);
            let (a, b) = if *output { (begin, p) } else { (p, begin) };
            wires::pending(painter, a, b, Stroke::new(2.5, color));
        }
        (Gesture::Box { from, .. }, Some(p)) => {
            let area = Rect::from_two_pos(view.to_screen(*from), p);
            painter.rect(
                area,
                0.0,
                look.selected.gamma_multiply(0.12),
                Stroke::new(1.0, look.selected),
                StrokeKind::Inside,
            );
        }
        _ => {}
    }
}
