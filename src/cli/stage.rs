//! What graphs are shown on when no scene is given: a scene and the graphs that it uses, inside the program.

use crate::compile::NamedGraph;
use crate::diagnostic::{Diagnostic, SourceText};
use crate::graph;
use crate::scene::{self, Scene, Settings};

const SCENE: &str = include_str!("stage.ron");
/// The graphs that the stage mentions, by its paths.
const GRAPHS: [(&str, &str); 2] = [
    ("spot_soft.ron", include_str!("../../graphs/lights/spot_soft.ron")),
    ("studio_floor.ron", include_str!("../../graphs/surfaces/studio_floor.ron")),
];
/// The object that shows the graphs of the command line; the others have surfaces of their own.
pub(super) const SHOWN: &str = "ball";

/// The scene, ready to be woven.
#[derive(Debug)]
pub(super) struct Stage {
    pub(super) scene: Scene,
    /// Its lights, for graphs that bring none.
    pub(super) lights: Vec<NamedGraph>,
    /// Names and surfaces of the objects other than [`SHOWN`].
    pub(super) others: Vec<(String, NamedGraph)>,
}

/// The stage. It is part of the program, so diagnostics here are faults of the program.
pub(super) fn read() -> (Option<Stage>, Vec<Diagnostic>) {
    let (scene, mut found) = scene::read(&SourceText::new("stage.ron", SCENE));
    let Some(scene) = scene else { return (None, found) };
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
        let (stage, found) = read();
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
