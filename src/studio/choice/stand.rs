//! A scene and its lights, as a choice looks at them.

use std::path::{Path, PathBuf};

use crate::choose::{Demand, Effort, Facts, Load, Needless, Receivers, Site, covered, facts, receivers};
use crate::compile::{NamedGraph, Output};
use crate::diagnostic::{Diagnostic, Place};
use crate::graph::Graph;
use crate::node::Catalog;
use crate::reference::picture::Watch;
use crate::reference::{Body, Light, World};
use crate::scene::{Camera, Scene};
use crate::studio::assets::each_mesh;
use crate::studio::failure::Failure;
use crate::studio::load::{Document, relative};
use crate::studio::measure::is_shadow;
use crate::studio::settings;
use crate::studio::truth::plain_surface;
use crate::studio::truth_light::{far, light};
use crate::studio::weave::Weaver;
use crate::weave::{is_light, weave};

/// Sides of maps that are tried.
const SIDES: [u32; 6] = [128, 256, 512, 1024, 2048, 4096];

/// What stands where, and what shines on it.
#[derive(Clone, Debug)]
pub struct Stand {
    /// The scene.
    pub scene: Scene,
    /// Its file, from which its paths count.
    pub file: PathBuf,
    /// The same for rays.
    pub world: World,
    /// Who looks.
    pub camera: Camera,
    /// Triangles of all that casts.
    pub triangles: usize,
    /// Why no light needs shadow code, if none does.
    pub needless: Option<Needless>,
    /// Its lights, in the order of their names.
    pub lamps: Vec<Lamp>,
}

/// One light of a scene.
#[derive(Clone, Debug)]
pub struct Lamp {
    /// Its name in the scene.
    pub name: String,
    /// Its graph file, as the program can open it.
    pub file: PathBuf,
    /// The graph, as the file has it.
    pub graph: Graph,
    /// The node that shines.
    pub node: String,
    /// The light for rays.
    pub light: Light,
    /// Where its maps end, metres; none where they fit the scene.
    pub far: Option<f64>,
    /// Whether its view can be cut into parts.
    pub splits: bool,
    /// Why it needs no shadow code, if it does not.
    pub needless: Option<Needless>,
}

fn refuse(code: &'static str, message: String, help: &str) -> Failure {
    vec![Diagnostic::error(code, message, Place::default()).help(help)].into()
}

impl Stand {
    /// Reads a scene file. `only` names the one light that is looked at; none looks at all.
    pub fn read(file: &Path, only: Option<&str>, weaver: &Weaver<'_>) -> Result<Self, Failure> {
        let scene = match weaver.loader.document(file)? {
            Some(Document::Scene(scene)) => *scene,
            Some(Document::Graph(_)) => {
                let message = format!("`{}` is a graph, not a scene", file.display());
                return Err(refuse("ST0700", message, "shadows are chosen for a scene: name a `Scene(...)` file"));
            }
            None => {
                weaver.tell_found();
                return Err(Failure::told());
            }
        };
        weaver.tell_found();
        let mut meshes = Vec::new();
        each_mesh(&scene, file, weaver.loader, |mesh| meshes.push(mesh))?;
        let bodies: Vec<Body<'_>> = scene
            .objects
            .iter()
            .zip(&meshes)
            .map(|(object, mesh)| Body {
                mesh,
                object_to_world: object.transform.matrix(),
                casts: object.casts,
                receives: object.receives,
            })
            .collect();
        let world = World::new(&bodies);
        let triangles = bodies.iter().filter(|b| b.casts).map(|b| b.mesh.indices.len() / 3).sum();
        let needless = match () {
            () if !bodies.iter().any(|b| b.casts) => Some("nothing casts a shadow"),
            () if !bodies.iter().any(|b| b.receives) => Some("no shadow falls on anything"),
            () => None,
        };
        let mut stand = Self {
            camera: scene.camera.camera(),
            file: file.to_path_buf(),
            world,
            triangles,
            needless,
            lamps: Vec::new(),
            scene,
        };
        stand.lamps = stand.read_lamps(only, weaver)?;
        for lamp in &mut stand.lamps {
            lamp.needless = stand.needless.or_else(|| disjoint(&bodies, &lamp.light));
        }
        Ok(stand)
    }

    fn read_lamps(&self, only: Option<&str>, weaver: &Weaver<'_>) -> Result<Vec<Lamp>, Failure> {
        let names: Vec<&str> = self.scene.lights.iter().map(|l| l.name.as_str()).collect();
        if names.is_empty() {
            let message = format!("`{}` has no light, so there is no shadow to choose", self.file.display());
            return Err(refuse("ST0701", message, "add a light under `lights`"));
        }
        if let Some(wanted) = only.filter(|wanted| !names.contains(wanted)) {
            let message = format!("the scene has no light `{wanted}`");
            return Err(refuse("ST0702", message, &format!("its lights are {}", names.join(", "))));
        }
        let mut graphs = weaver.lights(&self.scene, &self.file)?;
        // What is set on surfaces has no part in it, and what is set on shadows goes with them.
        for assignment in weaver.set {
            let found = settings::apply(std::slice::from_ref(assignment), &mut graphs, weaver.catalog);
            if let Err(failure) = found
                && failure.diagnostics.iter().any(|d| d.code != "ST0511")
            {
                return Err(failure);
            }
        }
        let mut all = graphs.clone();
        all.push(plain_surface());
        let instances = self.scene.lights.iter().filter(|l| only.is_none_or(|wanted| l.name == wanted));
        let lamps = instances.map(|instance| {
            let file = relative(&instance.graph.path, &self.file.display().to_string());
            let Some(Document::Graph(graph)) = weaver.loader.document(&file)? else { return Err(Failure::told()) };
            let flat = graphs.iter().find(|g| g.name == instance.name).ok_or_else(Failure::told)?;
            let node = sole_light(&graph, flat, &file, weaver.catalog)?;
            let output = Output::Visibility(instance.name.clone());
            let (woven, found) = weave(&all, weaver.catalog, &output);
            let Some(woven) = woven else {
                weaver.listener.found(&found);
                return Err(Failure::told());
            };
            let mut light = light(&woven, &self.world)?;
            light.views.truncate(if light.views.len() == 6 { 6 } else { 1 });
            let kind = graph.nodes.get(&node).map_or("", |n| n.kind.as_str());
            let header = weaver.catalog.get(kind).and_then(|f| f.header().ok());
            let splits = header.is_some_and(|h| h.options.iter().any(|o| o.name == "splits"));
            let far = far(&woven)?;
            Ok(Lamp { name: instance.name.clone(), file, graph: *graph, node, light, far, splits, needless: None })
        });
        lamps.collect()
    }

    /// The light as a choice looks at it, in a picture of this size.
    pub fn site<'a>(&'a self, lamp: &'a Lamp, size: (u32, u32)) -> Site<'a> {
        Site { world: &self.world, light: &lamp.light, far: lamp.far, camera: self.camera, size }
    }

    /// What the picture asks of every candidate.
    pub fn load(&self, lamp: &Lamp, receivers: &Receivers, size: (u32, u32)) -> Load {
        let pixels = f64::from(size.0) * f64::from(size.1);
        Load {
            pixels,
            shaded: pixels * receivers.shaded,
            triangles: self.triangles as f64,
            views: u32::try_from(lamp.light.views.len()).unwrap_or(1),
            covered: parts(lamp).map(|parts| (parts, covered(&self.site(lamp, size), parts))).collect(),
        }
    }

    /// Looks at what the camera sees of a light. None if cancelled.
    pub fn look(&self, lamp: &Lamp, size: (u32, u32), effort: Effort, watch: Watch<'_>) -> Option<(Receivers, Facts)> {
        let site = self.site(lamp, size);
        let receivers = receivers(&site, effort, watch)?;
        let facts = facts(&site, &receivers);
        Some((receivers, facts))
    }
}

/// Numbers of parts that a light's view can be cut into.
fn parts(lamp: &Lamp) -> impl Iterator<Item = u32> {
    [1, 2, 4].into_iter().filter(|n| *n == 1 || lamp.splits)
}

/// What a light's statistics ask candidates to be like.
pub fn demand(lamp: &Lamp, facts: &Facts) -> Demand {
    let parts = parts(lamp).filter(|n| *n <= facts.split_demand.next_power_of_two());
    // Six maps of the largest side would not fit many devices.
    let most = if lamp.light.views.len() > 1 { 2048 } else { 4096 };
    Demand {
        sides: SIDES.into_iter().filter(|side| *side <= most).collect(),
        parts: parts.collect(),
        penumbra: facts.penumbra,
        footprint: facts.footprint,
        soft: !lamp.light.source.is_sharp(),
    }
}

/// What else can be tried where none of these keeps the error: the largest maps of views that are cut into more parts than
/// distances ask for, as each part is then fitted to less. None where nothing is left.
pub(super) fn finer(lamp: &Lamp, asked: &Demand) -> Option<Demand> {
    let more: Vec<u32> = parts(lamp).filter(|n| !asked.parts.contains(n)).collect();
    let sides = SIDES[SIDES.len() - 2..].to_vec();
    (!more.is_empty()).then(|| Demand { sides, parts: more, ..asked.clone() })
}

/// The one light node of a graph, whose shadows must be nodes of the graph itself.
fn sole_light(graph: &Graph, flat: &NamedGraph, file: &Path, catalog: &Catalog) -> Result<String, Failure> {
    let lights = |graph: &Graph| -> Vec<String> {
        let is = |kind: &str, options| {
            catalog.get(kind).and_then(|f| f.definition(options).ok()).is_some_and(|d| is_light(&d))
        };
        graph.nodes.iter().filter(|(_, n)| is(&n.kind, &n.options)).map(|(name, _)| name.clone()).collect()
    };
    let shadows = |graph: &Graph| graph.nodes.values().filter(|n| is_shadow(catalog, &n.kind)).count();
    let (own, all) = (lights(graph), lights(&flat.graph));
    match &own[..] {
        [only] if all.len() == 1 && shadows(graph) == shadows(&flat.graph) => Ok(only.clone()),
        _ => {
            let message = format!(
                "{} has {} light nodes, {} of them in subgraphs",
                file.display(),
                all.len(),
                all.len() - own.len().min(all.len())
            );
            let help = "shadows are chosen for graphs with one light node, with it and its shadows in the graph itself";
            Err(refuse("ST0703", message, help))
        }
    }
}

/// Whether all that casts lies farther from a parallel light than all that receives, so that nothing falls on anything.
fn disjoint(bodies: &[Body<'_>], light: &Light) -> Option<Needless> {
    let [view] = light.views[..] else { return None };
    if view.projection != crate::reference::Projection::Parallel {
        return None;
    }
    let depths = |of: fn(&Body<'_>) -> bool| {
        let own = bodies.iter().filter(move |b| of(b));
        own.flat_map(move |b| {
            b.mesh
                .positions
                .iter()
                .map(move |p| view.point(b.object_to_world.as_dmat4().transform_point3(p.as_dvec3())).z)
        })
    };
    let nearest = depths(|b| b.casts).fold(f64::INFINITY, f64::min);
    let farthest = depths(|b| b.receives).fold(f64::NEG_INFINITY, f64::max);
    (nearest > farthest).then_some("all that casts a shadow lies behind all that a shadow falls on")
}
