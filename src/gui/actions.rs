//! What commands do.

use eframe::egui::{self, Event, Modifiers, ViewportCommand, vec2};

use super::app::{Editor, Page, Wanted};
use super::canvas::{ZOOM, bounds_of, position};
use super::command::{Command, Needs};
use super::dialogs::{Dialog, Gallery, PathDialog, Purpose};
use super::finder::Finder;
use crate::graph::{Edit, End};
use crate::preview::Look;
use crate::view::{self, How};

/// How far a nudge moves nodes.
const NUDGE: f64 = 10.0;

impl Editor {
    /// Runs the commands whose keys were pressed. Keys without Ctrl or Alt belong to a text that is being typed, where
    /// there is one.
    pub(super) fn keys(&mut self, ctx: &egui::Context) {
        let typing = ctx.text_edit_focused();
        let focused = ctx.memory(|m| m.focused());
        let elsewhere = focused.is_some() && focused != self.canvas_id;
        let canvas = self.canvas_has_pointer;
        let mut run = Vec::new();
        ctx.input_mut(|input| {
            // More modifiers first, so that Ctrl+Shift+Z is not taken for Ctrl+Z.
            let mut keys: Vec<_> = Command::ALL.iter().flat_map(|c| c.keys().iter().map(move |k| (*c, *k))).collect();
            keys.sort_by_key(|(_, k)| std::cmp::Reverse(weight(k.modifiers)));
            for (command, key) in keys {
                let plain = !key.modifiers.command && !key.modifiers.alt;
                if typing && (plain || takes_text(command)) {
                    continue;
                }
                // Keys that work a widget belong to the one that has the focus.
                if elsewhere && plain && works_widgets(key.logical_key) {
                    continue;
                }
                // Tab walks through the widgets except over the canvas.
                if key.logical_key == egui::Key::Tab && plain && !canvas {
                    continue;
                }
                if input.consume_shortcut(&key) {
                    run.push(command);
                }
            }
        });
        if !typing {
            let events = ctx.input(|i| i.events.clone());
            for event in events {
                match event {
                    Event::Copy => run.push(Command::Copy),
                    Event::Cut => run.push(Command::Cut),
                    Event::Paste(text) => self.paste(&text),
                    _ => {}
                }
            }
        }
        for command in run {
            if self.can(command) {
                self.run(ctx, command);
            }
        }
    }

    /// Makes one step of the history and says why where it cannot be made.
    pub(super) fn change(&mut self, label: &str, edit: Edit) -> bool {
        let Some(tab) = self.tab_mut() else { return false };
        match tab.document.change(label, edit) {
            Ok(()) => true,
            Err(error) => {
                self.say(error.to_string());
                false
            }
        }
    }

    pub(super) fn run(&mut self, ctx: &egui::Context, command: Command) {
        if !self.can(command) {
            let why = match command.needs() {
                Needs::Selection | Needs::Anything => "select a node first",
                Needs::Link => "select a link first",
                Needs::Undo | Needs::Redo => "there is nothing to take back",
                Needs::Document | Needs::Nothing => "open a graph first",
            };
            return self.say(format!("{}: {why}", command.label()));
        }
        match command {
            Command::New => self.add_tab(crate::graph::Graph::default(), None),
            Command::Open => self.ask_path(Purpose::Open, "graphs/"),
            Command::Gallery => self.dialog = Some(Dialog::Gallery(Gallery::find())),
            Command::Save => self.save(self.active),
            Command::SaveAs => self.ask_path(Purpose::SaveAs, ""),
            Command::Reload => self.reload(),
            Command::Figure => self.ask_path(Purpose::Figure, ""),
            Command::Close => self.close(self.active),
            Command::Quit if self.tabs.iter().any(|t| t.document.is_changed()) => self.dialog = Some(Dialog::Quit),
            Command::Quit => self.quit(ctx),
            Command::Undo | Command::Redo => self.step(command == Command::Redo),
            Command::Cut | Command::Copy => self.copy(ctx, command == Command::Cut),
            Command::Paste => {
                let text = self.clipboard.clone();
                self.paste(&text);
            }
            Command::Duplicate | Command::DuplicateLinked => self.duplicate(command == Command::DuplicateLinked),
            Command::Delete | Command::DeleteHeal => self.delete(command == Command::DeleteHeal),
            Command::SelectAll | Command::SelectNone | Command::SelectUpstream => self.select(command),
            Command::Find => self.finder = Some((Wanted::Find, Finder::new("Find node", None))),
            Command::Add => self.add_in_middle(),
            Command::Rename => {
                self.settings.side = true;
                self.drafts.focus_name = true;
            }
            Command::Swap => {
                if let Some(node) = self.tab().and_then(|t| t.only()).map(str::to_owned) {
                    let title = format!("Swap {node} for");
                    self.finder = Some((Wanted::Swap(node), Finder::new(title, None)));
                }
            }
            Command::Mute | Command::Collapse | Command::SetOutput => self.switch(command),
            Command::Look => self.look_at_selected(),
            Command::Subgraph => self.ask_path(Purpose::Subgraph, ""),
            Command::Enter => {
                if let Some(node) = self.tab().and_then(|t| t.only()).map(str::to_owned) {
                    self.enter(&node);
                }
            }
            Command::Leave => self.leave(),
            Command::Pin | Command::Bend => self.link_command(command),
            Command::Frame => self.frame(),
            Command::ArrangeAll => {
                if let Some(tab) = self.tab() {
                    let places = tab.cards.arranged(tab.graph());
                    let moves = places.into_iter().map(|(name, place)| Edit::Move(name, Some(place))).collect();
                    self.change("Arrange", Edit::Batch(moves));
                    self.show_all();
                }
            }
            Command::AlignLeft => self.align(How::Left),
            Command::AlignTop => self.align(How::Top),
            Command::AlignCenterX => self.align(How::CenterX),
            Command::AlignCenterY => self.align(How::CenterY),
            Command::DistributeX => self.align(How::DistributeX),
            Command::DistributeY => self.align(How::DistributeY),
            Command::MoveLeft => self.nudge([-NUDGE, 0.0]),
            Command::MoveRight => self.nudge([NUDGE, 0.0]),
            Command::MoveUp => self.nudge([0.0, -NUDGE]),
            Command::MoveDown => self.nudge([0.0, NUDGE]),
            Command::Snap => self.settings.snap = !self.settings.snap,
            Command::FrameSelection | Command::FrameAll => self.fit(command == Command::FrameSelection),
            Command::NextNode | Command::PreviousNode => self.walk(command == Command::NextNode),
            Command::ZoomIn | Command::ZoomOut => {
                let factor = if command == Command::ZoomIn { 1.25 } else { 0.8 };
                if let Some(tab) = self.tab_mut() {
                    tab.camera.zoom = (tab.camera.zoom * factor).clamp(*ZOOM.start(), *ZOOM.end());
                }
            }
            Command::Minimap => self.settings.minimap = !self.settings.minimap,
            Command::Thumbnails => self.thumbnails = !self.thumbnails,
            Command::CostOverlay => self.costs = !self.costs,
            Command::Outline => self.settings.outline = !self.settings.outline,
            Command::Bottom => self.settings.bottom = !self.settings.bottom,
            Command::Side => self.settings.side = !self.settings.side,
            Command::Pause => self.preview.paused = !self.preview.paused,
            Command::NextTab => self.active = (self.active + 1) % self.tabs.len().max(1),
            Command::Theme => {
                self.settings.dark = !self.settings.dark;
                self.apply_look(ctx);
            }
            Command::Larger | Command::Smaller => {
                let factor = if command == Command::Larger { 1.1 } else { 1.0 / 1.1 };
                self.settings.scale = (self.settings.scale * factor).clamp(0.6, 2.5);
                self.apply_look(ctx);
            }
            Command::NodeHelp => self.node_help(),
            Command::Shortcuts => self.dialog = Some(Dialog::Shortcuts),
            Command::Commands => self.finder = Some((Wanted::Command, Finder::new("All commands", None))),
            Command::Welcome => self.dialog = Some(Dialog::Welcome),
        }
    }

    fn ask_path(&mut self, purpose: Purpose, start: &str) {
        let key = self.tab().map(|t| t.key().to_path_buf()).unwrap_or_default();
        let start = match purpose {
            Purpose::SaveAs => key.display().to_string(),
            Purpose::Figure => key.with_extension("svg").display().to_string(),
            Purpose::Subgraph => key.with_file_name("part.ron").display().to_string(),
            _ => start.to_owned(),
        };
        self.dialog = Some(Dialog::Path(PathDialog::new(purpose, start)));
    }

    fn step(&mut self, forward: bool) {
        let Some(tab) = self.tab_mut() else { return };
        let label = if forward { tab.document.redo() } else { tab.document.undo() };
        tab.tidy();
        if let Some(label) = label {
            self.say(format!("{}: {label}", if forward { "Did again" } else { "Took back" }));
        }
    }

    fn copy(&mut self, ctx: &egui::Context, cut: bool) {
        let Some(tab) = self.tab() else { return };
        if tab.selection.is_empty() {
            return;
        }
        let text = view::copy(tab.graph(), &tab.selection);
        ctx.copy_text(text.clone());
        self.clipboard = text;
        if cut {
            self.delete(false);
        }
    }

    pub(super) fn paste(&mut self, text: &str) {
        let middle = self.tab().map(|t| position(t.camera.center));
        let Some(tab) = self.tab_mut() else { return };
        match view::paste(tab.graph(), text, middle) {
            Ok((edit, new)) => {
                if self.change("Paste", edit)
                    && let Some(tab) = self.tab_mut()
                {
                    tab.selection = new;
                }
            }
            Err(found) => self.say(
                found.first().map_or_else(|| "nothing to paste".to_owned(), |d| format!("cannot paste: {}", d.message)),
            ),
        }
    }

    fn duplicate(&mut self, keep_inputs: bool) {
        let Some(tab) = self.tab() else { return };
        let (edit, new) = view::duplicate(tab.graph(), &tab.selection, keep_inputs);
        if self.change("Duplicate", edit)
            && let Some(tab) = self.tab_mut()
        {
            tab.selection = new;
        }
    }

    fn delete(&mut self, heal: bool) {
        let Some(tab) = self.tab() else { return };
        if !tab.selection.is_empty() {
            let edit = view::delete(tab.graph(), &tab.selection, heal);
            self.change("Delete", edit);
        } else if let Some((from, to)) = tab.link.clone() {
            self.change("Unlink", Edit::Unlink(from, to));
        } else if let Some(frame) = tab.frame.clone() {
            self.change("Remove frame", Edit::SetFrame(frame, None));
        }
    }

    fn select(&mut self, command: Command) {
        let Some(tab) = self.tab_mut() else { return };
        match command {
            Command::SelectAll => tab.selection = tab.graph().nodes.keys().cloned().collect(),
            Command::SelectUpstream => tab.selection = tab.upstream(),
            _ => {
                tab.selection.clear();
                tab.link = None;
                tab.frame = None;
            }
        }
    }

    fn add_in_middle(&mut self) {
        let Some(tab) = self.tab() else { return };
        let at = position(tab.camera.center);
        self.finder = Some((
            Wanted::Add { at, wire: None },
            Finder::new("Add node", Some(self.canvas.center() - vec2(190.0, 210.0))),
        ));
    }

    fn switch(&mut self, command: Command) {
        let Some(tab) = self.tab() else { return };
        let (graph, chosen) = (tab.graph(), &tab.selection);
        let (label, edit) = match command {
            Command::Mute => {
                let all = chosen.iter().all(|n| graph.nodes.get(n).is_some_and(|n| n.muted));
                (if all { "Unmute" } else { "Mute" }, view::set_muted(graph, chosen, !all))
            }
            Command::Collapse => {
                let all = chosen.iter().all(|n| graph.collapsed.contains(n));
                (if all { "Expand" } else { "Collapse" }, view::set_collapsed(graph, chosen, !all))
            }
            _ => match tab.only() {
                Some(node) => ("Set output", Edit::SetOutput(Some(End::node(node)))),
                None => return,
            },
        };
        self.change(label, edit);
    }

    fn look_at_selected(&mut self) {
        let Some(tab) = self.tab() else { return };
        let Some(node) = tab.only() else { return };
        let look = Look::Node { graph: tab.key().to_path_buf(), node: node.to_owned(), port: None };
        self.preview.look =
            if self.preview.look == look { Look::Output(crate::compile::Output::Radiance) } else { look };
    }

    fn link_command(&mut self, command: Command) {
        let Some(tab) = self.tab() else { return };
        let Some((from, to)) = tab.link.clone() else { return };
        if command == Command::Pin {
            let Self { tabs, active, feed, .. } = self;
            let Some(tab) = tabs.get_mut(*active) else { return };
            if let Err(why) = tab.pin(feed.wiring_of(tab.key()), &from, &to) {
                self.say(why);
            }
            return;
        }
        let graph = tab.graph();
        let middle = |name: &str| tab.cards.rect(graph, name).center();
        let between = middle(&from.node) + (middle(&to.node) - middle(&from.node)) * 0.5;
        let mut bends = graph.waypoints.get(&(from.clone(), to.clone())).cloned().unwrap_or_default();
        bends.push(position(between));
        self.change("Bend link", Edit::SetWaypoints(from, to, bends));
    }

    fn frame(&mut self) {
        let Some(tab) = self.tab() else { return };
        let (graph, first) = settled(tab);
        let (mut edit, name) = view::frame(&graph, &tab.selection, &|n| tab.cards.size_of(&graph, n));
        // An empty frame is a comment in the middle of what is seen.
        if tab.selection.is_empty()
            && let Edit::SetFrame(_, Some(frame)) = &mut edit
        {
            frame.at = position(tab.camera.center - vec2(120.0, 60.0));
        }
        if self.change("Frame", Edit::Batch(vec![first, edit]))
            && let Some(tab) = self.tab_mut()
        {
            tab.selection.clear();
            tab.frame = Some(name);
        }
    }

    fn align(&mut self, how: How) {
        let Some(tab) = self.tab() else { return };
        let (graph, first) = settled(tab);
        let edit = view::align(&graph, &tab.selection, &|n| tab.cards.size_of(&graph, n), how);
        self.change("Align", Edit::Batch(vec![first, edit]));
    }

    fn nudge(&mut self, by: [f64; 2]) {
        let Some(tab) = self.tab_mut() else { return };
        // What has no place in the file gets the one that it is seen at.
        let moves = tab.selection.iter().map(|name| {
            let place = position(tab.cards.rect(tab.document.graph(), name).min);
            Edit::Move(name.clone(), Some([place[0] + by[0], place[1] + by[1]]))
        });
        let edit = Edit::Batch(moves.collect());
        let _ = tab.document.gesture("Nudge", "nudge", edit);
    }

    fn show_all(&mut self) {
        if let Some(tab) = self.tab_mut() {
            tab.fitted = false;
        }
    }

    fn fit(&mut self, selection: bool) {
        let size = self.canvas.size();
        let Some(tab) = self.tab_mut() else { return };
        let what = match selection && !tab.selection.is_empty() {
            true => bounds_of(tab, tab.selection.iter()),
            false => tab.cards.bounds(tab.document.graph()),
        };
        if let Some(what) = what {
            tab.camera.fit(what, size);
        }
    }

    /// Selects the node after or before the selected one, along the links; the first one where none is selected.
    fn walk(&mut self, forward: bool) {
        let Some(tab) = self.tab() else { return };
        let graph = tab.graph();
        let next = match tab.selection.iter().next() {
            Some(now) => {
                let mut along = graph.links.iter().filter_map(|l| {
                    let (a, b) = if forward { (&l.from.node, &l.to.node) } else { (&l.to.node, &l.from.node) };
                    (a == now).then_some(b)
                });
                along.next().cloned().or_else(|| {
                    // At the end of the links, the next by name.
                    let mut names: Vec<&String> = graph.nodes.keys().collect();
                    if !forward {
                        names.reverse();
                    }
                    let place = names.iter().position(|n| *n == now)?;
                    names.get((place + 1) % names.len()).map(|n| (*n).clone())
                })
            }
            None => graph.nodes.keys().next().cloned(),
        };
        if let Some(next) = next {
            self.go_to(&next);
        }
    }

    fn node_help(&mut self) {
        let Some(tab) = self.tab() else { return };
        let kind = tab.selection.iter().next().and_then(|n| tab.graph().nodes.get(n)).map(|n| n.kind.clone());
        let Some(kind) = kind else { return self.say("select a node first") };
        match self.catalog.get(&kind).and_then(|f| f.definition(&Default::default()).ok()) {
            Some(definition) => self.dialog = Some(Dialog::Help(kind, crate::node::text(&definition))),
            None => self.say(format!("nothing is known about `{kind}`")),
        }
    }

    /// Links the selected node to another, all ports open.
    pub(super) fn link_selected_to(&mut self, node: &str) {
        let Some(tab) = self.tab() else { return };
        let Some(from) = tab.only() else { return self.say("select the node that the link comes from first") };
        match view::connect(tab.graph(), &self.catalog, &End::node(from), &End::node(node)) {
            Ok(edit) => drop(self.change("Link", edit)),
            Err(why) => self.say(why),
        }
    }

    /// Makes the shadow on a light one of another kind.
    pub(super) fn use_shadow(&mut self, light: &str, kind: &str) {
        let Some(tab) = self.tab() else { return };
        let is_shadow =
            |kind: &str| self.catalog.get(kind).and_then(|f| f.header().ok()).is_some_and(|h| h.category == "shadow");
        let graph = tab.graph();
        let own: Vec<&String> = graph.nodes.iter().filter(|(_, n)| is_shadow(&n.kind)).map(|(name, _)| name).collect();
        let short = light.rsplit('/').next().unwrap_or(light);
        let fed = |shadow: &str| graph.links.iter().any(|l| l.to.node == shadow && l.from.node == short);
        let chosen =
            own.iter().find(|s| fed(s)).or_else(|| own.first().filter(|_| own.len() == 1)).map(|s| (*s).clone());
        match chosen {
            Some(shadow) => {
                let edit = view::swap_kind(graph, &self.catalog, &shadow, kind);
                if self.change(&format!("Swap for {kind}"), edit) {
                    self.say(format!("{shadow} is a {kind} now"));
                }
            }
            None => self.say(format!("the shadow on `{light}` is not in this graph: open the graph of the light")),
        }
    }

    pub(super) fn quit(&mut self, ctx: &egui::Context) {
        self.quits = true;
        ctx.send_viewport_cmd(ViewportCommand::Close);
    }

    /// Shows the page of problems.
    pub(super) fn show_problems(&mut self) {
        self.settings.bottom = true;
        self.page = Page::Problems;
    }
}

/// The graph with a place for every node, and what gives them to those that have none in the file.
fn settled(tab: &super::tab::Tab) -> (crate::graph::Graph, Edit) {
    let mut graph = tab.graph().clone();
    let edit = view::place_missing(&graph, &|n| tab.cards.size_of(tab.graph(), n));
    // Nodes that are there can be moved.
    let _ = crate::graph::apply(&mut graph, edit.clone());
    (graph, edit)
}

/// How many modifiers a key has.
fn weight(m: Modifiers) -> u8 {
    u8::from(m.command) + u8::from(m.shift) + u8::from(m.alt)
}

/// Whether a key works sliders, buttons and lists.
fn works_widgets(key: egui::Key) -> bool {
    use egui::Key;
    matches!(key, Key::ArrowUp | Key::ArrowDown | Key::ArrowLeft | Key::ArrowRight | Key::Space | Key::Enter | Key::Tab)
}

/// Whether a key means something else to a text that is being typed.
fn takes_text(command: Command) -> bool {
    matches!(
        command,
        Command::Undo
            | Command::Redo
            | Command::SelectAll
            | Command::MoveLeft
            | Command::MoveRight
            | Command::MoveUp
            | Command::MoveDown
            | Command::DeleteHeal
    )
}
