//! Values, choices and remarks of what is selected; of the graph where nothing is.

use eframe::egui::{self, Id, RichText, Ui};

use super::canvas::Subgraphs;
use super::tab::Tab;
use super::values;
use crate::diagnostic::Diagnostic;
use crate::graph::{Edit, EditError, End, check_name};
use crate::node::Catalog;
use crate::view::{NodeView, PortView, compatible_kinds, expose, swap_kind, unexpose};

/// What the inspector asks of the rest of the editor.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Wish {
    /// Choose a file for this port of this node.
    Browse(String, String),
    /// Say this to the person.
    Say(String),
    /// Open the file that this node stands for.
    Enter(String),
}

/// Text that is being typed, and applied when it is done.
#[derive(Default)]
pub(super) struct Drafts {
    name: Option<(String, String)>,
    /// Put the cursor into the name.
    pub(super) focus_name: bool,
}

#[allow(clippy::too_many_arguments, reason = "what is shown, and what it is looked up in")]
pub(super) fn show(
    ui: &mut Ui,
    tab: &mut Tab,
    drafts: &mut Drafts,
    catalog: &Catalog,
    subgraphs: Subgraphs<'_>,
    problems: &[Diagnostic],
) -> Vec<Wish> {
    let mut wishes = Vec::new();
    let mut edits: Vec<Done> = Vec::new();
    if let Some(name) = tab.only().map(str::to_owned) {
        let graph = tab.document.graph();
        let view = tab.cards.view(graph, catalog, subgraphs, &name);
        node(ui, tab, drafts, catalog, &name, &view, problems, &mut edits, &mut wishes);
    } else if tab.selection.len() > 1 {
        many(ui, tab, &mut edits);
    } else if let Some((from, to)) = tab.link.clone() {
        link(ui, tab, &from, &to, &mut edits);
    } else if let Some(frame) = tab.frame.clone() {
        frame_edit(ui, tab, &frame, &mut edits);
    } else {
        graph(ui, tab, catalog, subgraphs, &mut edits, &mut wishes);
    }
    for done in edits {
        let result = match &done.key {
            Some(key) => tab.document.gesture(&done.label, key, done.edit),
            None => tab.document.change(&done.label, done.edit),
        };
        if let Err(error) = result {
            wishes.push(Wish::Say(EditError::to_string(&error)));
        }
        if done.ends {
            tab.document.end_gesture();
        }
    }
    wishes
}

/// A change that a widget asks for.
struct Done {
    label: String,
    /// What the gesture is, where more of it may follow.
    key: Option<String>,
    edit: Edit,
    ends: bool,
}

impl Done {
    fn step(label: impl Into<String>, edit: Edit) -> Self {
        Self { label: label.into(), key: None, edit, ends: true }
    }

    fn part(label: impl Into<String>, key: String, edit: Edit) -> Self {
        Self { label: label.into(), key: Some(key), edit, ends: false }
    }
}

#[allow(clippy::too_many_arguments, reason = "what is shown, and what it is looked up in")]
fn node(
    ui: &mut Ui,
    tab: &Tab,
    drafts: &mut Drafts,
    catalog: &Catalog,
    name: &str,
    view: &NodeView,
    problems: &[Diagnostic],
    edits: &mut Vec<Done>,
    wishes: &mut Vec<Wish>,
) {
    let graph = tab.graph();
    let Some(node) = graph.nodes.get(name) else { return };
    name_edit(ui, drafts, name, edits, wishes, |new| graph.nodes.contains_key(new));
    ui.horizontal(|ui| {
        let kinds = if view.subgraph.is_none() { compatible_kinds(graph, catalog, name) } else { Vec::new() };
        let shown = view.subgraph.clone().unwrap_or_else(|| node.kind.clone());
        let label = ui.label("Kind");
        if view.subgraph.is_some() {
            ui.monospace(shown);
            if ui.button("Open").clicked() {
                wishes.push(Wish::Enter(name.to_owned()));
            }
        } else {
            let combo = egui::ComboBox::from_id_salt("kind").selected_text(&shown).width(190.0).height(360.0).show_ui(
                ui,
                |ui| {
                    for kind in &kinds {
                        let label = catalog
                            .get(kind)
                            .and_then(|f| f.header().ok())
                            .map_or_else(String::new, |h| h.label.clone());
                        if ui.selectable_label(*kind == node.kind, kind).on_hover_text(label).clicked()
                            && *kind != node.kind
                        {
                            edits.push(Done::step(format!("Swap for {kind}"), swap_kind(graph, catalog, name, kind)));
                        }
                    }
                },
            );
            combo.response.labelled_by(label.id).on_hover_text("Another kind in its place; its links stay");
        }
    });
    ui.horizontal(|ui| {
        let mut muted = node.muted;
        if ui.checkbox(&mut muted, "Muted").on_hover_text("Pass it over").changed() {
            edits.push(Done::step(if muted { "Mute" } else { "Unmute" }, Edit::SetMuted(name.to_owned(), muted)));
        }
        let mut collapsed = graph.collapsed.contains(name);
        if ui.checkbox(&mut collapsed, "Collapsed").changed() {
            edits.push(Done::step("Collapse", Edit::SetCollapsed(name.to_owned(), collapsed)));
        }
        let mut output = graph.output.as_ref().is_some_and(|o| o.node == name);
        if ui.checkbox(&mut output, "Output").on_hover_text("What the graph exports").changed() {
            edits.push(Done::step("Set output", Edit::SetOutput(output.then(|| End::node(name)))));
        }
    });
    for problem in problems {
        ui.colored_label(super::theme::Look::of(ui.visuals()).error, &problem.message);
        if let Some(help) = &problem.help {
            ui.weak(help);
        }
    }
    if !view.known {
        ui.colored_label(
            super::theme::Look::of(ui.visuals()).warning,
            "This kind of node is not known here. It is kept as it is.",
        );
    }
    ui.separator();
    for (option, choice) in &view.options {
        ui.horizontal(|ui| {
            let label = ui.label(&option.name).on_hover_text(&option.doc);
            let combo =
                egui::ComboBox::from_id_salt(("option", &option.name)).selected_text(choice).show_ui(ui, |ui| {
                    for offered in &option.choices {
                        if ui.selectable_label(offered == choice, offered).clicked() && offered != choice {
                            let value = (*offered != option.default).then(|| offered.clone());
                            let edit = Edit::SetOption { node: name.to_owned(), option: option.name.clone(), value };
                            edits.push(Done::step(format!("Set {}", option.name), edit));
                        }
                    }
                });
            combo.response.labelled_by(label.id).on_hover_text(&option.doc);
            if *choice != option.default
                && ui.small_button("↺").on_hover_text(format!("Back to {}", option.default)).clicked()
            {
                let edit = Edit::SetOption { node: name.to_owned(), option: option.name.clone(), value: None };
                edits.push(Done::step(format!("Reset {}", option.name), edit));
            }
        });
    }
    if !view.options.is_empty() {
        ui.separator();
    }
    for port in view.inputs.iter().filter(|p| !p.hidden) {
        parameter(ui, name, port, &port.label, edits, wishes);
    }
    exposing(ui, tab, name, view, edits);
    if let Some(wgsl) = &node.wgsl {
        ui.separator();
        let label = ui.label("WGSL");
        let mut text = wgsl.clone();
        let response =
            ui.add(egui::TextEdit::multiline(&mut text).code_editor().desired_rows(8).desired_width(f32::INFINITY));
        if response.labelled_by(label.id).changed() {
            edits.push(Done::part("Edit WGSL", format!("wgsl {name}"), Edit::SetWgsl(name.to_owned(), Some(text))));
        }
    }
    ui.separator();
    note(
        ui,
        "Remark",
        &node.note,
        |text| Done::part("Edit remark", format!("note {name}"), Edit::SetNodeNote(name.to_owned(), text)),
        edits,
    );
    if !view.doc.is_empty() {
        ui.collapsing("About", |ui| ui.label(&view.doc));
    }
}

/// A line for a value: its name, its widget, and the way back to the default.
pub(super) fn parameter(
    ui: &mut Ui,
    node: &str,
    port: &PortView,
    shown: &str,
    edits: &mut Vec<impl From<Parameter>>,
    wishes: &mut Vec<Wish>,
) {
    let about =
        if port.doc.is_empty() { port.ty.meaning.to_string() } else { format!("{}\n{}", port.doc, port.ty.meaning) };
    let label = ui.horizontal(|ui| {
        let text = if port.value.is_some() { RichText::new(shown).strong() } else { RichText::new(shown) };
        let label = ui.label(text).on_hover_text(about);
        if port.linked {
            ui.weak("linked");
        } else if port.value.is_some() && ui.small_button("↺").on_hover_text("Back to the default").clicked() {
            edits.push(
                Parameter { node: node.to_owned(), port: port.name.clone(), value: None, going_on: false }.into(),
            );
        } else if let (None, Some(crate::node::Default::Source(source))) = (&port.value, &port.default) {
            ui.weak(format!("from @{source}"));
        }
        label.id
    });
    if port.linked {
        return;
    }
    ui.indent(("value", node, &port.name), |ui| {
        let changed = values::edit(ui, port, label.inner);
        if let Some(value) = changed.value {
            edits.push(
                Parameter {
                    node: node.to_owned(),
                    port: port.name.clone(),
                    value: Some(value),
                    going_on: changed.going_on,
                }
                .into(),
            );
        }
        if changed.browse {
            wishes.push(Wish::Browse(node.to_owned(), port.name.clone()));
        }
    });
}

/// A value that was changed.
pub(super) struct Parameter {
    node: String,
    port: String,
    value: Option<crate::semantic::Value>,
    going_on: bool,
}

impl From<Parameter> for Done {
    fn from(p: Parameter) -> Self {
        let label = if p.value.is_some() { format!("Set {}", p.port) } else { format!("Reset {}", p.port) };
        let key = format!("set {}.{}", p.node, p.port);
        let edit = Edit::SetParam { node: p.node, param: p.port, value: p.value };
        if p.going_on { Self::part(label, key, edit) } else { Self { label, key: Some(key), edit, ends: true } }
    }
}

fn exposing(ui: &mut Ui, tab: &Tab, name: &str, view: &NodeView, edits: &mut Vec<Done>) {
    ui.collapsing("Exposed to outer graphs", |ui| {
        for port in view.inputs.iter().filter(|p| !p.hidden) {
            let end = End::port(name, &port.name);
            let public =
                tab.graph().expose.inputs.iter().find(|(_, ends)| ends.contains(&end)).map(|(name, _)| name.clone());
            let mut on = public.is_some();
            let shown = match &public {
                Some(public) if *public != port.name => format!("{} as {public}", port.label),
                _ => port.label.clone(),
            };
            if ui.checkbox(&mut on, shown).changed() {
                let edit = match public {
                    Some(_) => unexpose(tab.graph(), name, &port.name),
                    None => expose(tab.graph(), name, &port.name, &port.name),
                };
                edits.push(Done::step(if on { "Expose" } else { "Hide" }, edit));
            }
        }
    });
}

fn name_edit(
    ui: &mut Ui,
    drafts: &mut Drafts,
    name: &str,
    edits: &mut Vec<Done>,
    wishes: &mut Vec<Wish>,
    taken: impl Fn(&str) -> bool,
) {
    if drafts.name.as_ref().is_none_or(|(of, _)| of != name) {
        drafts.name = Some((name.to_owned(), name.to_owned()));
    }
    let Some((_, draft)) = &mut drafts.name else { return };
    ui.horizontal(|ui| {
        let label = ui.label("Name");
        let response = ui
            .add(egui::TextEdit::singleline(draft).desired_width(f32::INFINITY).id(Id::new("node name")))
            .labelled_by(label.id);
        if std::mem::take(&mut drafts.focus_name) {
            response.request_focus();
        }
        if response.lost_focus() && draft != name {
            let new = draft.trim().to_owned();
            if taken(&new) {
                wishes.push(Wish::Say(format!("there is already a node `{new}`")));
                name.clone_into(draft);
            } else if let Err(why) = check_name(&new) {
                wishes.push(Wish::Say(why));
                name.clone_into(draft);
            } else {
                edits.push(Done::step("Rename", Edit::RenameNode(name.to_owned(), new)));
            }
        }
    });
}

fn note(ui: &mut Ui, label: &str, text: &str, done: impl Fn(String) -> Done, edits: &mut Vec<Done>) {
    let label = ui.label(label);
    let mut draft = text.to_owned();
    let response = ui.add(egui::TextEdit::multiline(&mut draft).desired_rows(2).desired_width(f32::INFINITY));
    if response.labelled_by(label.id).changed() {
        edits.push(done(draft));
    }
}

fn many(ui: &mut Ui, tab: &Tab, edits: &mut Vec<Done>) {
    ui.strong(format!("{} nodes", tab.selection.len()));
    let all_muted = tab.selection.iter().all(|n| tab.graph().nodes.get(n).is_some_and(|n| n.muted));
    let mut muted = all_muted;
    if ui.checkbox(&mut muted, "Muted").changed() {
        edits.push(Done::step("Mute", crate::view::set_muted(tab.graph(), &tab.selection, muted)));
    }
}

fn link(ui: &mut Ui, tab: &Tab, from: &End, to: &End, edits: &mut Vec<Done>) {
    ui.strong("Link");
    ui.monospace(format!("{from} -> {to}"));
    if ui.button("Remove").clicked() {
        edits.push(Done::step("Unlink", Edit::Unlink(from.clone(), to.clone())));
    }
    if let Some(link) = tab.graph().links.iter().find(|l| l.from == *from && l.to == *to) {
        let key = format!("note {from} -> {to}");
        note(
            ui,
            "Remark",
            &link.note,
            |text| Done::part("Edit remark", key.clone(), Edit::SetLinkNote(from.clone(), to.clone(), text)),
            edits,
        );
    }
}

fn frame_edit(ui: &mut Ui, tab: &Tab, name: &str, edits: &mut Vec<Done>) {
    let Some(frame) = tab.graph().frames.get(name) else { return };
    ui.strong("Frame");
    let mut title = name.to_owned();
    let label = ui.label("Title");
    let response = ui.add(egui::TextEdit::singleline(&mut title).desired_width(f32::INFINITY)).labelled_by(label.id);
    if response.changed() && !title.is_empty() && !tab.graph().frames.contains_key(&title) {
        edits.push(Done::part("Rename frame", "rename frame".into(), Edit::RenameFrame(name.to_owned(), title)));
    }
    let set = |frame: crate::graph::Frame| Edit::SetFrame(name.to_owned(), Some(Box::new(frame)));
    note(
        ui,
        "Text",
        &frame.text,
        |text| {
            Done::part("Edit comment", format!("frame text {name}"), set(crate::graph::Frame { text, ..frame.clone() }))
        },
        edits,
    );
    ui.horizontal(|ui| {
        ui.label("Colour");
        let mut rgb = frame.color.unwrap_or([0.3; 3]).map(super::preview::narrow);
        if ui.color_edit_button_rgb(&mut rgb).changed() {
            let color = Some(rgb.map(|c| (f64::from(c) * 1e3).round() / 1e3));
            edits.push(Done::part(
                "Colour frame",
                format!("frame color {name}"),
                set(crate::graph::Frame { color, ..frame.clone() }),
            ));
        }
        if ui.button("Remove frame").clicked() {
            edits.push(Done::step("Remove frame", Edit::SetFrame(name.to_owned(), None)));
        }
    });
}

/// The graph itself, and the values that it exposes.
fn graph(
    ui: &mut Ui,
    tab: &mut Tab,
    catalog: &Catalog,
    subgraphs: Subgraphs<'_>,
    edits: &mut Vec<Done>,
    wishes: &mut Vec<Wish>,
) {
    let graph = tab.document.graph();
    let label = ui.label("Title of the graph");
    let mut title = graph.name.clone();
    if ui.add(egui::TextEdit::singleline(&mut title).desired_width(f32::INFINITY)).labelled_by(label.id).changed() {
        edits.push(Done::part("Edit title", "title".into(), Edit::SetName(title)));
    }
    note(ui, "Remark", &graph.note, |text| Done::part("Edit remark", "graph note".into(), Edit::SetNote(text)), edits);
    ui.horizontal(|ui| {
        let label = ui.label("Output");
        let shown = graph.output.as_ref().map_or_else(|| "what nothing follows".to_owned(), ToString::to_string);
        let combo = egui::ComboBox::from_id_salt("graph output").selected_text(shown).show_ui(ui, |ui| {
            if ui.selectable_label(graph.output.is_none(), "what nothing follows").clicked() {
                edits.push(Done::step("Set output", Edit::SetOutput(None)));
            }
            for name in graph.nodes.keys().take(200) {
                if ui.selectable_label(graph.output.as_ref().is_some_and(|o| o.node == *name), name).clicked() {
                    edits.push(Done::step("Set output", Edit::SetOutput(Some(End::node(name)))));
                }
            }
        });
        combo.response.labelled_by(label.id);
    });
    ui.weak(format!("{} nodes, {} links", graph.nodes.len(), graph.links.len()));
    if graph.expose.inputs.is_empty() {
        return;
    }
    ui.separator();
    ui.strong("Exposed values");
    for (public, ends) in graph.expose.inputs.clone() {
        let Some(End { node, port: Some(port) }) = ends.first() else { continue };
        let view = tab.cards.view(tab.document.graph(), catalog, subgraphs, node);
        if let Some(port) = view.inputs.iter().find(|p| p.name == *port) {
            parameter(ui, node, port, &public, edits, wishes);
        }
    }
}
