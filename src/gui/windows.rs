//! Lists, menus and dialogs over the panels, and what is done with what is picked in them.

use eframe::egui::{self, Id};

use super::app::{Editor, Wanted};
use super::canvas::{Target, Wish};
use super::command::Command;
use super::finder::{Finder, Outcome, Row};
use crate::graph::Edit;
use crate::view::{self, Hit, Insert};

impl Editor {
    /// Does what the canvas asks.
    pub(super) fn canvas_wish(&mut self, wish: Wish) {
        match wish {
            Wish::Add { at, screen, wire } => {
                let title = if wire.is_some() { "Add and link" } else { "Add node" };
                self.finder = Some((Wanted::Add { at, wire }, Finder::new(title, Some(screen))));
            }
            Wish::Insert { link, at, screen } => {
                self.finder = Some((Wanted::Insert { link, at }, Finder::new("Insert into the link", Some(screen))));
            }
            Wish::Enter(node) => self.enter(&node),
            Wish::Rename(node) => {
                if let Some(tab) = self.tab_mut() {
                    tab.select(&node);
                }
                self.settings.side = true;
                self.drafts.focus_name = true;
            }
            Wish::Menu(target, at) => self.menu = Some((target, at)),
            Wish::Say(text) => self.say(text),
        }
    }

    pub(super) fn show_finder(&mut self, ctx: &egui::Context) {
        let Some((wanted, mut finder)) = self.finder.take() else { return };
        let outcome = finder.show(ctx, |query| self.rows(&wanted, query));
        match outcome {
            Outcome::Open => self.finder = Some((wanted, finder)),
            Outcome::Closed => {}
            Outcome::Picked(value) => self.picked(ctx, &wanted, &value),
        }
    }

    /// What fits a query, best first.
    fn rows(&self, wanted: &Wanted, query: &str) -> Vec<Row> {
        let Some(tab) = self.tab() else { return Vec::new() };
        let graph = tab.graph();
        match wanted {
            Wanted::Add { wire, .. } => {
                let fit = wire.as_ref().and_then(|w| view::fit_of(graph, &self.catalog, w));
                view::find(&self.catalog, query, fit.as_ref()).into_iter().map(row).collect()
            }
            Wanted::Insert { link: (from, to), .. } => {
                let fits = |kind: &str| {
                    view::insert_on_link(graph, &self.catalog, from, to, Insert::Kind(kind), [0.0; 2]).is_some()
                };
                view::find(&self.catalog, query, None).into_iter().filter(|hit| fits(&hit.kind)).map(row).collect()
            }
            Wanted::Swap(node) => {
                let kinds = view::compatible_kinds(graph, &self.catalog, node);
                let hits = view::find(&self.catalog, query, None);
                let place = |kind: &str| kinds.iter().position(|k| k == kind);
                let mut fitting: Vec<(usize, Hit)> =
                    hits.into_iter().filter_map(|h| Some((place(&h.kind)?, h))).collect();
                if query.is_empty() {
                    fitting.sort_by_key(|(i, _)| *i);
                }
                fitting.into_iter().map(|(_, hit)| row(hit)).collect()
            }
            Wanted::Find => {
                let query = query.to_lowercase();
                let named = graph
                    .nodes
                    .iter()
                    .filter(|(name, node)| name.to_lowercase().contains(&query) || node.kind.contains(&query));
                named
                    .map(|(name, node)| Row {
                        value: name.clone(),
                        title: name.clone(),
                        aside: node.kind.clone(),
                        about: node.note.clone(),
                    })
                    .collect()
            }
            Wanted::Command => {
                let query = query.to_lowercase();
                let fits = |c: &&Command| {
                    c.label().to_lowercase().contains(&query) || c.help().to_lowercase().contains(&query)
                };
                let mut rows: Vec<Row> = Vec::new();
                for (i, command) in Command::ALL.iter().enumerate().filter(|(_, c)| fits(c)) {
                    rows.push(Row {
                        value: i.to_string(),
                        title: command.label().into(),
                        aside: String::new(),
                        about: command.help().into(),
                    });
                }
                rows.sort_by_key(|r| !r.title.to_lowercase().starts_with(&query));
                rows
            }
        }
    }

    fn picked(&mut self, ctx: &egui::Context, wanted: &Wanted, value: &str) {
        let Some(tab) = self.tab() else { return };
        let graph = tab.graph();
        let (label, made) = match wanted {
            Wanted::Add { at, wire: Some(wire) } => {
                (format!("Add {value}"), view::add_linked(graph, &self.catalog, value, *at, wire))
            }
            Wanted::Add { at, wire: None } => {
                (format!("Add {value}"), Some(view::add(graph, &self.catalog, value, *at)))
            }
            Wanted::Insert { link: (from, to), at } => (
                format!("Insert {value}"),
                view::insert_on_link(graph, &self.catalog, from, to, Insert::Kind(value), *at),
            ),
            Wanted::Swap(node) => {
                (format!("Swap for {value}"), Some((view::swap_kind(graph, &self.catalog, node, value), node.clone())))
            }
            Wanted::Find => return self.go_to(value),
            Wanted::Command => {
                if let Some(command) = value.parse::<usize>().ok().and_then(|i| Command::ALL.get(i)) {
                    self.run(ctx, *command);
                }
                return;
            }
        };
        match made {
            Some((edit, name)) => {
                if self.change(&label, edit)
                    && let Some(tab) = self.tab_mut()
                {
                    tab.select(&name);
                }
            }
            None => self.say(format!("`{value}` does not fit there")),
        }
    }

    /// The menu of what was clicked with the other button.
    pub(super) fn show_menu(&mut self, ctx: &egui::Context) {
        let Some((target, at)) = self.menu.clone() else { return };
        let mut run = None;
        let mut wish = None;
        let mut open = true;
        let shown = egui::Area::new(Id::new("canvas menu"))
            .order(egui::Order::Foreground)
            .fixed_pos(at)
            .constrain(true)
            .show(ctx, |ui| {
                egui::Frame::menu(ui.style()).show(ui, |ui| {
                    ui.set_max_width(240.0);
                    ui.with_layout(egui::Layout::top_down_justified(egui::Align::LEFT), |ui| {
                        let offered: &[Command] = match &target {
                            Target::Plane(_) => &[
                                Command::Add,
                                Command::Paste,
                                Command::Frame,
                                Command::SelectAll,
                                Command::ArrangeAll,
                                Command::FrameAll,
                            ],
                            Target::Node(_) => &[
                                Command::Swap,
                                Command::Mute,
                                Command::Collapse,
                                Command::SetOutput,
                                Command::Look,
                                Command::Rename,
                                Command::Duplicate,
                                Command::Copy,
                                Command::Cut,
                                Command::Delete,
                                Command::DeleteHeal,
                                Command::Frame,
                                Command::Subgraph,
                                Command::Enter,
                                Command::NodeHelp,
                            ],
                            Target::Link(..) => &[Command::Pin, Command::Bend, Command::Delete],
                            Target::Frame(_) => &[Command::Delete],
                        };
                        if let Target::Link(from, to) = &target
                            && ui.button("Insert node…").clicked()
                        {
                            let middle = self.tab().map(|t| {
                                super::canvas::position(t.camera.center + (at - self.canvas.center()) / t.camera.zoom)
                            });
                            wish = Some(Wish::Insert {
                                link: (from.clone(), to.clone()),
                                at: middle.unwrap_or_default(),
                                screen: at,
                            });
                        }
                        for command in offered {
                            let keys = command.keys().first().map_or_else(String::new, |k| ctx.format_shortcut(k));
                            let button = egui::Button::new(command.label()).shortcut_text(keys);
                            if ui.add_enabled(self.can(*command), button).on_hover_text(command.help()).clicked() {
                                run = Some(*command);
                            }
                        }
                    });
                })
            });
        let outside = ctx.input(|i| {
            i.pointer.any_pressed() && i.pointer.interact_pos().is_some_and(|p| !shown.response.rect.contains(p))
        });
        if run.is_some() || wish.is_some() || outside || ctx.input(|i| i.key_pressed(egui::Key::Escape)) {
            open = false;
        }
        if !open {
            self.menu = None;
        }
        if let Some(wish) = wish {
            self.canvas_wish(wish);
        }
        match (run, &target) {
            // A node comes where the menu was opened.
            (Some(Command::Add), Target::Plane(place)) => {
                self.finder = Some((Wanted::Add { at: *place, wire: None }, Finder::new("Add node", Some(at))));
            }
            (Some(Command::Delete), Target::Frame(name)) => {
                self.change("Remove frame", Edit::SetFrame(name.clone(), None));
            }
            (Some(command), _) => self.run(ctx, command),
            (None, _) => {}
        }
    }

    pub(super) fn show_dialog(&mut self, ctx: &egui::Context) {
        let Some(mut dialog) = self.dialog.take() else { return };
        match dialog.show(ctx) {
            None => self.dialog = Some(dialog),
            Some(answer) => self.answer(ctx, dialog, answer),
        }
    }
}

fn row(hit: Hit) -> Row {
    Row { value: hit.kind, title: hit.label, aside: hit.category, about: hit.summary }
}
