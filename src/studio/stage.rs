//! What graphs are shown on when no scene is given: a scene and the graphs that it uses, inside the program. A shape stands
//! on its floor.

use std::path::PathBuf;

use crate::compile::NamedGraph;
use crate::diagnostic::{Diagnostic, SourceText};
use crate::graph;
use crate::scene::{self, Bounds, FileReference, Mesh, Scene, Settings, Shape};

const SCENE: &str = include_str!("stage.ron");
/// The graphs that the stage mentions, by its paths.
const GRAPHS: [(&str, &str); 2] = [
    ("spot_soft.ron", include_str!("../../graphs/lights/spot_soft.ron")),
    ("studio_floor.ron", include_str!("../../graphs/surfaces/studio_floor.ron")),
];
/// The object that shows the graphs; the others have surfaces of their own.
pub const SHOWN: &str = "ball";

/// The shape that shows the graphs.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shown {
    /// A ball.
    #[default]
    Sphere,
    /// A box with rounded edges.
    Cube,
    /// An upright rectangle.
    Plane,
    /// A closed cylinder.
    Cylinder,
    /// A ring that lies on the floor.
    Torus,
    /// The triangles of an OBJ file, brought to the size of the others.
    Obj(PathBuf),
}

/// How high shapes are, in metres.
const HEIGHT: f64 = 1.8;

impl Shown {
    /// Puts the shape in place of the stage's ball.
    fn put(&self, object: &mut scene::Object) {
        // The ball is the stage's own.
        let (shape, height, rotate) = match self {
            Self::Sphere => return,
            Self::Cube => (Shape::Box { size: [1.3; 3], bevel: 0.05 }, 0.65, [0.0, 30.0, 0.0]),
            Self::Plane => (Shape::Plane { size: [HEIGHT; 2], segments: [1, 1] }, HEIGHT / 2.0, [90.0, 0.0, 0.0]),
            Self::Cylinder => {
                let shape =
                    Shape::Cylinder { radius: 0.65, height: 1.6, capped: true, segments: Shape::CYLINDER_SEGMENTS };
                (shape, 0.8, [0.0; 3])
            }
            Self::Torus => {
                let shape = Shape::Torus { major: 0.75, minor: 0.32, segments: Shape::TORUS_SEGMENTS };
                // It leans towards the eye, so that its hole is seen, and rests on the lowest point of its rim.
                let lean: f64 = 40.0;
                (shape, 0.32 + 0.75 * lean.to_radians().sin(), [lean, 0.0, 0.0])
            }
            Self::Obj(path) => {
                object.shape = Shape::Obj(FileReference::new(path.display().to_string()));
                object.transform = scene::Transform::default();
                return;
            }
        };
        object.shape = shape;
        object.transform.translate = [0.0, height, 0.0];
        object.transform.rotate = rotate;
    }
}

/// Stands an object that shows a mesh of any size on the stage's floor, as high or wide as the stage's own shapes.
pub fn stand(object: &mut scene::Object, mesh: &Mesh) {
    let Some(bounds) = Bounds::of_points(mesh.positions.iter().copied()) else { return };
    let extent = (bounds.max - bounds.min).as_dvec3();
    let scale = HEIGHT / extent.max_element().max(1e-9);
    let middle = (bounds.min + bounds.max).as_dvec3() * 0.5 * scale;
    object.transform.scale = [scale; 3];
    object.transform.translate = [-middle.x, -f64::from(bounds.min.y) * scale, -middle.z];
}

/// The scene, ready to be woven.
#[derive(Debug)]
pub struct Stage {
    /// What stands where.
    pub scene: Scene,
    /// Its lights, for graphs that bring none.
    pub lights: Vec<NamedGraph>,
    /// Names and surfaces of the objects other than [`SHOWN`].
    pub others: Vec<(String, NamedGraph)>,
}

/// The stage with a shape on it. It is part of the program, so diagnostics here are faults of the program.
pub fn read(shown: &Shown) -> (Option<Stage>, Vec<Diagnostic>) {
    let (scene, mut found) = scene::read(&SourceText::new("stage.ron", SCENE));
    let Some(mut scene) = scene else { return (None, found) };
    scene.objects.iter_mut().filter(|o| o.name == SHOWN).for_each(|o| shown.put(o));
    let lights: Option<Vec<_>> =
        scene.lights.iter().map(|l| named(&l.graph.path, &l.name, &l.set, &mut found)).collect();
    let others = scene.objects.iter().filter(|o| o.name != SHOWN);
    let others: Option<Vec<_>> = others
        .map(|o| Some((o.name.clone(), named(&o.surface.path, &format!("stage {}", o.name), &o.set, &mut found)?)))
        .collect();
    match (lights, others) {
        (Some(lights), Some(others)) => (Some(Stage { scene, lights, others }), found),
        _ => (None, found),
    }
}

fn named(path: &str, name: &str, set: &Settings, found: &mut Vec<Diagnostic>) -> Option<NamedGraph> {
    let (_, text) = GRAPHS.iter().find(|(known, _)| *known == path)?;
    let (graph, more) = graph::read(&SourceText::new(path, *text));
    found.extend(more);
    let set = set.iter().map(|(port, setting)| (port.clone(), setting.value.clone())).collect();
    Some(NamedGraph { name: name.to_owned(), graph: graph?, set })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compile::{Options, compile};
    use crate::node::Catalog;

    /// Nothing of the stage is unknown to its own program, and its other objects are lit by its own lights.
    #[test]
    fn the_stage_is_read_and_woven_without_a_word() {
        let (stage, found) = read(&Shown::Sphere);
        assert!(found.is_empty(), "{found:?}");
        let stage = stage.expect("a stage");
        assert!(stage.scene.objects.iter().any(|o| o.name == SHOWN));
        let catalog = Catalog::embedded();
        for (name, surface) in stage.others {
            let graphs: Vec<_> = stage.lights.iter().cloned().chain([surface]).collect();
            let (compiled, found) = compile(&graphs, &catalog, &Options::default());
            assert!(found.is_empty(), "{name}: {found:?}");
            assert_eq!(compiled.expect("no errors").plan.lights.len(), stage.lights.len(), "{name}");
        }
    }
}
