//! The searchable list that nodes, kinds, commands and places in a graph are picked from, by keyboard or pointer.

use eframe::egui::{self, Align2, Id, Key, Pos2, RichText, Vec2};

/// What a row stands for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Row {
    /// What is given back when it is picked.
    pub(super) value: String,
    pub(super) title: String,
    /// Beside the title, weaker.
    pub(super) aside: String,
    /// What it is for.
    pub(super) about: String,
}

/// An open list.
pub(super) struct Finder {
    pub(super) title: String,
    pub(super) query: String,
    at: Option<Pos2>,
    chosen: usize,
    fresh: bool,
    shown_for: Option<String>,
    rows: Vec<Row>,
}

/// What became of it this frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    Open,
    Closed,
    Picked(String),
}

/// Most rows that are offered at once.
const MOST: usize = 200;

impl Finder {
    pub(super) fn new(title: impl Into<String>, at: Option<Pos2>) -> Self {
        Self {
            title: title.into(),
            query: String::new(),
            at,
            chosen: 0,
            fresh: true,
            shown_for: None,
            rows: Vec::new(),
        }
    }

    /// Shows the list; `search` gives the rows for a query, best first.
    pub(super) fn show(&mut self, ctx: &egui::Context, search: impl FnOnce(&str) -> Vec<Row>) -> Outcome {
        if self.shown_for.as_ref() != Some(&self.query) {
            self.rows = search(&self.query);
            self.rows.truncate(MOST);
            self.chosen = 0;
            self.shown_for = Some(self.query.clone());
        }
        let (mut up, mut down, mut enter, mut escape) = (false, false, false, false);
        ctx.input_mut(|i| {
            up = i.consume_key(egui::Modifiers::NONE, Key::ArrowUp);
            down = i.consume_key(egui::Modifiers::NONE, Key::ArrowDown);
            enter = i.consume_key(egui::Modifiers::NONE, Key::Enter);
            escape = i.consume_key(egui::Modifiers::NONE, Key::Escape);
        });
        if escape {
            return Outcome::Closed;
        }
        if down {
            self.chosen = (self.chosen + 1).min(self.rows.len().saturating_sub(1));
        }
        if up {
            self.chosen = self.chosen.saturating_sub(1);
        }
        if enter && let Some(row) = self.rows.get(self.chosen) {
            return Outcome::Picked(row.value.clone());
        }
        let mut outcome = Outcome::Open;
        let screen = ctx.content_rect();
        let size = Vec2::new(380.0, 420.0);
        let mut window = egui::Window::new(&self.title)
            .id(Id::new("finder"))
            .title_bar(false)
            .resizable(false)
            .collapsible(false)
            .order(egui::Order::Foreground)
            .fixed_size(size);
        window = match self.at {
            Some(at) => window.fixed_pos(at.min(screen.max - size - Vec2::splat(24.0)).max(screen.min)),
            None => window.anchor(Align2::CENTER_TOP, Vec2::new(0.0, 70.0)),
        };
        let shown = window.show(ctx, |ui| {
            let label = ui.strong(&self.title);
            let field = ui
                .add(egui::TextEdit::singleline(&mut self.query).hint_text("Search").desired_width(f32::INFINITY))
                .labelled_by(label.id);
            if std::mem::take(&mut self.fresh) || !field.has_focus() {
                field.request_focus();
            }
            ui.separator();
            egui::ScrollArea::vertical().auto_shrink([false, false]).max_height(310.0).show(ui, |ui| {
                for (i, row) in self.rows.iter().enumerate() {
                    let on = i == self.chosen;
                    let text = RichText::new(&row.title).strong();
                    let response = ui.horizontal(|ui| {
                        let response = ui.selectable_label(on, text);
                        ui.weak(&row.aside);
                        response
                    });
                    if on && (up || down) {
                        response.inner.scroll_to_me(None);
                    }
                    if response.inner.on_hover_text(&row.about).clicked() {
                        outcome = Outcome::Picked(row.value.clone());
                    }
                }
                if self.rows.is_empty() {
                    ui.weak("Nothing fits.");
                }
            });
            ui.separator();
            let about = self.rows.get(self.chosen).map_or("", |row| row.about.as_str());
            ui.add(egui::Label::new(RichText::new(about).weak()).truncate());
        });
        // A press beside it closes it.
        if let Some(shown) = shown
            && outcome == Outcome::Open
            && ctx.input(|i| {
                i.pointer.any_pressed() && i.pointer.interact_pos().is_some_and(|p| !shown.response.rect.contains(p))
            })
        {
            return Outcome::Closed;
        }
        outcome
    }
}
