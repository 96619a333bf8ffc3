//! From file names to graphs and scenes. Every file that is read is remembered, so that a change can be noticed; a text
//! that is being edited can stand in place of its file.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use super::failure::{Failure, FailureKind};
use super::focus::Focus;
use crate::compile::NamedGraph;
use crate::diagnostic::{Diagnostic, Place, SourceText, Span, has_errors};
use crate::graph::{self, Graph};
use crate::node::Catalog;
use crate::ron::MAX_BYTES;
use crate::scene::{self, Scene};

/// Most node files that folders given by `--nodes` may hold.
const MAX_NODE_FILES: usize = 10_000;
/// Deepest folder below one given by `--nodes`.
const MAX_DEPTH: usize = 16;

/// A file that a person gave, by what its root says it is.
#[derive(Debug)]
pub enum Document {
    /// `Graph(...)`
    Graph(Box<Graph>),
    /// `Scene(...)`
    Scene(Box<Scene>),
}

/// Reads files and collects what is wrong with them.
#[derive(Debug, Default)]
pub struct Loader {
    /// Texts by [`absolute`] path.
    overlay: BTreeMap<PathBuf, Arc<str>>,
    focus: Option<Focus>,
    touched: RefCell<BTreeMap<PathBuf, Option<Stamp>>>,
    found: RefCell<Vec<Diagnostic>>,
    unreadable: Cell<bool>,
}

/// What tells that a file or folder has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp {
    length: u64,
    modified: Option<SystemTime>,
}

impl Stamp {
    /// None where there is nothing.
    pub fn of(path: &Path) -> Option<Self> {
        let meta = std::fs::metadata(path).ok()?;
        // The time of a folder also tells of strangers in it, so what is in it is watched file by file.
        let modified = if meta.is_dir() { None } else { meta.modified().ok() };
        Some(Self { length: if meta.is_dir() { 0 } else { meta.len() }, modified })
    }
}

impl Loader {
    /// A loader for which texts stand in place of the files with these paths, whether there are such files or not. Paths
    /// are compared by what they lead to.
    pub fn with_overlay(overlay: BTreeMap<PathBuf, Arc<str>>) -> Self {
        let overlay = overlay.into_iter().map(|(path, text)| (absolute(&path), text)).collect();
        Self { overlay, ..Self::default() }
    }

    /// The same loader, for which one graph exports one of its nodes, whatever it says itself.
    #[must_use]
    pub fn with_focus(self, focus: Option<Focus>) -> Self {
        Self { focus: focus.map(|f| Focus { graph: absolute(&f.graph), ..f }), ..self }
    }

    /// The graph that exports one of its nodes only.
    pub fn focus(&self) -> Option<&Focus> {
        self.focus.as_ref()
    }

    fn overlaid(&self, path: &Path) -> Option<&Arc<str>> {
        // Looking at the file system is spared where nothing can be found.
        if self.overlay.is_empty() { None } else { self.overlay.get(&absolute(path)) }
    }

    /// Files and folders read so far, or looked for, each as it was just before.
    pub fn touched(&self) -> BTreeMap<PathBuf, Option<Stamp>> {
        self.touched.borrow().clone()
    }

    /// Whether some file could not be read.
    pub fn is_unreadable(&self) -> bool {
        self.unreadable.get()
    }

    fn touch(&self, path: &Path) {
        self.touched.borrow_mut().insert(path.to_path_buf(), Stamp::of(path));
    }

    /// Takes the diagnostics so far.
    pub fn take_found(&self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.found.borrow_mut())
    }

    /// Adds one more.
    pub fn add(&self, diagnostic: Diagnostic) {
        self.found.borrow_mut().push(diagnostic);
    }

    fn keep<T>(&self, (value, found): (Option<T>, Vec<Diagnostic>)) -> Option<T> {
        let failed = has_errors(&found);
        self.found.borrow_mut().extend(found);
        value.filter(|_| !failed)
    }

    /// Reads a file of bytes, at most 64 MiB; `-` is stdin.
    pub fn bytes(&self, path: &Path) -> Result<Vec<u8>, Failure> {
        let name = path.display().to_string();
        let fail = |code, kind, message: String, help: &str| {
            self.unreadable.set(self.unreadable.get() || kind == FailureKind::Unreadable);
            Failure::new(kind, Diagnostic::error(code, message, Place::file(&*name)).help(help))
        };
        let unreadable = |e: std::io::Error| {
            let message = format!("cannot read {name}: {e}");
            fail("ST0501", FailureKind::Unreadable, message, "check the path and its permissions")
        };
        let too_large = || {
            let message = format!("the file is larger than {} MiB", MAX_BYTES >> 20);
            fail("ST0503", FailureKind::Input, message, "split it into subgraphs")
        };
        if let Some(text) = self.overlaid(path) {
            let bytes = text.as_bytes();
            return if bytes.len() > MAX_BYTES { Err(too_large()) } else { Ok(bytes.to_vec()) };
        }
        let mut bytes = Vec::new();
        // One byte more than allowed tells a file that grows, or a device without end, from one that fits.
        let limit = MAX_BYTES as u64 + 1;
        if is_dash(path) {
            std::io::stdin().lock().take(limit).read_to_end(&mut bytes).map_err(unreadable)?;
        } else {
            self.touch(path);
            let meta = std::fs::metadata(path).map_err(unreadable)?;
            if meta.is_dir() {
                let message = format!("{name} is a folder, not a file");
                return Err(fail("ST0502", FailureKind::Unreadable, message, "name the files in it"));
            }
            if meta.len() > MAX_BYTES as u64 {
                return Err(too_large());
            }
            // Room for all of it at once: growing as it is read would hold a device without end twice at its largest.
            let length = if meta.is_file() { meta.len() + 1 } else { limit };
            bytes.reserve_exact(usize::try_from(length.min(limit)).unwrap_or(MAX_BYTES));
            std::fs::File::open(path).and_then(|f| f.take(limit).read_to_end(&mut bytes)).map_err(unreadable)?;
        }
        if bytes.len() > MAX_BYTES { Err(too_large()) } else { Ok(bytes) }
    }

    /// Reads a text.
    pub fn text(&self, path: &Path) -> Result<Arc<SourceText>, Failure> {
        let name = path.display().to_string();
        match String::from_utf8(self.bytes(path)?) {
            Ok(text) => Ok(SourceText::new(name, text)),
            Err(error) => {
                let message = format!("the file is not text: byte {} is not UTF-8", error.utf8_error().valid_up_to());
                Err(vec![Diagnostic::error("ST0504", message, Place::file(name)).help("save it as UTF-8")].into())
            }
        }
    }

    /// Reads a graph or scene, told apart by the name of the root. None if it has errors, which are kept.
    pub fn document(&self, path: &Path) -> Result<Option<Document>, Failure> {
        Ok(self.document_with_text(path)?.1)
    }

    /// As [`Self::document`], with the text that it was read from.
    pub fn document_with_text(&self, path: &Path) -> Result<(Arc<SourceText>, Option<Document>), Failure> {
        let source = self.text(path)?;
        let document = self.document_of(&source, path);
        Ok((source, document))
    }

    /// As [`Self::document`], of a text that was read from there.
    pub fn document_of(&self, source: &Arc<SourceText>, path: &Path) -> Option<Document> {
        match root_name(&source.text) {
            "Scene" => self.keep(scene::read(source)).map(|s| Document::Scene(Box::new(s))),
            // Also for what is neither: the reader of graphs says what is missing.
            _ => self.keep(graph::read(source)).map(|mut g| {
                if let Some(focus) = self.focus.as_ref().filter(|f| f.graph == absolute(path)) {
                    focus.apply(&mut g);
                }
                Document::Graph(Box::new(g))
            }),
        }
    }

    /// The graph with its subgraphs put in place. None if there are errors, which are kept.
    pub fn flatten(&self, graph: &Graph) -> Option<Graph> {
        let load = |path: &str, from: &str| -> Result<(String, Arc<Graph>), Vec<Diagnostic>> {
            let full = relative(path, from);
            let source = self.text(&full).map_err(|f| f.diagnostics)?;
            let (graph, found) = graph::read(&source);
            match graph {
                Some(graph) if !has_errors(&found) => {
                    self.found.borrow_mut().extend(found);
                    Ok((absolute(&full).display().to_string(), Arc::new(graph)))
                }
                _ => Err(found),
            }
        };
        self.keep(graph::expand(graph, &load))
    }

    /// Reads and flattens a graph file under a name. None if it has errors, which are kept.
    /// `mentioned` is where a scene names the file.
    pub fn named_graph(&self, path: &Path, name: &str, mentioned: Option<&Span>) -> Option<NamedGraph> {
        let here = |mut diagnostic: Diagnostic| {
            if let (None, Some(span)) = (&diagnostic.place.span, mentioned) {
                diagnostic.place = Place::span(span.clone());
            }
            diagnostic
        };
        let read = self.document(path);
        let graph = match read {
            Ok(Some(Document::Graph(graph))) => graph,
            Ok(Some(Document::Scene(_))) => {
                let place = Place::file(path.display().to_string());
                let message = format!("{} is a scene, but a graph is needed here", path.display());
                let error = Diagnostic::error("ST0507", message, place).help("name a `Graph(...)` file");
                self.found.borrow_mut().push(here(error));
                return None;
            }
            Ok(None) => return None,
            Err(failure) => {
                self.found.borrow_mut().extend(failure.diagnostics.into_iter().map(here));
                return None;
            }
        };
        let graph = self.flatten(&graph)?;
        Some(NamedGraph { name: name.to_owned(), graph, set: Default::default() })
    }

    /// The catalogue with the nodes of user folders. What is wrong with them is returned apart: it stops nothing.
    pub fn catalog(&self, folders: &[PathBuf]) -> Result<(Catalog, Vec<Diagnostic>), Failure> {
        let mut catalog = Catalog::embedded();
        let mut found = Vec::new();
        for folder in folders {
            let files = self.wgsl_files(folder)?;
            // Libraries first: nodes are checked against them.
            let is_library = |p: &PathBuf| p.parent().and_then(Path::file_name).is_some_and(|n| n == "lib");
            let (libraries, nodes): (Vec<_>, Vec<_>) = files.into_iter().partition(is_library);
            for (path, library) in libraries.iter().map(|p| (p, true)).chain(nodes.iter().map(|p| (p, false))) {
                let name = path.display().to_string();
                match self.text(path) {
                    Ok(source) if library => found.extend(catalog.add_library(&name, &source.text)),
                    Ok(source) => found.extend(catalog.add_file(&name, &source.text)),
                    Err(failure) => found.extend(failure.diagnostics),
                }
            }
        }
        Ok((catalog, found))
    }

    /// The node files in folders, sorted folder by folder.
    pub fn node_files(&self, folders: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
        let mut all = Vec::new();
        for folder in folders {
            all.extend(self.wgsl_files(folder)?);
        }
        Ok(all)
    }

    fn wgsl_files(&self, folder: &Path) -> Result<Vec<PathBuf>, Failure> {
        let mut files = Vec::new();
        let mut open = vec![(folder.to_path_buf(), 0)];
        let mut seen = BTreeSet::new();
        while let Some((folder, depth)) = open.pop() {
            // Links may lead back to where they are.
            if !seen.insert(absolute(&folder)) {
                continue;
            }
            self.touch(&folder);
            let unreadable = |e: std::io::Error| {
                let place = Place::file(folder.display().to_string());
                let diagnostic = Diagnostic::error("ST0501", format!("cannot read the folder: {e}"), place);
                Failure::new(FailureKind::Unreadable, diagnostic.help("--nodes takes a folder of .wgsl files"))
            };
            for entry in std::fs::read_dir(&folder).map_err(unreadable)? {
                let path = entry.map_err(unreadable)?.path();
                if path.is_dir() && depth < MAX_DEPTH {
                    open.push((path, depth + 1));
                } else if path.extension().is_some_and(|e| e == "wgsl") && files.len() < MAX_NODE_FILES {
                    files.push(path);
                }
            }
        }
        files.sort();
        Ok(files)
    }
}

/// A path as a file mentions it, seen from where the program runs.
pub fn relative(path: &str, mentioned_in: &str) -> PathBuf {
    let folder = match Path::new(mentioned_in).parent() {
        Some(folder) if mentioned_in != "-" => folder,
        _ => Path::new(""),
    };
    folder.join(path)
}

/// Whether the path stands for stdin or stdout.
pub fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// One spelling for a path, also for a file that is not there (yet).
pub fn absolute(path: &Path) -> PathBuf {
    if let Ok(full) = std::fs::canonicalize(path) {
        return full;
    }
    let full = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    match (full.parent().map(absolute), full.file_name()) {
        (Some(parent), Some(name)) => parent.join(name),
        _ => full,
    }
}

/// Names for graphs by the stems of their files, each once.
pub fn stems(paths: &[PathBuf]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for path in paths {
        let stem = match path.file_stem() {
            Some(stem) if !is_dash(path) => stem.to_string_lossy().into_owned(),
            _ => "stdin".into(),
        };
        let taken = |name: &String| names.contains(name);
        let name = (2..).map(|n| format!("{stem}_{n}")).find(|n| !taken(n)).filter(|_| taken(&stem));
        names.push(name.unwrap_or(stem));
    }
    names
}

/// The name before the first bracket: what kind of file a text is. Empty if there is none.
pub fn root_name(text: &str) -> &str {
    let mut rest = text.trim_start_matches('\u{feff}').trim_start();
    loop {
        if let Some(after) = rest.strip_prefix("//").or_else(|| rest.strip_prefix("#!")) {
            rest = after.split_once('\n').map_or("", |(_, next)| next).trim_start();
        } else if let Some(after) = rest.strip_prefix("/*") {
            let mut depth = 1;
            let mut at = 0;
            let bytes = after.as_bytes();
            while depth > 0 && at < bytes.len() {
                match (bytes[at], bytes.get(at + 1)) {
                    (b'/', Some(b'*')) => (depth, at) = (depth + 1, at + 2),
                    (b'*', Some(b'/')) => (depth, at) = (depth - 1, at + 2),
                    _ => at += 1,
                }
            }
            rest = after.get(at..).unwrap_or_default().trim_start();
        } else {
            let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            return &rest[..end];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_is_found_behind_comments() {
        assert_eq!(root_name("\u{feff}// a\n/* b /* c */ */ #![enable(x)]\nScene(version: 1)"), "Scene");
        assert_eq!(root_name("  Graph (\n)"), "Graph");
        assert_eq!((root_name(""), root_name("/* open"), root_name("{}")), ("", "", ""));
    }

    #[test]
    fn equal_stems_are_told_apart() {
        let paths = ["a/x.ron", "b/x.ron", "-", "c/x.ron"].map(PathBuf::from);
        assert_eq!(stems(&paths), ["x", "x_2", "stdin", "x_3"]);
    }

    #[test]
    fn texts_stand_in_place_of_files_however_they_are_spelt() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.ron");
        std::fs::write(&path, "old").expect("written");
        let texts = [(path.clone(), "new"), (folder.path().join("unsaved.ron"), "made up")];
        let loader = Loader::with_overlay(texts.into_iter().map(|(p, t)| (p, t.into())).collect());
        let other = folder.path().join(".").join("a.ron");
        assert_eq!(loader.text(&other).expect("there").text, "new");
        assert_eq!(loader.text(&folder.path().join("unsaved.ron")).expect("there").text, "made up");
        assert!(loader.touched().is_empty());
    }

    #[test]
    fn folders_and_missing_files_are_named() {
        let loader = Loader::default();
        let folder = tempfile::tempdir().expect("a folder");
        let failure = loader.bytes(folder.path()).expect_err("a folder");
        assert_eq!((failure.kind, failure.diagnostics[0].code), (FailureKind::Unreadable, "ST0502"));
        let failure = loader.bytes(&folder.path().join("none")).expect_err("missing");
        assert_eq!((failure.kind, failure.diagnostics[0].code), (FailureKind::Unreadable, "ST0501"));
        let binary = folder.path().join("b.ron");
        std::fs::write(&binary, [0xff, 0xfe]).expect("written");
        let failure = loader.text(&binary).expect_err("binary");
        assert_eq!((failure.kind, failure.diagnostics[0].code), (FailureKind::Input, "ST0504"));
    }
}
