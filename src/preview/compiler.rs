//! From a request to a shot, with what need not be done again.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use super::messages::{Look, Request, ShaderText, Shaders, Show};
use crate::compile::{Options, Output};
use crate::cost::{Cost, cost};
use crate::diagnostic::Diagnostic;
use crate::node::Catalog;
use crate::studio::load::{Loader, Stamp};
use crate::studio::weave::{Known, Weaver};
use crate::studio::{Collected, Focus, Shot, Shown, Subject};

/// Most requests whose outcome is kept: that of the picture and those of thumbnails.
const MOST: usize = 128;

/// The catalogue and what it was read from.
struct Shelf {
    files: BTreeMap<PathBuf, Option<Stamp>>,
    folders: Vec<PathBuf>,
    catalog: Arc<Catalog>,
    found: Vec<Diagnostic>,
}

/// What came of a request.
#[derive(Clone)]
pub(super) struct Outcome {
    /// The shot, if nothing was wrong.
    pub(super) shot: Option<Arc<Shot>>,
    /// Everything that was found.
    pub(super) diagnostics: Vec<Diagnostic>,
    /// The nodes that it was woven with.
    pub(super) catalog: Arc<Catalog>,
    /// What each node costs; not told of single nodes.
    cost: BTreeMap<String, Cost>,
    /// How long it took; 0 if it was kept.
    pub(super) milliseconds: f64,
}

/// An outcome and all that it depends on.
struct Kept {
    request: Request,
    touched: BTreeMap<PathBuf, Option<Stamp>>,
    outcome: Outcome,
}

/// Compiles requests.
#[derive(Default)]
pub(super) struct Compiler {
    shelf: Option<Shelf>,
    known: Known,
    kept: Vec<Kept>,
    last_good: Option<(Show, Look, Arc<Shot>)>,
}

impl Compiler {
    /// What comes of a request: from before, if nothing that it depends on has changed.
    pub(super) fn compile(&mut self, request: &Request) -> Outcome {
        let begun = Instant::now();
        let (catalog, found, fresh) = self.catalog(&request.nodes);
        if fresh {
            self.kept.clear();
        }
        let at = self.kept.iter().position(|k| same(&k.request, request));
        if let Some(at) = at {
            let kept = &self.kept[at];
            if kept.touched.iter().all(|(path, stamp)| Stamp::of(path) == *stamp) {
                return Outcome { milliseconds: 0.0, ..kept.outcome.clone() };
            }
            self.kept.remove(at);
        }
        let listener = Collected::default();
        let loader = loader(request);
        let options = Options { output: output(&request.look), ..Options::default() };
        let weaver =
            Weaver { options, images: true, wiring: true, ..Weaver::new(&listener, &loader, &catalog, &self.known) };
        let shot = with_subject(&request.show, |subject| Shot::new(subject, &weaver));
        let mut diagnostics = found;
        diagnostics.extend(listener.take());
        let shot = match shot {
            Ok(shot) => Some(Arc::new(shot)),
            Err(failure) => {
                diagnostics.extend(failure.diagnostics);
                None
            }
        };
        let counted = shot.iter().filter(|_| !matches!(request.look, Look::Node { .. }));
        let cost = counted.fold(BTreeMap::new(), |all, shot| costs(shot, all));
        let milliseconds = begun.elapsed().as_secs_f64() * 1e3;
        let outcome = Outcome { shot, diagnostics, catalog, cost, milliseconds };
        // The newest of its sort takes the place of the one before, and the oldest goes when there is no more room.
        self.kept.retain(|k| (&k.request.show, &k.request.look) != (&request.show, &request.look));
        if self.kept.len() >= MOST {
            self.kept.remove(0);
        }
        self.kept.push(Kept { request: request.clone(), touched: loader.touched(), outcome: outcome.clone() });
        outcome
    }

    /// What can be rendered for a request: its own shot, or while it is broken the last good one of the same sort. Also
    /// whether it is its own.
    pub(super) fn good(&mut self, request: &Request, outcome: &Outcome) -> Option<(Arc<Shot>, bool)> {
        if let Some(shot) = &outcome.shot {
            self.last_good = Some((request.show.clone(), request.look.clone(), shot.clone()));
            return Some((shot.clone(), true));
        }
        let (show, look, shot) = self.last_good.as_ref()?;
        (*show == request.show && *look == request.look).then(|| (shot.clone(), false))
    }

    /// The catalogue, and whether it is new.
    pub(super) fn catalog(&mut self, folders: &[PathBuf]) -> (Arc<Catalog>, Vec<Diagnostic>, bool) {
        let loader = Loader::default();
        let files = loader.node_files(folders).unwrap_or_default();
        let files: BTreeMap<PathBuf, Option<Stamp>> = files.into_iter().map(|p| (p.clone(), Stamp::of(&p))).collect();
        if let Some(shelf) = &self.shelf
            && shelf.folders == folders
            && shelf.files == files
        {
            return (shelf.catalog.clone(), shelf.found.clone(), false);
        }
        let (catalog, found) = loader.catalog(folders).unwrap_or_else(|failure| {
            // Without the folder the nodes that come with the program are still there.
            (Catalog::embedded(), failure.diagnostics)
        });
        let catalog = Arc::new(catalog);
        self.shelf = Some(Shelf { files, folders: folders.to_vec(), catalog: catalog.clone(), found: found.clone() });
        (catalog, found, true)
    }
}

impl Outcome {
    /// The answer to a request.
    pub(super) fn shaders(&self, revision: u64) -> Shaders {
        let all = self.shot.iter().flat_map(|s| &s.shaders);
        let text =
            |s: &crate::studio::weave::Shader| ShaderText { objects: s.objects.clone(), compiled: s.compiled.clone() };
        let mut wiring: Vec<_> = all.clone().flat_map(|s| s.wiring.iter().cloned()).collect();
        wiring.sort();
        wiring.dedup();
        Shaders {
            revision,
            diagnostics: self.diagnostics.clone(),
            shaders: all.map(text).collect(),
            wiring,
            cost: self.cost.clone(),
            milliseconds: self.milliseconds,
        }
    }
}

/// Adds what each node costs in the shaders of a shot.
fn costs(shot: &Shot, mut all: BTreeMap<String, Cost>) -> BTreeMap<String, Cost> {
    for shader in &shot.shaders {
        for (node, own) in cost(&shader.compiled.module, &shader.verified) {
            let known = all.entry(node).or_default();
            if (own.operations, own.texture_reads) > (known.operations, known.texture_reads) {
                *known = own;
            }
        }
    }
    all
}

/// Whether two requests have the same shaders, files aside.
fn same(a: &Request, b: &Request) -> bool {
    a.show == b.show && a.look == b.look && a.nodes == b.nodes && a.overlay == b.overlay
}

/// Reads files as a request wants them.
pub(super) fn loader(request: &Request) -> Loader {
    let focus = match &request.look {
        Look::Node { graph, node, port } => {
            Some(Focus { graph: graph.clone(), node: node.clone(), port: port.clone() })
        }
        _ => None,
    };
    Loader::with_overlay(request.overlay.clone()).with_focus(focus)
}

/// What shaders are to write.
fn output(look: &Look) -> Output {
    match look {
        Look::Output(output) => output.clone(),
        Look::Error { light } => Output::Visibility(light.clone()),
        Look::Map { .. } | Look::Node { .. } => Output::Radiance,
    }
}

/// Calls `work` with what is shown.
pub(super) fn with_subject<T>(show: &Show, work: impl FnOnce(&Subject<'_>) -> T) -> T {
    match show {
        Show::Stage { shape, graphs } => work(&Subject { files: graphs, scene: None, shape }),
        Show::Scene(file) => work(&Subject { files: std::slice::from_ref(file), scene: None, shape: &Shown::Sphere }),
    }
}
