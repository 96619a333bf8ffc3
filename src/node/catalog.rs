//! All nodes, libraries and passes that there are.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, OnceLock};

use super::definition::{Definition, Header, Item, Library};
use super::file::{self, NodeFile, stem};
use super::header;
use super::pass::PassFile;
use super::report::Report;
use super::tokens::rename;
use crate::diagnostic::{Diagnostic, Place, SourceText, did_you_mean, has_errors};

mod embedded {
    include!(concat!(env!("OUT_DIR"), "/embedded.rs"));
}

/// Nodes, libraries and passes by name. Cheap to clone: files are shared.
#[derive(Clone, Debug, Default)]
pub struct Catalog {
    files: BTreeMap<String, Arc<NodeFile>>,
    libraries: BTreeMap<String, Arc<LibraryFile>>,
    passes: BTreeMap<String, Arc<PassEntry>>,
}

#[derive(Debug)]
struct LibraryFile {
    path: Cow<'static, str>,
    text: Cow<'static, str>,
    read: OnceLock<(Library, Vec<Diagnostic>)>,
}

#[derive(Debug)]
struct PassEntry {
    path: Cow<'static, str>,
    text: Cow<'static, str>,
    read: OnceLock<Result<PassFile, Vec<Diagnostic>>>,
}

impl LibraryFile {
    fn read(&self) -> &(Library, Vec<Diagnostic>) {
        self.read.get_or_init(|| {
            let source = SourceText::new(&*self.path, &*self.text);
            let (header, mut found) = header::parse(&source, false);
            let mut report = Report::new(&source);
            let applied = file::apply(&mut report, &[], &[]);
            for d in applied.declarations.iter().filter(|d| d.entry || matches!(d.keyword, "var" | "override")) {
                let place = applied.kept.original_range(d.name_range.clone());
                report
                    .error("ST0125", place, format!("`{}` cannot stand in a library", d.name))
                    .help("a library holds functions, structs, constants and aliases");
            }
            found.extend(report.found);
            let items = file::items_of(&applied);
            (Library { name: stem(&self.path).to_owned(), uses: header.uses, items }, found)
        })
    }
}

impl Catalog {
    /// What comes with the program. Nothing is read yet; what is read later is shared by all copies.
    pub fn embedded() -> Self {
        static ALL: OnceLock<Catalog> = OnceLock::new();
        ALL.get_or_init(|| {
            let mut catalog = Self::default();
            for &(path, text) in embedded::NODES {
                let file = NodeFile::new(path.into(), text.into(), true);
                catalog.files.insert(file.kind().to_owned(), Arc::new(file));
            }
            for &(path, text) in embedded::LIBRARIES {
                catalog.insert_library(path.into(), text.into());
            }
            for &(path, text) in embedded::SHADERS {
                catalog.insert_pass(path.into(), text.into());
            }
            catalog
        })
        .clone()
    }

    fn insert_library(&mut self, path: Cow<'static, str>, text: Cow<'static, str>) -> Arc<LibraryFile> {
        let file = Arc::new(LibraryFile { path, text, read: OnceLock::new() });
        self.libraries.insert(stem(&file.path).to_owned(), file.clone());
        file
    }

    fn insert_pass(&mut self, path: Cow<'static, str>, text: Cow<'static, str>) {
        let name = stem(&path).to_owned();
        self.passes.insert(name, Arc::new(PassEntry { path, text, read: OnceLock::new() }));
    }

    /// Adds a node file under a name like `folder/kind.wgsl`, verified against the libraries added so far. A file
    /// with errors is left out. One that takes the kind of another replaces it, with a warning.
    pub fn add_file(&mut self, name: &str, text: &str) -> Vec<Diagnostic> {
        let file = NodeFile::new(name.to_owned().into(), text.to_owned().into(), false);
        let mut found = file.verify(self);
        if has_errors(&found) {
            return found;
        }
        if let Some(old) = self.files.get(file.kind()) {
            let whose = if old.is_embedded() { "comes with the program" } else { "was read before" };
            let message = format!("`{}` takes the place of a node that {whose}", file.kind());
            found.push(
                Diagnostic::warning("ST0132", message, Place::file(name)).help("rename the file to have both nodes"),
            );
        }
        self.files.insert(file.kind().to_owned(), Arc::new(file));
        found
    }

    /// Adds a library file. One with errors is left out.
    pub fn add_library(&mut self, name: &str, text: &str) -> Vec<Diagnostic> {
        let source = SourceText::new(name, text);
        if let Some((range, message)) = super::check::guard(text, 1 << 20) {
            let mut report = Report::new(&source);
            report.error("ST0130", range, message).help("split it into shorter functions and statements");
            return report.found;
        }
        let mut trial = self.clone();
        let file = trial.insert_library(name.to_owned().into(), text.to_owned().into());
        let (library, found) = file.read();
        if has_errors(found) {
            return found.clone();
        }
        let mut before = trial.closure(&library.uses);
        before.retain(|l| l.name != library.name);
        let mut report = Report::new(&source);
        let kept = file::apply(&mut report, &[], &[]).kept;
        let found = super::check::check(&before, &kept, &source);
        if !has_errors(&found) {
            *self = trial;
        }
        found
    }

    /// The node file of a kind.
    pub fn get(&self, kind: &str) -> Option<&Arc<NodeFile>> {
        self.files.get(kind)
    }

    /// All kinds, sorted.
    pub fn kinds(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str)
    }

    /// All node files, sorted by kind.
    pub fn files(&self) -> impl Iterator<Item = &Arc<NodeFile>> {
        self.files.values()
    }

    /// The library called `name`.
    pub fn library(&self, name: &str) -> Option<&Library> {
        self.libraries.get(name).map(|l| &l.read().0)
    }

    /// All library names, sorted.
    pub fn library_names(&self) -> impl Iterator<Item = &str> {
        self.libraries.keys().map(String::as_str)
    }

    /// What is wrong with the library called `name`, apart from the bodies of its functions.
    pub fn library_diagnostics(&self, name: &str) -> &[Diagnostic] {
        self.libraries.get(name).map_or(&[], |l| &l.read().1)
    }

    /// The libraries that a definition needs, each after those that it needs itself.
    pub fn libraries_of(&self, definition: &Definition) -> Vec<&Library> {
        self.closure(&definition.header.uses)
    }

    /// The libraries of these names and all that they use, each after those that it needs itself; names that are
    /// not known are passed over, circles are cut.
    pub fn closure(&self, uses: &[String]) -> Vec<&Library> {
        let (mut order, mut seen) = (Vec::new(), BTreeSet::new());
        let mut open: Vec<(&str, bool)> = uses.iter().rev().map(|u| (u.as_str(), false)).collect();
        while let Some((name, ready)) = open.pop() {
            let Some(library) = self.library(name) else {
                continue;
            };
            if ready {
                order.push(library);
            } else if seen.insert(name) {
                open.push((name, true));
                open.extend(library.uses.iter().rev().map(|u| (u.as_str(), false)));
            }
        }
        order
    }

    /// The items of the library called `name` under the names that they take the place of: those that end in the last word
    /// of the library's name are called without it, also where others mention them.
    pub fn variant(&self, name: &str) -> Vec<Item> {
        let suffix = name.rfind('_').map_or("", |at| &name[at..]);
        let base = |word: &str| word.strip_suffix(suffix).map(str::to_owned).filter(|_| !suffix.is_empty());
        let items = self.library(name).map_or(&[][..], |l| &l.items);
        let renamed = |item: &Item| Item {
            name: base(&item.name).unwrap_or_else(|| item.name.clone()),
            text: rename(&item.text, &|word| base(word)),
            mentions: item.mentions.iter().map(|m| base(m).unwrap_or_else(|| m.clone())).collect(),
            offset: item.offset,
        };
        items.iter().map(renamed).collect()
    }

    /// The fixed pass called `name`; `None` if there is none of that name.
    ///
    /// # Errors
    /// What is wrong with its header.
    pub fn pass(&self, name: &str) -> Option<Result<&PassFile, Vec<Diagnostic>>> {
        let entry = self.passes.get(name)?;
        let read = entry.read.get_or_init(|| PassFile::parse(&SourceText::new(&*entry.path, &*entry.text)));
        Some(read.as_ref().map_err(Clone::clone))
    }

    /// Names of all fixed passes, sorted.
    pub fn pass_names(&self) -> impl Iterator<Item = &str> {
        self.passes.keys().map(String::as_str)
    }

    /// The kind that `wanted` was probably meant to be: by its spelling, its label or a synonym.
    pub fn nearest(&self, wanted: &str) -> Option<String> {
        let folded = wanted.to_lowercase().replace([' ', '-'], "_");
        if let Some(kind) = did_you_mean(&folded, self.kinds()) {
            return Some(kind.to_owned());
        }
        let spoken = folded.replace('_', " ");
        let mut names: Vec<(String, &str)> = Vec::new();
        for (kind, header) in self.headers() {
            let all = header.synonyms.iter().chain([&header.label]);
            names.extend(all.map(|n| (n.to_lowercase(), kind)));
        }
        if let Some(near) = did_you_mean(&spoken, names.iter().map(|(n, _)| n.as_str())) {
            return names.iter().find(|(n, _)| n == near).map(|(_, kind)| (*kind).to_owned());
        }
        // One word of a name, as `noise` is of `white_noise`.
        let word = |kind: &str| kind.split('_').any(|w| folded.len() > 3 && did_you_mean(&folded, [w]).is_some());
        self.kinds().find(|kind| word(kind)).map(str::to_owned)
    }

    fn headers(&self) -> impl Iterator<Item = (&str, Arc<Header>)> {
        self.files.iter().filter_map(|(kind, file)| Some((kind.as_str(), file.header().ok()?)))
    }

    /// Node files that have to do with every word of `query`, best first: kind, label, synonym, category, description.
    pub fn search(&self, query: &str) -> Vec<&Arc<NodeFile>> {
        let words: Vec<String> = query.to_lowercase().split_whitespace().take(16).map(str::to_owned).collect();
        let phrase = words.join(" ");
        let mut ranked: Vec<((u8, usize), &str, &Arc<NodeFile>)> = Vec::new();
        for (kind, file) in &self.files {
            let Ok(header) = file.header() else { continue };
            let scores: Option<Vec<usize>> = words.iter().map(|w| score(kind, &header, w)).collect();
            if let Some(scores) = scores {
                // What is called by all the words comes before what has each of them somewhere.
                let label = header.label.to_lowercase();
                let whole = |name: &str| if name == phrase { 0 } else { 1 + u8::from(!name.starts_with(&phrase)) };
                let nearest = whole(&label).min(whole(&kind.replace('_', " ")));
                ranked.push(((nearest, scores.iter().sum()), kind, file));
            }
        }
        ranked.sort_by_key(|(score, kind, _)| (*score, *kind));
        ranked.into_iter().map(|(_, _, file)| file).collect()
    }
}

/// How far a word is from what a node is called; less is better.
fn score(kind: &str, header: &Header, word: &str) -> Option<usize> {
    let label = header.label.to_lowercase();
    let synonyms = || header.synonyms.iter().map(|s| s.to_lowercase());
    let tests = [
        kind == word || label == word,
        label.split_whitespace().any(|w| w == word),
        synonyms().any(|s| s == word),
        kind.starts_with(word) || label.starts_with(word),
        kind.contains(word) || label.contains(word),
        synonyms().any(|s| s.contains(word)),
        header.category == word,
        header.description.to_lowercase().contains(word),
    ];
    tests.iter().position(|t| *t)
}
