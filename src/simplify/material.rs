//! The graph that is simplified: which of the files it is, flat, with every link pinned to its ports.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use crate::diagnostic::SourceText;
use crate::diagnostic::{Diagnostic, Place};
use crate::graph::{Edit, End, Graph, apply, write};
use crate::node::{Catalog, Choices, Definition, custom};
use crate::semantic::{Shape, Value};
use crate::studio::load::{Document, Loader, absolute, relative};
use crate::studio::weave::{Known, Weaver};
use crate::studio::{Failure, Listener, Resolved, Shot, Shown, Subject};
use crate::view::commands::free_name;
use crate::weave::{is_light, is_shadow, is_surface};

/// A material among the files of a command.
#[derive(Clone, Debug)]
pub struct Material {
    /// All files, in their order.
    pub files: Vec<PathBuf>,
    /// The scene that they are shown in; none for the stage.
    pub scene: Option<PathBuf>,
    /// Which of them is the material.
    pub index: usize,
    /// It, without subgraphs; its paths count from its file.
    pub graph: Graph,
}

impl Material {
    /// Finds the material, tells all that is wrong with it, and makes it ready.
    pub fn read(
        files: &[PathBuf],
        scene: Option<&Path>,
        (loader, catalog, listener): (&Loader, &Catalog, &dyn Listener),
    ) -> Result<Self, Failure> {
        let known = Known::default();
        let weaver = Weaver { images: true, ..Weaver::new(listener, loader, catalog, &known) };
        let mut found: Vec<(usize, Graph)> = Vec::new();
        let mut broken = false;
        for (index, file) in files.iter().enumerate() {
            match loader.document(file)? {
                Some(Document::Graph(graph)) => match loader.flatten(&graph) {
                    Some(flat) => found.extend(has_surface(&flat, catalog).then_some((index, flat))),
                    None => broken = true,
                },
                Some(Document::Scene(_)) => {
                    let help = "give graphs, and the scene that they are shown in with --scene";
                    return Err(Failure::usage("a scene has no single material", help));
                }
                None => broken = true,
            }
        }
        broken |= weaver.tell_found();
        if broken {
            return Err(Failure::told());
        }
        let (index, flat) = match found.len() {
            1 => found.remove(0),
            0 => return Err(nothing("none of the graphs has a surface", "give a graph with a surface node", files)),
            n => {
                let help = "give one surface, and besides it only lights";
                return Err(nothing(&format!("{n} of the graphs have surfaces"), help, files));
            }
        };
        let graph = named(flat, &files[index], catalog);
        let mut material = Self { files: files.to_vec(), scene: scene.map(Path::to_path_buf), index, graph };
        // As it was given, so that what is wrong is told with the places of the file.
        Shot::new(&material.subject(), &weaver)?;
        let silent = Silent;
        let overlaid = material.loader(&material.graph, files, loader)?;
        let weaver = Weaver { wiring: true, ..Weaver::new(&silent, &overlaid, catalog, &known) };
        let shot = Shot::new(&material.subject(), &weaver)?;
        let wires: Vec<Resolved> = shot.shaders.into_iter().flat_map(|s| s.wiring).collect();
        pin(&mut material.graph, &wires, &files[index].display().to_string(), catalog);
        material.export(catalog);
        Ok(material)
    }

    /// What is to be seen.
    pub fn subject(&self) -> Subject<'_> {
        Subject { files: &self.files, scene: self.scene.as_deref(), shape: &Shown::Sphere }
    }

    /// The file of the material.
    pub fn file(&self) -> &Path {
        &self.files[self.index]
    }

    /// A loader for which a graph stands in place of the material. What is piped in is read once.
    pub fn loader(&self, graph: &Graph, piped: &[PathBuf], from: &Loader) -> Result<Loader, Failure> {
        let mut texts = BTreeMap::from([(self.file().to_path_buf(), write(graph).into())]);
        for dash in piped.iter().filter(|f| f.as_os_str() == "-" && **f != *self.file()) {
            texts.insert(dash.clone(), from.text(dash)?.text.as_str().into());
        }
        Ok(Loader::with_overlay(texts))
    }

    /// A graph as a file in `folder`, to which its paths are brought.
    pub fn in_folder(&self, graph: &Graph, folder: &Path, catalog: &Catalog) -> String {
        let mut moved = graph.clone();
        let file = self.file().display().to_string();
        paths(&mut moved, catalog, |path, _| path_from(folder, &relative(path, &file)));
        write(&moved)
    }

    /// Says what the graph exports, so that it is the same after a swap.
    fn export(&mut self, catalog: &Catalog) {
        if self.graph.output.is_some() || !self.graph.expose.outputs.is_empty() {
            return;
        }
        let follows = |name: &String| self.graph.links.iter().any(|l| l.from.node == *name);
        let surface = |name: &&String| definition(&self.graph, name, catalog).is_some_and(|d| is_surface(&d));
        let mut ends = self.graph.nodes.keys().filter(|n| !follows(n)).filter(surface);
        if let (Some(only), None) = (ends.next(), ends.next()) {
            self.graph.output = Some(End::node(only));
        }
    }
}

/// Hears nothing: a variant that cannot be woven is not offered.
pub(super) struct Silent;

impl Listener for Silent {
    fn found(&self, _: &[Diagnostic]) {}
}

fn nothing(message: &str, help: &str, files: &[PathBuf]) -> Failure {
    let place = files.first().map_or_else(Place::default, |f| Place::file(f.display().to_string()));
    vec![Diagnostic::error("ST0750", format!("there is nothing to simplify: {message}"), place).help(help)].into()
}

fn definition(graph: &Graph, name: &str, catalog: &Catalog) -> Option<std::sync::Arc<Definition>> {
    let node = graph.nodes.get(name)?;
    if let Some(text) = &node.wgsl {
        return custom(name, text, &SourceText::new("", ""), &node.options, catalog).ok();
    }
    let file = catalog.get(&node.kind)?;
    file.definition(&node.options).or_else(|_| file.definition(&Choices::new())).ok()
}

fn has_surface(graph: &Graph, catalog: &Catalog) -> bool {
    graph.nodes.keys().any(|name| definition(graph, name, catalog).is_some_and(|d| is_surface(&d)))
}

/// The flat graph with names that a file can hold, and paths that count from the material's file.
fn named(mut graph: Graph, file: &Path, catalog: &Catalog) -> Graph {
    let own = file.display().to_string();
    let folder = file.parent().unwrap_or(Path::new("")).to_path_buf();
    paths(&mut graph, catalog, |path, from| match from {
        Some(from) if from != own => path_from(&folder, &relative(path, from)),
        _ => path.to_owned(),
    });
    for name in graph.nodes.keys().filter(|name| name.contains('/')).cloned().collect::<Vec<_>>() {
        let new = free_name(&graph, &name.replace('/', " "));
        // The new name is free and the old one is there.
        let _ = apply(&mut graph, Edit::RenameNode(name, new));
    }
    graph
}

/// Changes every path of a picture, given with the file that says it.
fn paths(graph: &mut Graph, catalog: &Catalog, change: impl Fn(&str, Option<&str>) -> String) {
    let names: Vec<String> = graph.nodes.keys().cloned().collect();
    for name in names {
        let Some(definition) = definition(graph, &name, catalog) else { continue };
        let Some(node) = graph.nodes.get_mut(&name) else { continue };
        let spans = &node.spans.params;
        for (port, value) in &mut node.params {
            let is_picture = definition.input(port).is_some_and(|p| p.ty.shape == Shape::Texture);
            if let Value::Text(text) = value
                && is_picture
            {
                let from = spans.get(port).map(|s| s.source.name.as_str());
                *text = change(text, from);
            }
        }
    }
}

/// A path as a file in `folder` mentions it.
fn path_from(folder: &Path, path: &Path) -> String {
    let (from, to) = (absolute(if folder.as_os_str().is_empty() { Path::new(".") } else { folder }), absolute(path));
    let common = from.components().zip(to.components()).take_while(|(a, b)| a == b).count();
    let rooted = from.components().take(common).any(|c| matches!(c, Component::Normal(_)));
    if !rooted {
        return to.display().to_string();
    }
    let up = from.components().skip(common).map(|_| "..".to_owned());
    let down = to.components().skip(common).map(|c| c.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}

/// Pins links to the ports that the weaver found for them. Light names no ports, and what was found for several links
/// between the same two nodes is left to it.
fn pin(graph: &mut Graph, wires: &[Resolved], file: &str, catalog: &Catalog) {
    let lamp = |name: &str| definition(graph, name, catalog).is_some_and(|d| is_light(&d) || is_shadow(&d));
    let mut edits = Vec::new();
    for link in graph.links.iter().filter(|l| l.from.port.is_none() || l.to.port.is_none()) {
        if lamp(&link.from.node) {
            continue;
        }
        let fits = |w: &&Resolved| {
            w.graph == file
                && w.from_graph == file
                && w.from.0 == link.from.node
                && w.to.0 == link.to.node
                && link.from.port.as_ref().is_none_or(|p| *p == w.from.1)
                && link.to.port.as_ref().is_none_or(|p| *p == w.to.1)
        };
        let mut found = wires.iter().filter(fits);
        if let (Some(wire), None) = (found.next(), found.next()) {
            let mut pinned = link.clone();
            pinned.from.port = Some(wire.from.1.clone());
            pinned.to.port = Some(wire.to.1.clone());
            edits.push(Edit::Unlink(link.from.clone(), link.to.clone()));
            edits.push(Edit::Link(Box::new(pinned)));
        }
    }
    // The links are there, and pinned ones are new; were one not, all would stay as they are.
    let _ = apply(graph, Edit::Batch(edits));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_lead_from_the_new_folder_to_the_same_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let root = folder.path();
        std::fs::create_dir_all(root.join("a/b")).expect("made");
        assert_eq!(path_from(&root.join("a"), &root.join("a/b/x.png")), "b/x.png");
        assert_eq!(path_from(&root.join("a/b"), &root.join("c.png")), "../../c.png");
    }
}
