//! Nodes and links as a list: the canvas for those who do not see it, and for finding things.

use std::collections::BTreeMap;

use eframe::egui::{self, Ui};

use super::tab::Tab;
use super::theme::Look;
use crate::diagnostic::Diagnostic;
use crate::graph::{Edit, Link, Node};

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
        let Tab { document, selection, frame, link: chosen, .. } = tab;
        let graph = document.graph();
        let fits = |name: &str, kind: &str| {
            wanted.is_empty() || name.to_lowercase().contains(&wanted) || kind.contains(&wanted)
        };
        let names: Vec<(&String, &Node)> = graph.nodes.iter().filter(|(name, node)| fits(name, &node.kind)).collect();
        let links: Vec<&Link> = graph.links.iter().filter(|l| fits(&l.from.node, "") || fits(&l.to.node, "")).collect();
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
                    } else if let Some((name, node)) = names.get(row - 1) {
                        let (name, muted) = (name.as_str(), node.muted);
                        let kind = node.graph.as_ref().unwrap_or(&node.kind);
                        let selected = selection.contains(name);
                        ui.horizontal(|ui| {
                            let shown = if muted { format!("{name} (muted)") } else { name.to_owned() };
                            let mut text = egui::RichText::new(shown);
                            if problems.contains_key(name) {
                                text = text.color(look.error);
                            }
                            let response = ui.selectable_label(selected, text);
                            let told = format!("{name}, {kind}{}", if muted { ", muted" } else { "" });
                            response.widget_info(|| {
                                egui::WidgetInfo::selected(egui::WidgetType::SelectableLabel, true, selected, &told)
                            });
                            if response.clicked() {
                                if ui.input(|i| i.modifiers.command || i.modifiers.shift) {
                                    if !selection.remove(name) {
                                        selection.insert(name.to_owned());
                                    }
                                } else {
                                    wishes.push(Wish::Show(name.to_owned()));
                                }
                            }
                            response.context_menu(|ui| {
                                if ui.button("Link the selected node to it").clicked() {
                                    wishes.push(Wish::Link(name.to_owned()));
                                    ui.close();
                                }
                            });
                            if kind != name {
                                ui.add(egui::Label::new(egui::RichText::new(kind).weak().small()).truncate());
                            }
                        });
                    } else if row == names.len() + 1 {
                        ui.weak(format!("Links ({})", links.len()));
                    } else if let Some(Link { from, to, .. }) = links.get(row - names.len() - 2) {
                        let selected = chosen.as_ref().is_some_and(|(f, t)| f == from && t == to);
                        ui.horizontal(|ui| {
                            if ui.selectable_label(selected, format!("{from} -> {to}")).clicked() {
                                selection.clear();
                                *frame = None;
                                *chosen = Some((from.clone(), to.clone()));
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
