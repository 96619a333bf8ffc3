//! From files to proven shaders: what `generate`, `check` and `render` have in common.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::assets::check_images;
use super::context::Context;
use super::exit::Failure;
use super::load::{Document, Loader, relative, stems};
use super::settings::{self, Assignment};
use crate::compile::{Compiled, NamedGraph, Options, compile, locate};
use crate::diagnostic::{Diagnostic, Place, did_you_mean, has_errors};
use crate::graph;
use crate::node::Catalog;
use crate::scene::{FileReference, Scene, Setting, Settings};
use crate::verify::{Verified, verify};

/// A shader that naga accepted.
#[derive(Debug)]
pub(super) struct Shader {
    /// Names of the objects that have it; none outside a scene.
    pub(super) objects: Vec<String>,
    pub(super) compiled: Compiled,
    pub(super) verified: Verified,
}

/// What a person gave: graphs to be woven together, or one scene.
#[derive(Debug)]
pub(super) enum Input {
    /// Graphs, flattened.
    Graphs(Vec<NamedGraph>),
    /// A scene and its file.
    Scene(Box<Scene>, PathBuf),
}

/// Loads, weaves and proves with one catalogue and one set of overrides.
pub(super) struct Weaver<'a> {
    pub(super) context: &'a Context,
    pub(super) loader: &'a Loader,
    pub(super) catalog: &'a Catalog,
    pub(super) options: Options,
    pub(super) set: &'a [Assignment],
    /// Whether the pictures that shaders read must be there.
    pub(super) images: bool,
}

impl Weaver<'_> {
    /// Reads all files. Everything that is wrong with any of them is reported before giving up.
    pub(super) fn read(&self, files: &[PathBuf]) -> Result<Input, Failure> {
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
        broken |= self.context.report(&found);
        if let Some(failure) = worst {
            return Err(failure);
        }
        if broken {
            return Err(Vec::new().into());
        }
        match scene {
            Some((scene, path)) if files.len() == 1 => Ok(Input::Scene(scene, path)),
            Some(_) => Err(Failure::usage(
                "a scene cannot be woven together with other files",
                "give the scene alone; to see graphs in a scene, use `render GRAPH... --scene SCENE`",
            )),
            None => Ok(Input::Graphs(graphs)),
        }
    }

    /// Weaves graphs into one shader and proves it.
    pub(super) fn weave(&self, graphs: &[NamedGraph], objects: Vec<String>) -> Result<Shader, Failure> {
        let (shader, found) = self.try_weave(graphs, objects);
        self.context.report(&found);
        shader.ok_or_else(|| Vec::new().into())
    }

    /// Weaves without reporting.
    pub(super) fn try_weave(&self, graphs: &[NamedGraph], objects: Vec<String>) -> (Option<Shader>, Vec<Diagnostic>) {
        self.try_weave_as(graphs, objects, &self.options)
    }

    fn try_weave_as(
        &self,
        graphs: &[NamedGraph],
        objects: Vec<String>,
        options: &Options,
    ) -> (Option<Shader>, Vec<Diagnostic>) {
        let (compiled, mut found) = compile(graphs, self.catalog, options);
        let Some(compiled) = compiled.filter(|_| !has_errors(&found)) else {
            return (None, found);
        };
        match verify(&compiled.module) {
            Ok(verified) => {
                if self.images {
                    found.extend(check_images(&compiled.module, graphs, self.loader));
                }
                let shader = Shader { objects, compiled, verified };
                (Some(shader).filter(|_| !has_errors(&found)), found)
            }
            Err(errors) => {
                if self.context.verbose > 0 {
                    self.context.detail(&compiled.module.wgsl);
                }
                found.extend(errors.into_iter().map(|e| locate(e, graphs)));
                (None, found)
            }
        }
    }

    /// Graphs given on the command line, with `--set` applied, as one shader.
    pub(super) fn weave_graphs(&self, mut graphs: Vec<NamedGraph>) -> Result<Shader, Failure> {
        settings::apply(self.set, &mut graphs, self.catalog)?;
        self.weave(&graphs, Vec::new())
    }

    /// The light graphs of a scene, named as the scene names its lights.
    #[cfg(feature = "render")]
    pub(super) fn lights(&self, scene: &Scene, file: &Path) -> Result<Vec<NamedGraph>, Failure> {
        let lights: Vec<_> = scene.lights.iter().map(|l| self.mentioned(&l.graph, &l.name, &l.set, file)).collect();
        let failed = self.context.report(&self.loader.take_found());
        let all: Option<Vec<NamedGraph>> = lights.into_iter().collect();
        all.filter(|_| !failed).ok_or_else(|| Vec::new().into())
    }

    /// The shaders of a scene's objects, equal ones once, in the order of the objects.
    pub(super) fn weave_scene(&self, scene: &Scene, file: &Path) -> Result<Vec<Shader>, Failure> {
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
        let mut failed = self.context.report(&self.loader.take_found());
        // Without one of its lights every surface would be told to lack it.
        let Some(lights) = lights.into_iter().collect::<Option<Vec<NamedGraph>>>() else {
            return Err(Vec::new().into());
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
            self.context.report(&new);
            shown.extend(new);
            match shader {
                Some(shader) => shaders.push(shader),
                None => failed = true,
            }
        }
        if failed {
            return Err(Vec::new().into());
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
