//! Nodes and links as a list: the canvas for those who do not see it, and for finding things.

use std::collections::BTreeMap;

use eframe::egui::{self, Ui};

use super::tab::Tab;
use super::theme::Look;
use crate::diagnostic::Diagnostic;
use crate::graph::{Edit, End};

/// What the outline asks of the rest of the editor.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Wish {
    /// Select this node and bring it into view.
    Show(String),
    /// Link the selected node to this one.
    Link(String),
}

/// State of the outline alone.
#[derive(Default)]
pub(super) struct Outline {
    filter: String,
}

impl Outline {
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        tab: &mut Tab,
        problems: &BTreeMap<String, Vec<Diagnostic>>,
    ) -> Vec<Wish> {
        let mut wishes = Vec::new();
        let look = Look::of(ui.visuals());
        let label = ui.strong("Outline");
        ui.add(egui::TextEdit::singleline(&mut self.filter).hint_text("Filter nodes").desired_width(f32::INFINITY))
            .labelled_by(label.id);
        let wanted = self.filter.to_lowercase();
        let graph = tab.document.graph();
        let fits = |name: &str, kind: &str| {
            wanted.is_empty() || name.to_lowercase().contains(&wanted) || kind.contains(&wanted)
        };
        let names: Vec<(String, String, bool)> = graph
            .nodes
            .iter()
            .filter(|(name, node)| fits(name, &node.kind))
            .map(|(name, node)| (name.clone(), node.graph.clone().unwrap_or_else(|| node.kind.clone()), node.muted))
            .collect();
        let links: Vec<(End, End)> = graph
            .links
            .iter()
            .filter(|l| fits(&l.from.node, "") || fits(&l.to.node, ""))
            .map(|l| (l.from.clone(), l.to.clone()))
            .collect();
        let height = ui.text_style_height(&egui::TextStyle::Body) + 4.0;
        let total = names.len() + links.len() + 2;
        let mut unlink = None;
        egui::ScrollArea::vertical().auto_shrink([false, false]).id_salt("outline").show_rows(
            ui,
            height,
            total,
            |ui, rows| {
                for row in rows {
                    if row == 0 {
                        ui.weak(format!("Nodes ({})", names.len()));
                    } else if let Some((name, kind, muted)) = names.get(row - 1) {
                        let selected = tab.selection.contains(name);
                        ui.horizontal(|ui| {
                            let shown = if *muted { format!("{name} (muted)") } else { name.clone() };
                            let mut text = egui::RichText::new(shown);
                            if problems.contains_key(name) {
                                text = text.color(look.error);
                            }
                            let response = ui.selectable_label(selected, text);
                            let told = format!("{name}, {kind}{}", if *muted { ", muted" } else { "" });
                            response.widget_info(|| {
                                egui::WidgetInfo::selected(egui::WidgetType::SelectableLabel, true, selected, &told)
                            });
                            if response.clicked() {
                                if ui.input(|i| i.modifiers.command || i.modifiers.shift) {
                                    if !tab.selection.remove(name) {
                                        tab.selection.insert(name.clone());
                                    }
                                } else {
                                    wishes.push(Wish::Show(name.clone()));
                                }
                            }
                            response.context_menu(|ui| {
                                if ui.button("Link the selected node to it").clicked() {
                                    wishes.push(Wish::Link(name.clone()));
                                    ui.close();
                                }
                            });
                            if *kind != *name {
                                ui.add(egui::Label::new(egui::RichText::new(kind).weak().small()).truncate());
                            }
                        });
                    } else if row == names.len() + 1 {
                        ui.weak(format!("Links ({})", links.len()));
                    } else if let Some((from, to)) = links.get(row - names.len() - 2) {
                        let selected = tab.link.as_ref().is_some_and(|(f, t)| f == from && t == to);
                        ui.horizontal(|ui| {
                            if ui.selectable_label(selected, format!("{from} -> {to}")).clicked() {
                                tab.selection.clear();
                                tab.frame = None;
                                tab.link = Some((from.clone(), to.clone()));
                            }
                            if selected && ui.small_button("Remove").clicked() {
                                unlink = Some((from.clone(), to.clone()));
                            }
                        });
                    }
                }
            },
        );
        if let Some((from, to)) = unlink {
            let _ = tab.document.change("Unlink", Edit::Unlink(from, to));
        }
        wishes
    }
}
