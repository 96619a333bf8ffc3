//! The editor's window: what is open, and the panels around the canvas.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui::{self, Panel, Ui, ViewportCommand};

use super::canvas::Target;
use super::code::Pane;
use super::command::{Command, Needs};
use super::cost;
use super::dialogs::Dialog;
use super::feed::Feed;
use super::files::{Places, Recovery, Settings};
use super::finder::Finder;
use super::inspector::Drafts;
use super::library::Library;
use super::outline::{self, Outline};
use super::preview::Preview;
use super::tab::Tab;
use crate::graph::{End, Graph};
use crate::node::Catalog;
use crate::preview::Engine;
use crate::render::AdapterOptions;
use crate::view::Pending;

/// How the editor starts.
#[derive(Clone, Default)]
pub struct Options {
    /// Graphs to open.
    pub files: Vec<PathBuf>,
    /// A scene to show them in.
    pub scene: Option<PathBuf>,
    /// Folders of nodes.
    pub nodes: Vec<PathBuf>,
    /// All nodes that there are, those of the folders with them.
    pub catalog: Catalog,
    /// Where the preview is rendered.
    pub adapter: AdapterOptions,
    /// Where settings and recovery files are kept; nowhere if none.
    pub places: Option<Places>,
    /// Start with the preview paused.
    pub paused: bool,
}

/// What a list of rows was opened for.
#[derive(Clone, Debug)]
pub(super) enum Wanted {
    Add { at: [f64; 2], wire: Option<Pending> },
    Insert { link: (End, End), at: [f64; 2] },
    Swap(String),
    Find,
    Command,
}

/// The lower panel's pages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Page {
    Problems,
    Text,
    Cost,
}

/// The editor.
pub struct Editor {
    pub(super) catalog: Catalog,
    pub(super) node_folders: Vec<PathBuf>,
    pub(super) tabs: Vec<Tab>,
    pub(super) active: usize,
    pub(super) counter: usize,
    pub(super) feed: Feed,
    pub(super) library: Library,
    pub(super) preview: Preview,
    pub(super) pane: Pane,
    pub(super) outline: Outline,
    pub(super) drafts: Drafts,
    pub(super) cost: cost::Panel,
    pub(super) page: Page,
    pub(super) finder: Option<(Wanted, Finder)>,
    pub(super) dialog: Option<Dialog>,
    pub(super) menu: Option<(Target, egui::Pos2)>,
    pub(super) settings: Settings,
    pub(super) places: Option<Places>,
    pub(super) recovery: Option<Recovery>,
    pub(super) toasts: Vec<(String, Instant)>,
    pub(super) thumbnails: bool,
    pub(super) costs: bool,
    pub(super) quits: bool,
    kept_at: Instant,
    looked_at: Instant,
    /// Where the canvas lies, for commands that put something in its middle.
    pub(super) canvas: egui::Rect,
    pub(super) canvas_has_pointer: bool,
    pub(super) canvas_id: Option<egui::Id>,
    /// Text that was copied, where the system has no clipboard.
    pub(super) clipboard: String,
    pub(super) last_selected: Option<String>,
}

/// How often texts that are not saved are kept.
const KEEP: Duration = Duration::from_secs(2);
/// How often files are looked at for changes by others.
const LOOK: Duration = Duration::from_secs(1);
/// How long a message stays.
const TOAST: Duration = Duration::from_secs(7);

impl Editor {
    /// An editor in a window of its own.
    pub fn new(ctx: &egui::Context, options: Options) -> Self {
        let wake = ctx.clone();
        let engine = Engine::start(options.adapter, Arc::new(move || wake.request_repaint()));
        let settings = options.places.as_ref().map(Places::settings).unwrap_or_default();
        let started = options.places.as_ref().map(Recovery::start);
        let mut toasts = Vec::new();
        let (recovery, lost) = match started {
            Some(Ok((recovery, lost))) => (Some(recovery), lost),
            Some(Err(error)) => {
                toasts.push((format!("changes are not kept against a crash: {error}"), Instant::now()));
                (None, Vec::new())
            }
            None => (None, Vec::new()),
        };
        let mut editor = Self {
            catalog: options.catalog,
            node_folders: options.nodes,
            tabs: Vec::new(),
            active: 0,
            counter: 0,
            feed: Feed::new(engine),
            library: Library::default(),
            preview: Preview { scene: options.scene, paused: options.paused, ..Preview::default() },
            pane: Pane::default(),
            outline: Outline::default(),
            drafts: Drafts::default(),
            cost: cost::Panel::default(),
            page: Page::Text,
            finder: None,
            dialog: None,
            menu: None,
            settings,
            places: options.places,
            recovery,
            toasts,
            thumbnails: false,
            costs: false,
            quits: false,
            kept_at: Instant::now(),
            looked_at: Instant::now(),
            canvas: egui::Rect::ZERO,
            canvas_has_pointer: false,
            canvas_id: None,
            clipboard: String::new(),
            last_selected: None,
        };
        editor.apply_look(ctx);
        for file in &options.files {
            editor.open(file);
        }
        if editor.tabs.is_empty() {
            editor.add_tab(Graph::default(), None);
            if !editor.settings.welcomed && editor.places.is_some() {
                editor.settings.welcomed = true;
                editor.dialog = Some(Dialog::Welcome);
            }
        }
        if !lost.is_empty() {
            editor.dialog = Some(Dialog::Recover(lost));
        }
        editor
    }

    pub(super) fn apply_look(&self, ctx: &egui::Context) {
        ctx.set_theme(if self.settings.dark { egui::Theme::Dark } else { egui::Theme::Light });
        ctx.set_zoom_factor(self.settings.scale);
    }

    pub(super) fn say(&mut self, text: impl Into<String>) {
        let text = text.into();
        self.toasts.retain(|(t, _)| *t != text);
        self.toasts.push((text, Instant::now()));
        if self.toasts.len() > 6 {
            self.toasts.remove(0);
        }
    }

    pub(super) fn tab(&self) -> Option<&Tab> {
        self.tabs.get(self.active)
    }

    pub(super) fn tab_mut(&mut self) -> Option<&mut Tab> {
        self.tabs.get_mut(self.active)
    }

    /// The document that is being edited.
    pub fn document(&self) -> Option<&crate::view::Document> {
        self.tab().map(|t| &t.document)
    }

    /// The graph that the preview shows: the outermost that the active one was opened from.
    pub(super) fn shown(&self) -> Option<usize> {
        let mut index = self.active;
        for _ in 0..crate::graph::MAX_NESTING {
            let Some((outer, _)) = self.tabs.get(index)?.outer.as_ref() else { break };
            match self.tabs.iter().position(|t| t.key() == outer) {
                Some(outer) => index = outer,
                None => break,
            }
        }
        Some(index)
    }

    /// Whether a command makes sense now.
    pub(super) fn can(&self, command: Command) -> bool {
        let tab = self.tab();
        match command.needs() {
            Needs::Nothing => true,
            Needs::Document => tab.is_some(),
            Needs::Selection => tab.is_some_and(|t| !t.selection.is_empty()),
            Needs::Undo => tab.is_some_and(|t| t.document.undo_label().is_some()),
            Needs::Redo => tab.is_some_and(|t| t.document.redo_label().is_some()),
            Needs::Link => tab.is_some_and(|t| t.link.is_some()),
            Needs::Anything => tab.is_some_and(|t| !t.selection.is_empty() || t.link.is_some() || t.frame.is_some()),
        }
    }

    /// Brings a node into view and selects it.
    pub(super) fn go_to(&mut self, node: &str) {
        let size = self.canvas.size();
        let Some(tab) = self.tab_mut() else { return };
        if !tab.graph().nodes.contains_key(node) {
            return;
        }
        tab.select(node);
        let place = tab.cards.rect(tab.graph(), node);
        let seen = egui::Rect::from_center_size(tab.camera.center, size / tab.camera.zoom);
        if !seen.contains_rect(place) {
            tab.camera.center = place.center();
        }
        if tab.camera.zoom < 0.5 {
            tab.camera.zoom = 1.0;
        }
    }

    fn toasts(&mut self, ctx: &egui::Context) {
        self.toasts.retain(|(_, at)| at.elapsed() < TOAST);
        if self.toasts.is_empty() {
            return;
        }
        egui::Area::new(egui::Id::new("messages"))
            .anchor(egui::Align2::CENTER_BOTTOM, [0.0, -16.0])
            .order(egui::Order::Tooltip)
            .interactable(false)
            .show(ctx, |ui| {
                for (text, _) in &self.toasts {
                    egui::Frame::popup(ui.style()).show(ui, |ui| {
                        ui.set_max_width(560.0);
                        ui.label(text);
                    });
                }
            });
        ctx.request_repaint_after(Duration::from_millis(500));
    }

    /// Keeps what is not saved, and notices what others changed.
    fn housekeeping(&mut self, ctx: &egui::Context) {
        if self.kept_at.elapsed() >= KEEP {
            self.kept_at = Instant::now();
            self.keep_unsaved();
        }
        if self.looked_at.elapsed() >= LOOK && self.dialog.is_none() {
            self.looked_at = Instant::now();
            self.notice_changes();
        }
        if self.tabs.iter().any(|t| t.document.is_changed() && t.recovered != t.document.revision()) {
            ctx.request_repaint_after(KEEP);
        } else {
            ctx.request_repaint_after(Duration::from_secs(2));
        }
    }

    /// Writes the texts of changed graphs where a crash does not reach them.
    pub(super) fn keep_unsaved(&mut self) {
        let Some(recovery) = &self.recovery else { return };
        let mut trouble = None;
        for tab in &mut self.tabs {
            if !tab.document.is_changed() {
                if tab.recovered != tab.document.revision() {
                    tab.recovered = tab.document.revision();
                    recovery.forget(tab.key());
                }
            } else if tab.recovered != tab.document.revision() {
                match recovery.keep(tab.key(), tab.path.as_deref(), &tab.document.text()) {
                    Ok(()) => tab.recovered = tab.document.revision(),
                    Err(error) => trouble = Some(error),
                }
            }
        }
        if let Some(error) = trouble {
            self.say(format!("changes are not kept against a crash: {error}"));
        }
    }

    fn ask(&mut self, ctx: &egui::Context) {
        let shown = self.shown();
        let Self { tabs, active, feed, preview, node_folders, .. } = self;
        if preview.plays && !preview.paused {
            preview.time += ctx.input(|i| i.stable_dt).min(0.1);
            ctx.request_repaint();
        }
        if !preview.paused {
            feed.ask(tabs, shown.and_then(|i| tabs.get(i)), preview, node_folders);
        }
        if self.thumbnails
            && let Some(tab) = tabs.get(*active)
        {
            let seen: Vec<String> = tab.graph().nodes.keys().take(200).cloned().collect();
            feed.ask_thumbnails(tab, tabs, preview, node_folders, &seen);
        }
    }
}

impl eframe::App for Editor {
    fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        for text in self.feed.poll(&ctx, &mut self.preview) {
            self.say(text);
        }
        self.library.refresh(&self.tabs, self.active);
        if ctx.input(|i| i.viewport().close_requested()) && !self.quits {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.run(&ctx, Command::Quit);
        }
        if self.dialog.is_none() && self.finder.is_none() {
            self.keys(&ctx);
        }
        Panel::top("menu").show(ui, |ui| self.menus(ui));
        if self.settings.bottom {
            Panel::bottom("bottom")
                .resizable(true)
                .default_size(230.0)
                .size_range(90.0..=600.0)
                .show(ui, |ui| self.bottom(ui));
        }
        if self.settings.side {
            Panel::right("side")
                .resizable(true)
                .default_size(400.0)
                .size_range(260.0..=900.0)
                .show(ui, |ui| self.side(ui));
        }
        if self.settings.outline {
            Panel::left("outline").resizable(true).default_size(190.0).size_range(120.0..=500.0).show(ui, |ui| {
                let Self { tabs, active, outline, feed, .. } = self;
                let Some(tab) = tabs.get_mut(*active) else { return };
                let found = feed.problems_of(tab.key());
                let wishes = outline.show(ui, tab, &found);
                for wish in wishes {
                    match wish {
                        outline::Wish::Show(node) => self.go_to(&node),
                        outline::Wish::Link(node) => self.link_selected_to(&node),
                    }
                }
            });
        }
        egui::CentralPanel::no_frame().show(ui, |ui| self.center(ui));
        self.show_finder(&ctx);
        self.show_menu(&ctx);
        self.show_dialog(&ctx);
        self.toasts(&ctx);
        for tab in &mut self.tabs {
            tab.tidy();
        }
        // The text follows the selection.
        let selected = self.tab().and_then(|t| t.only().map(str::to_owned));
        if selected != self.last_selected {
            if let Some(node) = &selected {
                self.pane.go_to(&self.feed.shaders, node);
            }
            self.last_selected = selected;
        }
        self.ask(&ctx);
        self.housekeeping(&ctx);
        let title = self.tab().map_or_else(|| "shadetree".to_owned(), |t| format!("{} - shadetree", t.title()));
        if ctx.input(|i| i.viewport().title.as_ref() != Some(&title)) {
            ctx.send_viewport_cmd(ViewportCommand::Title(title));
        }
    }

    fn on_exit(&mut self) {
        if let Some(places) = &self.places {
            places.keep(&self.settings);
        }
        if self.quits
            && let Some(recovery) = &self.recovery
        {
            recovery.finish();
        }
    }
}
