//! From files to proven shaders.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::assets::check_images;
use super::failure::{Failure, Listener};
use super::load::{Document, Loader, absolute, relative, stems};
use super::settings::{self, Assignment};
use super::wiring::{Resolved, wiring};
use crate::compile::{Compiled, NamedGraph, Options, compile_watched, locate};
use crate::diagnostic::{Diagnostic, Place, did_you_mean, has_errors};
use crate::graph;
use crate::node::{Catalog, Definition};
use crate::scene::{FileReference, Scene, Setting, Settings};
use crate::verify::{Verified, verify};
use crate::weave::{Root, is_light, is_surface};

/// A shader that naga accepted.
#[derive(Debug)]
pub struct Shader {
    /// Names of the objects that have it; none outside a scene.
    pub objects: Vec<String>,
    /// The shader with its plan.
    pub compiled: Arc<Compiled>,
    /// What naga made of it.
    pub verified: Arc<Verified>,
    /// Whether it writes light, rather than a value.
    pub radiance: bool,
    /// How the ports of its graphs are fed, where that was asked for.
    pub wiring: Vec<Resolved>,
}

/// What was found out before and is the same again: texts that naga has accepted.
#[derive(Debug, Default)]
pub struct Known {
    proven: RefCell<BTreeMap<String, Arc<Verified>>>,
}

impl Known {
    /// More shaders than a scene has; then it starts afresh.
    const MOST: usize = 256;

    fn verify(&self, compiled: &Compiled) -> Result<Arc<Verified>, Vec<Diagnostic>> {
        let wgsl = &compiled.module.wgsl;
        if let Some(known) = self.proven.borrow().get(wgsl) {
            return Ok(known.clone());
        }
        let verified = Arc::new(verify(&compiled.module)?);
        let mut proven = self.proven.borrow_mut();
        if proven.len() >= Self::MOST {
            proven.clear();
        }
        proven.insert(wgsl.clone(), verified.clone());
        Ok(verified)
    }
}

/// What a person gave: graphs to be woven together, or one scene.
#[derive(Debug)]
pub enum Input {
    /// Graphs, flattened.
    Graphs(Vec<NamedGraph>),
    /// A scene and its file.
    Scene(Box<Scene>, PathBuf),
}

/// Loads, weaves and proves with one catalogue and one set of overrides.
pub struct Weaver<'a> {
    /// Who is told what is found.
    pub listener: &'a dyn Listener,
    /// Where files come from.
    pub loader: &'a Loader,
    /// The nodes.
    pub catalog: &'a Catalog,
    /// How to compile.
    pub options: Options,
    /// Overrides.
    pub set: &'a [Assignment],
    /// Whether the pictures that shaders read must be there.
    pub images: bool,
    /// Whether shaders come with their wiring.
    pub wiring: bool,
    /// What need not be found out again.
    pub known: &'a Known,
}

impl<'a> Weaver<'a> {
    /// A weaver without overrides, for what is seen.
    pub fn new(listener: &'a dyn Listener, loader: &'a Loader, catalog: &'a Catalog, known: &'a Known) -> Self {
        let options = Options::default();
        Self { listener, loader, catalog, options, set: &[], images: false, wiring: false, known }
    }

    /// Reads all files. Everything that is wrong with any of them is reported before giving up.
    pub fn read(&self, files: &[PathBuf]) -> Result<Input, Failure> {
        let mut graphs = Vec::new();
        let mut scene = None;
        let mut broken = false;
        let mut worst: Option<Failure> = None;
        for (path, name) in files.iter().zip(stems(files)) {
            match self.loader.document(path) {
                Ok(Some(Document::Graph(graph))) => match self.loader.flatten(&graph) {
                    Some(graph) => graphs.push(NamedGraph { name, graph, set: BTreeMap::new() }),
                    None => broken = true,
                },
                Ok(Some(Document::Scene(read))) => scene = Some((read, path.clone())),
                Ok(None) => broken = true,
                Err(failure) => match &mut worst {
                    Some(first) => first.diagnostics.extend(failure.diagnostics),
                    None => worst = Some(failure),
                },
            }
        }
        let found = self.loader.take_found();
        self.listener.found(&found);
        broken |= has_errors(&found);
        if let Some(failure) = worst {
            return Err(failure);
        }
        if broken {
            return Err(Failure::told());
        }
        match scene {
            Some((scene, path)) if files.len() == 1 => Ok(Input::Scene(scene, path)),
            Some(_) => Err(Failure::usage(
                "a scene cannot be woven together with other files",
                "give the scene alone; to see graphs in a scene, use `render GRAPH... --scene SCENE`",
            )),
            None => Ok(Input::Graphs(self.focused(files, graphs))),
        }
    }

    /// Where one node of one graph is looked at, that graph and those that light it.
    fn focused(&self, files: &[PathBuf], graphs: Vec<NamedGraph>) -> Vec<NamedGraph> {
        let Some(focus) = self.loader.focus() else { return graphs };
        let lights = |named: &NamedGraph| {
            let is = |what: fn(&Definition) -> bool| {
                named.graph.nodes.values().any(|node| {
                    let definition = self.catalog.get(&node.kind).and_then(|f| f.definition(&node.options).ok());
                    definition.is_some_and(|d| what(&d))
                })
            };
            is(is_light) && !is(is_surface)
        };
        let pairs = files.iter().zip(graphs);
        pairs.filter(|(path, graph)| absolute(path) == focus.graph || lights(graph)).map(|(_, graph)| graph).collect()
    }

    /// Tells what the loader found. Answers whether there was an error.
    pub fn tell_found(&self) -> bool {
        let found = self.loader.take_found();
        self.listener.found(&found);
        has_errors(&found)
    }

    /// Weaves graphs into one shader and proves it.
    pub fn weave(&self, graphs: &[NamedGraph], objects: Vec<String>) -> Result<Shader, Failure> {
        let (shader, found) = self.try_weave(graphs, objects);
        self.listener.found(&found);
        shader.ok_or_else(Failure::told)
    }

    /// Weaves without reporting.
    pub fn try_weave(&self, graphs: &[NamedGraph], objects: Vec<String>) -> (Option<Shader>, Vec<Diagnostic>) {
        self.try_weave_as(graphs, objects, &self.options)
    }

    fn try_weave_as(
        &self,
        graphs: &[NamedGraph],
        objects: Vec<String>,
        options: &Options,
    ) -> (Option<Shader>, Vec<Diagnostic>) {
        let (mut wires, mut radiance) = (Vec::new(), true);
        let (compiled, mut found) = compile_watched(graphs, self.catalog, options, |woven| {
            radiance = !matches!(woven.root, Root::Value { .. });
            if self.wiring {
                wires = wiring(woven, graphs);
            }
        });
        let Some(compiled) = compiled.filter(|_| !has_errors(&found)) else {
            return (None, found);
        };
        match self.known.verify(&compiled) {
            Ok(verified) => {
                if self.images {
                    found.extend(check_images(&compiled.module, graphs, self.loader));
                }
                let shader = Shader { objects, compiled: Arc::new(compiled), verified, radiance, wiring: wires };
                (Some(shader).filter(|_| !has_errors(&found)), found)
            }
            Err(errors) => {
                self.listener.detail(&compiled.module.wgsl);
                found.extend(errors.into_iter().map(|e| locate(e, graphs)));
                (None, found)
            }
        }
    }

    /// Graphs given on the command line, with `--set` applied, as one shader.
    pub fn weave_graphs(&self, mut graphs: Vec<NamedGraph>) -> Result<Shader, Failure> {
        settings::apply(self.set, &mut graphs, self.catalog)?;
        self.weave(&graphs, Vec::new())
    }

    /// The light graphs of a scene, named as the scene names its lights.
    pub fn lights(&self, scene: &Scene, file: &Path) -> Result<Vec<NamedGraph>, Failure> {
        let lights: Vec<_> = scene.lights.iter().map(|l| self.mentioned(&l.graph, &l.name, &l.set, file)).collect();
        let failed = self.tell_found();
        let all: Option<Vec<NamedGraph>> = lights.into_iter().collect();
        all.filter(|_| !failed).ok_or_else(Failure::told)
    }

    /// The shaders of a scene's objects, equal ones once, in the order of the objects.
    pub fn weave_scene(&self, scene: &Scene, file: &Path) -> Result<Vec<Shader>, Failure> {
        let lights: Vec<_> = scene.lights.iter().map(|l| self.mentioned(&l.graph, &l.name, &l.set, file)).collect();
        let mut surfaces: Vec<(String, Vec<NamedGraph>, Vec<String>)> = Vec::new();
        for object in &scene.objects {
            // Overrides decide with the path whether two objects have the same shader with the same values.
            let set: Vec<String> = object.set.iter().map(|(k, s)| format!("{k}={}", s.value)).collect();
            let key = format!("{}\n{}", object.surface.path, set.join("\n"));
            if let Some(known) = surfaces.iter_mut().find(|s| s.0 == key) {
                known.2.push(object.name.clone());
                continue;
            }
            let stem = stems(&[PathBuf::from(&object.surface.path)]).remove(0);
            // A light may have the name of the surface's file.
            let taken = scene.lights.iter().any(|l| l.name == stem);
            let name = if taken { format!("surface {stem}") } else { stem };
            let surface = self.mentioned(&object.surface, &name, &object.set, file);
            surfaces.push((key, surface.into_iter().collect(), vec![object.name.clone()]));
        }
        let mut failed = self.tell_found();
        // Without one of its lights every surface would be told to lack it.
        let Some(lights) = lights.into_iter().collect::<Option<Vec<NamedGraph>>>() else {
            return Err(Failure::told());
        };
        // The surfaces that could be read may have mistakes of their own.
        surfaces.retain(|(_, surface, _)| !surface.is_empty());
        let casts = scene.objects.iter().any(|o| o.casts);
        let mut shaders = Vec::new();
        let mut shown: Vec<Diagnostic> = Vec::new();
        let mut unused = self.set.to_vec();
        for (_, surface, objects) in surfaces {
            let mut graphs = lights.clone();
            graphs.extend(surface);
            // A node of --set may be in one surface only.
            let here: Vec<Assignment> = self
                .set
                .iter()
                .filter(|a| settings::apply(std::slice::from_ref(a), &mut graphs, self.catalog).is_ok())
                .cloned()
                .collect();
            unused.retain(|a| !here.contains(a));
            let receives = scene.objects.iter().any(|o| o.receives && objects.contains(&o.name));
            let options = Options { unshadowed: !(casts && receives), ..self.options.clone() };
            let (shader, found) = self.try_weave_as(&graphs, objects, &options);
            // A fault of a light shows with every surface, but is one fault.
            let new: Vec<Diagnostic> = found.into_iter().filter(|d| !shown.contains(d)).collect();
            self.listener.found(&new);
            shown.extend(new);
            match shader {
                Some(shader) => shaders.push(shader),
                None => failed = true,
            }
        }
        if failed {
            return Err(Failure::told());
        }
        settings::apply(&unused, &mut lights.clone(), self.catalog)?;
        Ok(shaders)
    }

    /// A graph that a scene mentions. None if it cannot be used; then why is kept.
    fn mentioned(&self, file: &FileReference, name: &str, set: &Settings, scene: &Path) -> Option<NamedGraph> {
        let path = relative(&file.path, &scene.display().to_string());
        let mut graph = self.loader.named_graph(&path, name, file.span.as_ref())?;
        for (path, Setting { value, span }) in set {
            graph.set.insert(path.clone(), value.clone());
            // What is wrong with the value is wrong in the scene, and a path counts from there.
            let (Some(span), Some((node, port))) = (span, path.rsplit_once('.')) else { continue };
            let Some(target) = graph.graph.nodes.get_mut(node) else {
                let message = format!("`{path}` cannot be set: {} has no node `{node}`", file.path);
                let names: Vec<&str> = graph.graph.nodes.keys().map(String::as_str).collect();
                let help = match did_you_mean(node, names.iter().copied()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("its nodes are {}", names.join(", ")),
                };
                self.loader.add(Diagnostic::error("ST0207", message, Place::span(span.clone())).help(help));
                graph.set.remove(path);
                continue;
            };
            target.spans.params.insert(port.to_owned(), span.clone());
            target.spans.names.insert((graph::Setting::Param, port.to_owned()), span.clone());
        }
        Some(graph)
    }
}
