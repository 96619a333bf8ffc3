//! What is shown: a scene and the shaders of its objects. Graphs without a scene are shown on the stage.

use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::load::{Document, absolute, relative};
use super::settings;
use super::stage::{self, Shown};
use super::weave::{Input, Shader, Weaver};
use crate::compile::NamedGraph;
use crate::scene::Scene;

/// What a person wants to see.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// Graph files that are woven together, or one scene file.
    pub files: &'a [PathBuf],
    /// The scene that graphs are shown in.
    pub scene: Option<&'a Path>,
    /// Without a scene, the shape that they are shown on.
    pub shape: &'a Shown,
}

/// A scene with the shaders of its objects.
#[derive(Debug)]
pub struct Shot {
    /// What stands where.
    pub scene: Scene,
    /// The file that its paths count from.
    pub file: PathBuf,
    /// Shaders; one without names of objects is for all of them.
    pub shaders: Vec<Shader>,
    /// Whether the mesh of [`stage::SHOWN`] is to be brought to the size of the stage.
    pub stands: bool,
}

impl Shot {
    /// Weaves what is to be seen.
    pub fn new(subject: &Subject<'_>, weaver: &Weaver<'_>) -> Result<Self, Failure> {
        match weaver.read(subject.files)? {
            Input::Scene(scene, file) => {
                if subject.scene.is_some() {
                    return Err(Failure::usage("--scene is for graphs, but a scene was given", "leave --scene out"));
                }
                let full = |path: &str| absolute(&relative(path, &file.display().to_string()));
                if let Some(focus) = weaver.loader.focus()
                    && scene.objects.iter().all(|o| full(&o.surface.path) != focus.graph)
                {
                    // What no object shows is seen on the stage.
                    let Input::Graphs(graphs) = weaver.read(std::slice::from_ref(&focus.graph))? else {
                        return Err(Failure::usage("a scene has no nodes", "name a node of a graph"));
                    };
                    return on_stage(graphs, &Shown::Sphere, weaver);
                }
                let shaders = weaver.weave_scene(&scene, &file)?;
                Ok(Self { scene: *scene, file, shaders, stands: false })
            }
            Input::Graphs(graphs) => match subject.scene {
                Some(file) => in_scene(graphs, file, weaver),
                None => on_stage(graphs, subject.shape, weaver),
            },
        }
    }

    /// Whether what is shown is light that reaches the eye, rather than a value.
    pub fn is_radiance(&self) -> bool {
        self.shaders.first().is_none_or(|s| s.radiance)
    }

    /// Names of the lights that shine in it, each once, as plans have them.
    pub fn lights(&self) -> Vec<String> {
        let all = self.shaders.iter().flat_map(|s| &s.compiled.plan.lights);
        all.map(|l| l.name.clone()).collect::<std::collections::BTreeSet<_>>().into_iter().collect()
    }
}

/// The scene of a file, which must be one.
pub fn scene_of(file: &Path, weaver: &Weaver<'_>) -> Result<Scene, Failure> {
    let document = weaver.loader.document(file)?;
    weaver.tell_found();
    match document {
        Some(Document::Scene(scene)) => Ok(*scene),
        Some(Document::Graph(_)) => {
            Err(Failure::usage("--scene names a graph, not a scene", "name a `Scene(...)` file"))
        }
        None => Err(Failure::told()),
    }
}

fn in_scene(mut all: Vec<NamedGraph>, file: &Path, weaver: &Weaver<'_>) -> Result<Shot, Failure> {
    let scene = scene_of(file, weaver)?;
    settings::apply(weaver.set, &mut all, weaver.catalog)?;
    // Graphs that are a whole shader bring their own light; others take those of the scene.
    let alone = weaver.try_weave(&all, Vec::new()).0;
    let shader = match alone {
        Some(shader) if !shader.compiled.plan.lights.is_empty() || scene.lights.is_empty() => shader,
        _ => {
            let mut with_lights = weaver.lights(&scene, file)?;
            with_lights.append(&mut all);
            weaver.weave(&with_lights, Vec::new())?
        }
    };
    Ok(Shot { scene, file: file.to_path_buf(), shaders: vec![shader], stands: false })
}

/// Graphs on the stage. Those that bring no light get the stage's; then its other objects are seen by it, too.
fn on_stage(mut graphs: Vec<NamedGraph>, shape: &Shown, weaver: &Weaver<'_>) -> Result<Shot, Failure> {
    let (stage, found) = stage::read(shape);
    weaver.listener.found(&found);
    let mut stage = stage.ok_or_else(Failure::told)?;
    settings::apply_on_stage(weaver.set, &mut graphs, &mut stage.lights, weaver.catalog)?;
    let (alone, found) = weaver.try_weave(&graphs, Vec::new());
    let shaders = match alone {
        Some(shader) if !shader.compiled.plan.lights.is_empty() => {
            weaver.listener.found(&found);
            vec![shader]
        }
        _ => {
            let lit = |surface: Vec<NamedGraph>| stage.lights.iter().cloned().chain(surface).collect::<Vec<_>>();
            let (shown, mut found) = weaver.try_weave(&lit(graphs), vec![stage::SHOWN.to_owned()]);
            // A surface that takes no light has no use for the stage's, which nobody asked for.
            found.retain(|d| d.code != "ST0210");
            weaver.listener.found(&found);
            let mut shaders = vec![shown.ok_or_else(Failure::told)?];
            // A node that is looked at is seen alone.
            let others = stage.others.iter().filter(|_| weaver.loader.focus().is_none());
            for (object, surface) in others {
                shaders.push(weaver.weave(&lit(vec![surface.clone()]), vec![object.clone()])?);
            }
            shaders
        }
    };
    Ok(Shot { scene: stage.scene, file: "stage.ron".into(), shaders, stands: matches!(shape, Shown::Obj(_)) })
}
