//! Questions and lists in windows of their own. Paths can always be typed; the system's file dialog is a help beside it,
//! and runs apart, since it may hang or not be there.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use eframe::egui::{self, Id, Key, RichText, Vec2};

use super::command::{Command, Menu};
use super::files::Lost;

/// What a path is wanted for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    Open,
    SaveAs,
    Scene,
    Model,
    Surroundings,
    Figure,
    Subgraph,
    Picture { node: String, port: String },
}

impl Purpose {
    fn title(&self) -> &'static str {
        match self {
            Self::Open => "Open",
            Self::SaveAs => "Save as",
            Self::Scene => "Show in a scene",
            Self::Model => "Show on a model",
            Self::Surroundings => "Show within a picture",
            Self::Figure => "Export figure",
            Self::Subgraph => "Make subgraph",
            Self::Picture { .. } => "Choose a picture",
        }
    }

    fn saves(&self) -> bool {
        matches!(self, Self::SaveAs | Self::Figure | Self::Subgraph)
    }

    fn kinds(&self) -> &'static [&'static str] {
        match self {
            Self::Open | Self::SaveAs | Self::Scene | Self::Subgraph => &["ron"],
            Self::Model => &["obj"],
            Self::Figure => &["svg", "png"],
            Self::Picture { .. } | Self::Surroundings => &["hdr", "png", "jpg", "jpeg"],
        }
    }
}

/// A window that waits for an answer.
pub(super) enum Dialog {
    /// A path is wanted.
    Path(PathDialog),
    /// A graph that is not saved is to be closed; by its place among the open ones.
    Close(usize),
    /// The editor is to be left with graphs that are not saved.
    Quit,
    /// A file has changed under a graph that was changed here, too.
    Changed(PathBuf),
    /// An earlier run left graphs behind.
    Recover(Vec<Lost>),
    Shortcuts,
    Welcome,
    Gallery(Gallery),
    /// The documentation of a kind of node.
    Help(String, String),
}

/// What a person answered.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Answer {
    Cancel,
    Path(Purpose, PathBuf),
    SaveAndClose(usize),
    CloseAnyway(usize),
    SaveAllAndQuit,
    QuitAnyway,
    KeepMine(PathBuf),
    TakeTheirs(PathBuf),
    Recover,
    DiscardLost,
    Example(PathBuf),
    Run(Command),
}

/// A dialog for a path.
pub(super) struct PathDialog {
    purpose: Purpose,
    text: String,
    browsing: Option<Receiver<Option<PathBuf>>>,
    fresh: bool,
    /// A file that is there already, once a person was told.
    warned: Option<String>,
}

impl PathDialog {
    pub(super) fn new(purpose: Purpose, start: impl Into<String>) -> Self {
        Self { purpose, text: start.into(), browsing: None, fresh: true, warned: None }
    }

    fn show(&mut self, ctx: &egui::Context) -> Option<Answer> {
        let mut answer = None;
        if let Some(receiver) = &self.browsing {
            match receiver.try_recv() {
                Ok(chosen) => {
                    self.browsing = None;
                    if let Some(path) = chosen {
                        return Some(Answer::Path(self.purpose.clone(), path));
                    }
                }
                Err(TryRecvError::Disconnected) => self.browsing = None,
                Err(TryRecvError::Empty) => {}
            }
        }
        modal(ctx, self.purpose.title(), 480.0, |ui| {
            let label = ui.label("Path");
            let field =
                ui.add(egui::TextEdit::singleline(&mut self.text).desired_width(f32::INFINITY)).labelled_by(label.id);
            if std::mem::take(&mut self.fresh) {
                field.request_focus();
            }
            let enter = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
            let text = self.text.trim().to_owned();
            let mut path = PathBuf::from(&text);
            if self.purpose.saves() && path.extension().is_none() && !text.is_empty() {
                path.set_extension(self.purpose.kinds()[0]);
            }
            let there = path.exists();
            let trouble = if text.is_empty() {
                Some("type a path")
            } else if !self.purpose.saves() && !there {
                Some("there is no such file")
            } else if there && path.is_dir() {
                Some("it is a folder")
            } else {
                None
            };
            ui.weak(trouble.map_or_else(|| format!("in {}", folder_of(&path).display()), str::to_owned));
            let replaces = self.purpose.saves() && there && trouble.is_none();
            if replaces {
                ui.label(RichText::new(format!("{} is there already and would be replaced.", path.display())).strong());
            }
            ui.add_space(6.0);
            ui.horizontal(|ui| {
                let word = match (self.purpose.saves(), replaces) {
                    (true, true) => "Replace",
                    (true, false) => "Save",
                    (false, _) => "Open",
                };
                let ok = ui.add_enabled(trouble.is_none(), egui::Button::new(word)).clicked();
                // Replacing takes a second press.
                let entered = enter && trouble.is_none() && (!replaces || self.warned.as_ref() == Some(&text));
                if enter && replaces {
                    self.warned = Some(text.clone());
                    field.request_focus();
                }
                if ok || entered {
                    answer = Some(Answer::Path(self.purpose.clone(), path.clone()));
                }
                if ui.add_enabled(self.browsing.is_none(), egui::Button::new("Browse…")).clicked() {
                    self.browsing = Some(browse(&self.purpose, ctx));
                }
                if ui.button("Cancel").clicked() || ui.input(|i| i.key_pressed(Key::Escape)) {
                    answer = Some(Answer::Cancel);
                }
            });
        });
        answer
    }
}

fn folder_of(path: &Path) -> PathBuf {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    std::fs::canonicalize(folder).unwrap_or_else(|_| folder.to_path_buf())
}

/// The system's file dialog, in a thread of its own.
fn browse(purpose: &Purpose, ctx: &egui::Context) -> Receiver<Option<PathBuf>> {
    let (sender, receiver) = channel();
    let (purpose, ctx) = (purpose.clone(), ctx.clone());
    std::thread::spawn(move || {
        let dialog = rfd::FileDialog::new().set_title(purpose.title()).add_filter(purpose.kinds()[0], purpose.kinds());
        let _ = sender.send(if purpose.saves() { dialog.save_file() } else { dialog.pick_file() });
        ctx.request_repaint();
    });
    receiver
}

/// Example graphs with their pictures.
pub(super) struct Gallery {
    entries: Vec<(PathBuf, String, Option<PathBuf>)>,
    textures: std::collections::BTreeMap<PathBuf, egui::TextureHandle>,
}

impl Gallery {
    /// The examples below the working folder or beside the program.
    pub(super) fn find() -> Self {
        let beside = std::env::current_exe().ok();
        let roots = std::iter::once(PathBuf::new())
            .chain(beside.iter().flat_map(|p| p.ancestors().skip(1).take(4)).map(Path::to_path_buf));
        let root = roots.map(|r| r.join("graphs")).find(|g| g.join("surfaces").is_dir());
        let mut entries = Vec::new();
        for folder in root.iter().flat_map(|root| ["surfaces", "lights", "scenes"].map(|f| root.join(f))) {
            for entry in std::fs::read_dir(&folder).into_iter().flatten().flatten() {
                let path = entry.path();
                if path.extension().is_some_and(|e| e == "ron") {
                    let picture = Some(path.with_extension("png")).filter(|p| p.exists());
                    let stem = path.file_stem().unwrap_or_default().to_string_lossy().replace('_', " ");
                    entries.push((path, stem, picture));
                }
            }
        }
        entries.sort_by(|a, b| (a.2.is_none(), &a.0).cmp(&(b.2.is_none(), &b.0)));
        Self { entries, textures: std::collections::BTreeMap::new() }
    }

    fn show(&mut self, ctx: &egui::Context) -> Option<Answer> {
        let mut answer = None;
        modal(ctx, "Examples", 720.0, |ui| {
            if self.entries.is_empty() {
                ui.label("No examples are installed here. They come with the sources, in the folder `graphs`.");
            }
            egui::ScrollArea::vertical().max_height(480.0).auto_shrink([false, true]).show(ui, |ui| {
                ui.horizontal_wrapped(|ui| {
                    // One picture a frame keeps the window quick while they are read.
                    let mut budget = 2;
                    for (path, stem, picture) in &self.entries {
                        if let Some(picture) = picture
                            && budget > 0
                            && !self.textures.contains_key(path)
                            && let Some(image) = small(picture)
                        {
                            budget -= 1;
                            let texture =
                                ctx.load_texture(format!("example {stem}"), image, egui::TextureOptions::LINEAR);
                            self.textures.insert(path.clone(), texture);
                            ctx.request_repaint();
                        }
                        ui.allocate_ui(Vec2::new(160.0, 118.0), |ui| {
                            ui.vertical(|ui| {
                                ui.set_width(160.0);
                                if let Some(texture) = self.textures.get(path) {
                                    let image = egui::Image::new(texture).fit_to_exact_size(Vec2::new(160.0, 90.0));
                                    if ui.add(image.sense(egui::Sense::click())).clicked() {
                                        answer = Some(Answer::Example(path.clone()));
                                    }
                                }
                                if ui.link(stem).clicked() {
                                    answer = Some(Answer::Example(path.clone()));
                                }
                            });
                        });
                    }
                });
            });
            ui.separator();
            if ui.button("Close").clicked() || ui.input(|i| i.key_pressed(Key::Escape)) {
                answer = Some(Answer::Cancel);
            }
        });
        answer
    }
}

/// A picture of a file, small.
fn small(path: &Path) -> Option<egui::ColorImage> {
    let image = image::open(path).ok()?.thumbnail(320, 180).into_rgba8();
    let size = [image.width() as usize, image.height() as usize];
    Some(egui::ColorImage::from_rgba_unmultiplied(size, image.as_raw()))
}

/// A window over everything else.
fn modal(ctx: &egui::Context, title: &str, width: f32, add: impl FnOnce(&mut egui::Ui)) {
    egui::Modal::new(Id::new("dialog")).show(ctx, |ui| {
        ui.set_width(width.min(ctx.content_rect().width() - 60.0));
        ui.heading(title);
        ui.separator();
        add(ui);
    });
}

impl Dialog {
    /// Shows it. Answers what a person said, once that is so.
    pub(super) fn show(&mut self, ctx: &egui::Context) -> Option<Answer> {
        let mut answer = None;
        let escape = ctx.input(|i| i.key_pressed(Key::Escape));
        match self {
            Self::Path(dialog) => return dialog.show(ctx),
            Self::Gallery(gallery) => return gallery.show(ctx),
            Self::Close(index) => modal(ctx, "Close without saving?", 420.0, |ui| {
                ui.label("This graph has changes that are not in its file.");
                ui.horizontal(|ui| {
                    if ui.button("Save and close").clicked() {
                        answer = Some(Answer::SaveAndClose(*index));
                    }
                    if ui.button("Close anyway").clicked() {
                        answer = Some(Answer::CloseAnyway(*index));
                    }
                    if ui.button("Cancel").clicked() || escape {
                        answer = Some(Answer::Cancel);
                    }
                });
            }),
            Self::Quit => modal(ctx, "Quit without saving?", 420.0, |ui| {
                ui.label("Some graphs have changes that are not in their files.");
                ui.horizontal(|ui| {
                    if ui.button("Save all and quit").clicked() {
                        answer = Some(Answer::SaveAllAndQuit);
                    }
                    if ui.button("Quit anyway").clicked() {
                        answer = Some(Answer::QuitAnyway);
                    }
                    if ui.button("Cancel").clicked() || escape {
                        answer = Some(Answer::Cancel);
                    }
                });
            }),
            Self::Changed(path) => modal(ctx, "Changed on disk", 460.0, |ui| {
                ui.label(format!("{} was changed by another program, and here, too.", path.display()));
                ui.weak("Whichever you take, the other stays open as a graph of its own.");
                ui.horizontal(|ui| {
                    if ui.button("Keep mine").clicked() || escape {
                        answer = Some(Answer::KeepMine(path.clone()));
                    }
                    if ui.button("Take theirs").clicked() {
                        answer = Some(Answer::TakeTheirs(path.clone()));
                    }
                });
            }),
            Self::Recover(lost) => modal(ctx, "Recovered graphs", 460.0, |ui| {
                ui.label("The editor ended before these were saved:");
                for one in lost.iter() {
                    ui.monospace(
                        one.path.as_ref().map_or_else(|| "a new graph".to_owned(), |p| p.display().to_string()),
                    );
                }
                ui.horizontal(|ui| {
                    if ui.button("Open them").clicked() {
                        answer = Some(Answer::Recover);
                    }
                    if ui.button("Throw them away").clicked() {
                        answer = Some(Answer::DiscardLost);
                    }
                    if ui.button("Later").clicked() || escape {
                        answer = Some(Answer::Cancel);
                    }
                });
            }),
            Self::Shortcuts => modal(ctx, "Shortcuts", 720.0, |ui| {
                egui::ScrollArea::vertical()
                    .max_height(460.0)
                    .auto_shrink([false, true])
                    .show(ui, |ui| shortcuts(ui, ctx));
                ui.separator();
                if ui.button("Close").clicked() || escape {
                    answer = Some(Answer::Cancel);
                }
            }),
            Self::Welcome => modal(ctx, "First steps", 520.0, |ui| {
                for step in STEPS {
                    ui.label(*step);
                }
                ui.add_space(6.0);
                ui.horizontal(|ui| {
                    if ui.button("Start with an example").clicked() {
                        answer = Some(Answer::Run(Command::Gallery));
                    }
                    if ui.button("Start empty").clicked() || escape {
                        answer = Some(Answer::Cancel);
                    }
                });
            }),
            Self::Help(title, text) => modal(ctx, title, 560.0, |ui| {
                egui::ScrollArea::vertical().max_height(440.0).show(ui, |ui| ui.monospace(text.as_str()));
                if ui.button("Close").clicked() || escape {
                    answer = Some(Answer::Cancel);
                }
            }),
        }
        answer
    }
}

const STEPS: &[&str] = &[
    "1. Press Space over the canvas (or Shift+A anywhere) and type `spot`: a light is put down.",
    "2. Drag from its title's right edge into the open and pick `variance shadow`: light goes through the shadow.",
    "3. Drag from the shadow's title into the open and pick a surface, such as `glass` or `ggx`.",
    "4. The preview shows it. Select a node to change its values; drag the yellow dot to move the light.",
    "5. Swap the shadow for another kind with Shift+S; undo everything with Ctrl+Z.",
    "",
    "Links name only their nodes unless you draw them between ports: the tool finds the wiring.",
    "Every command and its key: Ctrl+/",
];

fn shortcuts(ui: &mut egui::Ui, ctx: &egui::Context) {
    for (menu, title) in Menu::ALL {
        ui.strong(title);
        egui::Grid::new(("shortcuts", title)).num_columns(3).striped(true).show(ui, |ui| {
            for command in Command::ALL.iter().filter(|c| c.menu() == menu) {
                ui.label(command.label());
                let keys: Vec<String> = command.keys().iter().map(|k| ctx.format_shortcut(k)).collect();
                ui.monospace(keys.join(", "));
                ui.weak(command.help());
                ui.end_row();
            }
        });
        ui.add_space(8.0);
    }
}
