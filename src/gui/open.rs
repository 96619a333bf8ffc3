//! Opening, saving and closing graphs; subgraphs; what other programs do to files.

use std::path::{Path, PathBuf};

use super::app::Editor;
use super::dialogs::{Answer, Dialog, Purpose};
use super::files::discard;
use super::library::plain;
use super::tab::Tab;
use crate::diagnostic::{Diagnostic, SourceText, has_errors};
use crate::graph::{self, Edit, Graph};
use crate::scene::{Environment, FileReference};
use crate::semantic::Value;
use crate::studio::figure::{self, Form};
use crate::studio::load::root_name;
use crate::studio::{Shown, write};
use crate::view::{self, Document};

/// Columns and rows of the picture in a figure.
const FIGURE: (u32, u32) = (960, 640);

impl Editor {
    pub(super) fn add_tab(&mut self, graph: Graph, path: Option<PathBuf>) {
        self.counter += 1;
        self.tabs.push(Tab::new(graph, path, self.counter));
        self.active = self.tabs.len() - 1;
    }

    /// Opens a graph, or a scene to show graphs in.
    pub(super) fn open(&mut self, path: &Path) {
        if let Some(i) = self.tabs.iter().position(|t| t.path.as_deref().is_some_and(|p| plain(p) == plain(path))) {
            self.active = i;
            return;
        }
        let text = match std::fs::read_to_string(path) {
            Ok(text) => text,
            Err(error) => return self.say(format!("cannot read {}: {error}", path.display())),
        };
        if root_name(&text) == "Scene" {
            return self.open_scene(path, &text);
        }
        match read(path, &text) {
            Ok((graph, found)) => {
                // A first graph takes the place of the empty one that the editor starts with.
                if let [only] = &self.tabs[..]
                    && only.path.is_none()
                    && only.graph().nodes.is_empty()
                    && !only.document.is_changed()
                {
                    self.tabs.clear();
                }
                self.add_tab(graph, Some(path.to_path_buf()));
                if let Some(tab) = self.tab_mut() {
                    tab.on_disk = Some(text);
                }
                self.settings.opened(path);
                if let Some(first) = found.first() {
                    self.say(format!("{}: {}", path.display(), first.message));
                }
            }
            Err(found) => self.refuse(path, found),
        }
    }

    /// Shows what is wrong with a file that cannot be opened.
    fn refuse(&mut self, path: &Path, found: Vec<Diagnostic>) {
        let first = found.first().map_or_else(String::new, |d| {
            let place =
                d.place.span.as_ref().map(|s| s.line_column()).map_or_else(String::new, |(l, c)| format!("{l}:{c}: "));
            format!("{place}{}", d.message)
        });
        self.say(format!("cannot open {}: {first}", path.display()));
        self.feed.found = found;
        self.show_problems();
    }

    /// Shows a scene, and opens the graphs that it mentions.
    fn open_scene(&mut self, path: &Path, text: &str) {
        let source = SourceText::new(path.display().to_string(), text);
        let (scene, found) = crate::scene::read(&source);
        let Some(scene) = scene.filter(|_| !has_errors(&found)) else { return self.refuse(path, found) };
        self.preview.scene = Some(path.to_path_buf());
        self.preview.camera = None;
        self.settings.opened(path);
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut graphs: Vec<PathBuf> = Vec::new();
        let lights = scene.lights.iter().map(|l| &l.graph.path);
        for mentioned in lights.chain(scene.objects.iter().map(|o| &o.surface.path)) {
            let full = plain(&folder.join(mentioned));
            if !graphs.contains(&full) {
                graphs.push(full);
            }
        }
        for graph in graphs.iter().take(24) {
            self.open(graph);
        }
        self.active = 0;
        self.say(format!("showing {}; changes to its graphs are seen in it", path.display()));
    }

    /// Writes a graph to its file; asks for one where it has none.
    pub(super) fn save(&mut self, index: usize) {
        let Some(path) = self.tabs.get(index).and_then(|t| t.path.clone()) else {
            self.active = index;
            let start = self.tabs.get(index).map_or_else(String::new, |t| t.key().display().to_string());
            self.dialog = Some(Dialog::Path(super::dialogs::PathDialog::new(Purpose::SaveAs, start)));
            return;
        };
        self.save_to(index, &path);
    }

    /// Writes a graph. False where that failed; then nothing has changed.
    pub(super) fn save_to(&mut self, index: usize, path: &Path) -> bool {
        let Some(tab) = self.tabs.get_mut(index) else { return false };
        let text = tab.document.text();
        if let Err(failure) = write(path, text.as_bytes()) {
            self.say(format!("not saved: {failure}"));
            return false;
        }
        if let Some(recovery) = &self.recovery {
            recovery.forget(tab.key());
        }
        tab.path = Some(path.to_path_buf());
        tab.on_disk = Some(text);
        tab.document.mark_saved();
        tab.recovered = tab.document.revision();
        self.settings.opened(path);
        self.say(format!("saved {}", path.display()));
        true
    }

    pub(super) fn close(&mut self, index: usize) {
        match self.tabs.get(index) {
            Some(tab) if tab.document.is_changed() => self.dialog = Some(Dialog::Close(index)),
            Some(_) => self.drop_tab(index),
            None => {}
        }
    }

    fn drop_tab(&mut self, index: usize) {
        if index >= self.tabs.len() {
            return;
        }
        let tab = self.tabs.remove(index);
        if let Some(recovery) = &self.recovery {
            recovery.forget(tab.key());
        }
        if self.active > index || self.active >= self.tabs.len() {
            self.active = self.active.saturating_sub(1);
        }
        if self.tabs.is_empty() {
            self.add_tab(Graph::default(), None);
        }
    }

    /// Reads the file of the graph again. What was here stays open under a name of its own if it was changed.
    pub(super) fn reload(&mut self) {
        let Some(path) = self.tab().and_then(|t| t.path.clone()) else { return self.say("this graph has no file yet") };
        self.take_theirs(&path);
    }

    fn take_theirs(&mut self, path: &Path) {
        let Some(index) = self.tabs.iter().position(|t| t.path.as_deref() == Some(path)) else { return };
        let text = match std::fs::read_to_string(path) {
            Ok(text) => text,
            Err(error) => return self.say(format!("cannot read {}: {error}", path.display())),
        };
        match read(path, &text) {
            Ok((graph, _)) => {
                if self.tabs[index].document.is_changed() {
                    let mine = self.tabs[index].graph().clone();
                    self.keep_aside(mine);
                }
                let tab = &mut self.tabs[index];
                tab.document = Document::new(graph);
                tab.recovered = tab.document.revision();
                tab.on_disk = Some(text);
                tab.cards = Default::default();
                tab.tidy();
                self.active = index;
            }
            Err(found) => self.refuse(path, found),
        }
    }

    /// Opens a graph that belongs to no file, marked as changed.
    fn keep_aside(&mut self, graph: Graph) {
        let active = self.active;
        self.add_tab(Graph::default(), None);
        let replaced = self.tabs.last_mut().is_some_and(|tab| {
            let edit = view::replace(tab.document.graph(), &graph);
            edit.is_some_and(|edit| tab.document.change("Keep aside", edit).is_ok())
        });
        if !replaced && let Some(tab) = self.tabs.last_mut() {
            *tab = Tab::new(graph, None, self.counter);
        }
        self.active = active;
    }

    /// Looks whether other programs have changed files.
    pub(super) fn notice_changes(&mut self) {
        let mut changed = Vec::new();
        for tab in &self.tabs {
            let (Some(path), Some(known)) = (&tab.path, &tab.on_disk) else { continue };
            let Ok(text) = std::fs::read_to_string(path) else { continue };
            if text != *known {
                changed.push((path.clone(), text, tab.document.is_changed()));
            }
        }
        for (path, text, mine) in changed {
            if mine {
                self.dialog = Some(Dialog::Changed(path));
                return;
            }
            if read(&path, &text).is_ok() {
                let active = self.active;
                self.take_theirs(&path);
                self.active = active;
                self.say(format!("{} was changed on disk and read again", path.display()));
            } else if let Some(tab) = self.tabs.iter_mut().find(|t| t.path.as_ref() == Some(&path)) {
                // Said once; the graph stays as it was.
                tab.on_disk = Some(text);
                self.say(format!(
                    "{} was changed on disk, but cannot be read as a graph; the last good one stays",
                    path.display()
                ));
            }
        }
    }

    /// Opens the graph that a node stands for.
    pub(super) fn enter(&mut self, node: &str) {
        let Some(tab) = self.tab() else { return };
        let Some(inner) = tab.graph().nodes.get(node).and_then(|n| n.graph.clone()) else {
            return self.say(format!("`{node}` is no subgraph"));
        };
        let outer = tab.key().to_path_buf();
        let path = plain(&outer.parent().unwrap_or(Path::new("")).join(inner));
        self.open(&path);
        if let Some(tab) = self.tab_mut()
            && plain(tab.key()) == path
        {
            tab.outer = Some((outer, node.to_owned()));
        }
    }

    pub(super) fn leave(&mut self) {
        let Some((key, node)) = self.tab().and_then(|t| t.outer.clone()) else { return };
        if let Some(i) = self.tabs.iter().position(|t| t.key() == key) {
            self.active = i;
            self.go_to(&node);
        }
    }

    /// Moves the selected nodes into a file of their own.
    fn make_subgraph(&mut self, path: &Path) {
        let Some(tab) = self.tab() else { return };
        let folder = tab.key().parent().unwrap_or(Path::new("")).to_path_buf();
        let mentioned = relative_to(&folder, path);
        let title = path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().replace('_', " "));
        match view::make_subgraph(tab.graph(), &self.catalog, &tab.selection, &mentioned, &title) {
            Ok((edit, inner, node)) => {
                // The file comes first: a node without its file would be broken.
                if let Err(failure) = write(path, graph::write(&inner).as_bytes()) {
                    return self.say(format!("not made: {failure}"));
                }
                if self.change("Make subgraph", edit)
                    && let Some(tab) = self.tab_mut()
                {
                    tab.select(&node);
                }
            }
            Err(why) => self.say(why),
        }
    }

    /// Does what a person answered to a dialog.
    pub(super) fn answer(&mut self, ctx: &eframe::egui::Context, dialog: Dialog, answer: Answer) {
        match answer {
            Answer::Cancel => {}
            Answer::Path(purpose, path) => self.path_chosen(purpose, &path),
            Answer::SaveAndClose(index) => match self.tabs.get(index).and_then(|t| t.path.clone()) {
                Some(path) if self.save_to(index, &path) => self.drop_tab(index),
                Some(_) => {}
                None => self.save(index),
            },
            Answer::CloseAnyway(index) => self.drop_tab(index),
            Answer::SaveAllAndQuit => {
                for i in 0..self.tabs.len() {
                    if !self.tabs[i].document.is_changed() {
                        continue;
                    }
                    match self.tabs[i].path.clone() {
                        Some(path) if self.save_to(i, &path) => {}
                        Some(_) => return,
                        None => return self.save(i),
                    }
                }
                self.quit(ctx);
            }
            Answer::QuitAnyway => self.quit(ctx),
            Answer::KeepMine(path) => {
                if let Ok(text) = std::fs::read_to_string(&path) {
                    if let Ok((theirs, _)) = read(&path, &text) {
                        self.keep_aside(theirs);
                    }
                    if let Some(tab) = self.tabs.iter_mut().find(|t| t.path.as_ref() == Some(&path)) {
                        tab.on_disk = Some(text);
                    }
                }
            }
            Answer::TakeTheirs(path) => self.take_theirs(&path),
            Answer::Recover => {
                if let Dialog::Recover(lost) = dialog {
                    self.recover(&lost);
                }
            }
            Answer::DiscardLost => {
                if let Dialog::Recover(lost) = dialog {
                    discard(&lost);
                }
            }
            Answer::Example(path) => self.open(&path),
            Answer::Run(command) => self.run(ctx, command),
        }
    }

    /// Opens what an earlier run left behind, as changes to the files that they belong to.
    fn recover(&mut self, lost: &[super::files::Lost]) {
        for one in lost {
            let name = one.path.clone().unwrap_or_else(|| "recovered.ron".into());
            let Ok((graph, _)) = read(&name, &one.text) else {
                self.say(format!("{} could not be recovered", name.display()));
                continue;
            };
            if let Some(path) = &one.path
                && let Ok(text) = std::fs::read_to_string(path)
                && let Ok((saved, _)) = read(path, &text)
            {
                self.tabs.retain(|t| t.path.as_ref() != Some(path));
                self.add_tab(saved, Some(path.clone()));
                let changed = self.tabs.last_mut().is_some_and(|tab| {
                    tab.on_disk = Some(text);
                    let edit = view::replace(tab.document.graph(), &graph);
                    edit.is_some_and(|edit| tab.document.change("Recover", edit).is_ok())
                });
                if !changed {
                    self.keep_aside(graph);
                }
            } else {
                self.keep_aside(graph);
                self.active = self.tabs.len() - 1;
            }
        }
        // Kept in this run's own folder before the old one is let go.
        self.keep_unsaved();
        discard(lost);
    }

    /// Draws tree, code and picture of the graph in the background.
    fn figure(&mut self, path: &Path) {
        let Some(tab) = self.tab() else { return };
        let Some(form) = Form::of(path) else { return self.say("name the figure .svg or .png") };
        let wanted = figure::Request {
            files: vec![tab.key().to_path_buf()],
            scene: self.preview.scene.clone(),
            shape: self.preview.shape.clone(),
            camera: self.preview.camera,
            size: FIGURE,
            form,
        };
        let overlay = self.tabs.iter().map(|t| (t.key().to_path_buf(), t.document.text().into())).collect();
        self.feed.engine.figure(wanted, overlay, self.node_folders.clone(), path.to_path_buf());
        self.say(format!("drawing {}", path.display()));
    }

    fn path_chosen(&mut self, purpose: Purpose, path: &Path) {
        match purpose {
            Purpose::Open => self.open(path),
            Purpose::SaveAs => {
                self.save_to(self.active, path);
            }
            Purpose::Scene => match std::fs::read_to_string(path) {
                Ok(text) if root_name(&text) == "Scene" => {
                    self.preview.scene = Some(path.to_path_buf());
                    self.preview.camera = None;
                }
                Ok(_) => self.say(format!("{} is not a scene", path.display())),
                Err(error) => self.say(format!("cannot read {}: {error}", path.display())),
            },
            Purpose::Model => {
                self.preview.shape = Shown::Obj(path.to_path_buf());
                (self.preview.scene, self.preview.camera) = (None, None);
            }
            Purpose::Surroundings => {
                let name = path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
                let full = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
                let image = FileReference::new(full.display().to_string());
                self.preview.around = Some((name, Environment::Image { image, rotation: 0.0, intensity: 1.0 }));
            }
            Purpose::Figure => self.figure(path),
            Purpose::Subgraph => self.make_subgraph(path),
            Purpose::Picture { node, port } => {
                let folder = self.tab().and_then(|t| t.key().parent().map(Path::to_path_buf)).unwrap_or_default();
                let value = Some(Value::Text(relative_to(&folder, path)));
                self.change("Choose picture", Edit::SetParam { node, param: port, value });
            }
        }
    }
}

/// A graph, or what is wrong with it.
fn read(path: &Path, text: &str) -> Result<(Graph, Vec<Diagnostic>), Vec<Diagnostic>> {
    let (graph, found) = graph::read(&SourceText::new(path.display().to_string(), text));
    match graph {
        Some(graph) if !has_errors(&found) => Ok((graph, found)),
        _ => Err(found),
    }
}

/// A path as a file in `folder` mentions it: with `/`, and from there where that is short.
fn relative_to(folder: &Path, path: &Path) -> String {
    let full = |p: &Path| {
        let p = if p.as_os_str().is_empty() { Path::new(".") } else { p };
        std::fs::canonicalize(p).unwrap_or_else(|_| plain(p))
    };
    let parent = path.parent().unwrap_or(Path::new(""));
    let (from, to) = (full(folder), full(parent).join(path.file_name().unwrap_or_default()));
    let common = from.components().zip(to.components()).take_while(|(a, b)| a == b).count();
    let up = from.components().count() - common;
    if up > 6 || common == 0 {
        return to.display().to_string();
    }
    let mut parts: Vec<String> = vec!["..".into(); up];
    parts.extend(to.components().skip(common).map(|c| c.as_os_str().to_string_lossy().into_owned()));
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_said_from_where_they_are_mentioned() {
        let folder = tempfile::tempdir().expect("a folder");
        let root = folder.path();
        std::fs::create_dir_all(root.join("a/b")).expect("made");
        std::fs::create_dir_all(root.join("c")).expect("made");
        assert_eq!(relative_to(&root.join("a"), &root.join("a/b/x.ron")), "b/x.ron");
        assert_eq!(relative_to(&root.join("a/b"), &root.join("c/x.png")), "../../c/x.png");
        assert_eq!(relative_to(&root.join("a"), &root.join("a/x.ron")), "x.ron");
    }
}
