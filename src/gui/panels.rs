//! The panels around the canvas, and what is done with what is asked in them.

use std::collections::BTreeMap;
use std::path::Path;

use eframe::egui::{self, Panel, Ui};

use super::app::{Editor, Page};
use super::canvas::{self, Surroundings};
use super::command::{Command, Menu};
use super::dialogs::{Dialog, PathDialog, Purpose};
use super::{cost, inspector, preview, problems, theme};

impl Editor {
    pub(super) fn menus(&mut self, ui: &mut Ui) {
        let mut run = None;
        egui::MenuBar::new().ui(ui, |ui| {
            for (menu, title) in Menu::ALL {
                ui.menu_button(title, |ui| {
                    ui.set_min_width(250.0);
                    for command in Command::ALL.iter().filter(|c| c.menu() == menu) {
                        let keys = command.keys().first().map_or_else(String::new, |k| ui.ctx().format_shortcut(k));
                        let button = egui::Button::new(self.label_of(*command)).shortcut_text(keys);
                        if ui.add_enabled(self.can(*command), button).on_hover_text(command.help()).clicked() {
                            run = Some(*command);
                            ui.close();
                        }
                    }
                    if menu == Menu::File && !self.settings.recent.is_empty() {
                        ui.menu_button("Recent", |ui| {
                            for path in self.settings.recent.clone() {
                                if ui.button(path.display().to_string()).clicked() {
                                    self.open(&path);
                                    ui.close();
                                }
                            }
                        });
                    }
                });
            }
            ui.separator();
            self.tab_bar(ui, &mut run);
        });
        if let Some(command) = run {
            self.run(ui.ctx(), command);
        }
    }

    /// What a command is called now: with a mark where it is switched on, and with what it would undo.
    fn label_of(&self, command: Command) -> String {
        let on = match command {
            Command::Snap => self.settings.snap,
            Command::Minimap => self.settings.minimap,
            Command::Thumbnails => self.thumbnails,
            Command::CostOverlay => self.costs,
            Command::Outline => self.settings.outline,
            Command::Bottom => self.settings.bottom,
            Command::Side => self.settings.side,
            Command::Pause => self.preview.paused,
            _ => false,
        };
        let document = self.tab().map(|t| &t.document);
        let of = match command {
            Command::Undo => document.and_then(|d| d.undo_label()),
            Command::Redo => document.and_then(|d| d.redo_label()),
            _ => None,
        };
        let mark = if on { "✔ " } else { "" };
        match of {
            Some(of) => format!("{mark}{}: {of}", command.label()),
            None => format!("{mark}{}", command.label()),
        }
    }

    fn tab_bar(&mut self, ui: &mut Ui, run: &mut Option<Command>) {
        let mut go = None;
        egui::ScrollArea::horizontal().id_salt("tabs").show(ui, |ui| {
            for (i, tab) in self.tabs.iter().enumerate() {
                let response = ui.selectable_label(i == self.active, tab.title());
                if response.on_hover_text(tab.key().display().to_string()).clicked() {
                    go = Some(i);
                }
                if i == self.active && ui.small_button("×").on_hover_text("Close").clicked() {
                    *run = Some(Command::Close);
                }
            }
        });
        if let Some(i) = go {
            self.active = i;
        }
    }

    /// The way from the outermost graph to this one.
    fn crumbs(&mut self, ui: &mut Ui) {
        let mut way = Vec::new();
        let mut index = Some(self.active);
        while let Some(i) = index.filter(|_| way.len() < crate::graph::MAX_NESTING) {
            let Some(tab) = self.tabs.get(i) else { break };
            way.push((i, tab.title(), tab.outer.as_ref().map(|(_, node)| node.clone())));
            index = tab.outer.as_ref().and_then(|(key, _)| self.tabs.iter().position(|t| t.key() == key));
        }
        if way.len() < 2 {
            return;
        }
        ui.horizontal(|ui| {
            for (i, title, node) in way.into_iter().rev() {
                if let Some(node) = node {
                    ui.weak(format!("› {node}:"));
                }
                if ui.selectable_label(i == self.active, title).clicked() {
                    self.active = i;
                }
            }
        });
    }

    pub(super) fn side(&mut self, ui: &mut Ui) {
        let busy = self.feed.engine.busy();
        let Self { tabs, active, preview, catalog, library, drafts, feed, .. } = self;
        let mut wishes = Vec::new();
        let mut asked = Vec::new();
        let height = ui.available_height();
        Panel::top("preview").resizable(true).default_size(330.0).size_range(120.0..=(height - 120.0).max(130.0)).show(
            ui,
            |ui| {
                let tab = tabs.get_mut(*active);
                let key = tab.as_ref().map(|t| t.key().to_path_buf()).unwrap_or_default();
                wishes = preview.show(ui, tab, catalog, &|path| library.get(&key, path), busy);
            },
        );
        egui::CentralPanel::default().show(ui, |ui| {
            egui::ScrollArea::vertical().auto_shrink([false, false]).id_salt("inspector").show(ui, |ui| {
                if let Some(tab) = tabs.get_mut(*active) {
                    let key = tab.key().to_path_buf();
                    let found = feed.problems_of(&key);
                    let own = tab.only().and_then(|n| found.get(n)).cloned().unwrap_or_default();
                    asked = inspector::show(ui, tab, drafts, catalog, &|path| library.get(&key, path), &own);
                }
            });
        });
        for wish in wishes {
            match wish {
                preview::Wish::OpenScene => {
                    self.dialog = Some(Dialog::Path(PathDialog::new(Purpose::Scene, "graphs/scenes/")))
                }
                preview::Wish::OpenSurroundings => {
                    self.dialog = Some(Dialog::Path(PathDialog::new(Purpose::Surroundings, "")));
                }
                preview::Wish::OpenModel => self.dialog = Some(Dialog::Path(PathDialog::new(Purpose::Model, ""))),
                preview::Wish::Abandon => {
                    self.feed.engine.abandon();
                    self.feed.again();
                    self.preview.paused = true;
                    self.say(
                        "The picture was left behind and the preview is paused: change the graph, then resume it.",
                    );
                }
            }
        }
        for wish in asked {
            match wish {
                inspector::Wish::Browse(node, port) => {
                    self.dialog = Some(Dialog::Path(PathDialog::new(Purpose::Picture { node, port }, "")));
                }
                inspector::Wish::Say(text) => self.say(text),
                inspector::Wish::Enter(node) => self.enter(&node),
            }
        }
    }

    pub(super) fn bottom(&mut self, ui: &mut Ui) {
        // The panel keeps the height that it was given.
        ui.set_min_height(ui.available_height());
        ui.horizontal(|ui| {
            let errors = self.feed.found.len();
            ui.selectable_value(&mut self.page, Page::Text, "WGSL");
            let title = if errors > 0 { format!("Problems ({errors})") } else { "Problems".to_owned() };
            ui.selectable_value(&mut self.page, Page::Problems, title);
            ui.selectable_value(&mut self.page, Page::Cost, "Cost and accuracy");
        });
        ui.separator();
        match self.page {
            Page::Problems => {
                if let Some(wanted) = problems::show(ui, &self.feed.found)
                    && let Some(node) = wanted.place.node
                {
                    let file = wanted.place.span.as_ref().map(|s| s.source.name.clone()).or(wanted.place.file);
                    if let Some(i) =
                        self.tabs.iter().position(|t| file.as_deref().is_some_and(|f| t.key() == Path::new(f)))
                    {
                        self.active = i;
                    }
                    self.go_to(&node);
                }
            }
            Page::Text => {
                let selected = self.tab().and_then(|t| t.only().map(str::to_owned));
                let clicked = self.pane.show(ui, &self.feed.shaders, selected.as_deref(), self.settings.dark);
                if let Some(full) = clicked {
                    let known =
                        self.tab().and_then(|t| t.graph().nodes.keys().find(|n| super::code::same(&full, n)).cloned());
                    match known {
                        Some(node) => {
                            self.last_selected = Some(node.clone());
                            self.go_to(&node);
                        }
                        None => self.say(format!("that line comes from `{full}`, which is in another graph")),
                    }
                }
            }
            Page::Cost => {
                for wish in self.cost.show(ui, &self.feed, &self.preview) {
                    self.cost_wish(wish);
                }
            }
        }
    }

    fn cost_wish(&mut self, wish: cost::Wish) {
        match wish {
            cost::Wish::Measure(light) => {
                if let Some(shown) = self.shown().and_then(|i| self.tabs.get(i)) {
                    self.feed.measure(&self.tabs, shown, &self.preview, &self.node_folders, light);
                }
            }
            cost::Wish::Cancel => {
                self.feed.engine.cancel();
                self.feed.measuring = false;
            }
            cost::Wish::Use { light, kind } => self.use_shadow(&light, &kind),
        }
    }

    pub(super) fn center(&mut self, ui: &mut Ui) {
        self.crumbs(ui);
        let thumbnails: BTreeMap<String, egui::TextureId> =
            self.feed.thumbnails.iter().map(|(node, texture)| (node.clone(), texture.id())).collect();
        let none = BTreeMap::new();
        let Self { tabs, active, catalog, library, feed, settings, .. } = self;
        let Some(tab) = tabs.get_mut(*active) else { return };
        let key = tab.key().to_path_buf();
        let around = Surroundings {
            catalog,
            subgraphs: &|path| library.get(&key, path),
            wiring: feed.wiring_of(&key),
            problems: &feed.problems_of(&key),
            costs: if self.costs { &feed.costs } else { &none },
            thumbnails: self.thumbnails.then_some(&thumbnails),
            grid: if settings.snap { 10.0 } else { 0.0 },
            minimap: settings.minimap,
        };
        let (response, wishes) = canvas::show(ui, tab, &around);
        self.canvas = response.rect;
        self.canvas_has_pointer = response.contains_pointer();
        self.canvas_id = Some(response.id);
        if tab.graph().nodes.is_empty() {
            let text = "Press Space or right-click to add a node.\nCtrl+Shift+O opens an example.";
            ui.painter().text(
                response.rect.center(),
                egui::Align2::CENTER_CENTER,
                text,
                egui::FontId::proportional(16.0),
                theme::Look::of(ui.visuals()).weak,
            );
        }
        for wish in wishes {
            self.canvas_wish(wish);
        }
    }
}
