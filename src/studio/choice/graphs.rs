//! Light graphs with the shadow that was chosen, and scenes that mention them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::choose::Candidate;
use crate::graph::{End, Graph, Link, Node};
use crate::node::Catalog;
use crate::scene::{Environment, FileReference, Scene, Setting, Shape};
use crate::semantic::Value;
use crate::studio::load::{absolute, relative};
use crate::studio::measure::is_shadow;

/// Options of a light that bend its maps, which a choice does not know.
const BENDS: &str = "warp";

/// A light graph whose shadows, however many, are replaced by one, or by none.
pub fn rewritten(graph: &Graph, light: &str, catalog: &Catalog, chosen: Option<&Candidate>) -> Graph {
    let mut made = graph.clone();
    let shadows: Vec<String> =
        graph.nodes.iter().filter(|(_, n)| is_shadow(catalog, &n.kind)).map(|(name, _)| name.clone()).collect();
    let is_old = |name: &String| shadows.contains(name);
    // The one that others follow keeps its name, and so do what is linked to it and what the graph exports.
    let last = shadows.iter().find(|s| !graph.links.iter().any(|l| l.from.node == **s && is_old(&l.to.node)));
    let free = || {
        let taken = |name: &String| graph.nodes.contains_key(name) && !is_old(name);
        let other = (2..).map(|n| format!("shadow_{n}")).find(|n| !taken(n)).unwrap_or_default();
        Some("shadow".to_owned()).filter(|n| !taken(n)).unwrap_or(other)
    };
    let name = last.cloned().unwrap_or_else(free);
    let end = if chosen.is_some() { name.clone() } else { light.to_owned() };
    made.nodes.retain(|n, _| !is_old(n));
    made.links.retain(|l| !is_old(&l.to.node));
    for link in &mut made.links {
        let bare = last.is_none() && link.from.node == light && chosen.is_some();
        if is_old(&link.from.node) || bare {
            link.from = End::node(end.clone());
        }
    }
    if made.output.as_ref().is_some_and(|o| is_old(&o.node) || (last.is_none() && o.node == light)) {
        made.output = Some(End::node(end));
    }
    made.expose.outputs.retain(|_, end| !is_old(&end.node));
    for ends in made.expose.inputs.values_mut().chain(made.expose.options.values_mut()) {
        ends.retain(|end| !is_old(&end.node));
    }
    made.expose.inputs.retain(|_, ends| !ends.is_empty());
    made.expose.options.retain(|_, ends| !ends.is_empty());
    made.layout.retain(|n, _| made.nodes.contains_key(n) || *n == name);
    made.collapsed.retain(|n| made.nodes.contains_key(n) || *n == name);
    made.waypoints.retain(|(from, to), _| !is_old(&from.node) && !is_old(&to.node));
    if let Some(lamp) = made.nodes.get_mut(light) {
        lamp.options.remove(BENDS);
        lamp.options.remove("splits");
        if let Some(candidate) = chosen.filter(|c| c.parts > 1) {
            lamp.options.insert("splits".into(), candidate.parts.to_string());
        }
    }
    if let Some(candidate) = chosen {
        let node = Node {
            kind: candidate.kind.into(),
            options: candidate.options.iter().map(|(n, v)| ((*n).to_owned(), v.clone())).collect(),
            params: candidate.params.iter().map(|(n, v)| ((*n).to_owned(), Value::Numbers(vec![*v]))).collect(),
            ..Node::default()
        };
        made.nodes.insert(name.clone(), node);
        made.links.push(Link::new(End::node(light), End::node(name)));
        made.links.sort_by(|a, b| (&a.from, &a.to).cmp(&(&b.from, &b.to)));
    } else {
        made.layout.remove(&name);
        made.collapsed.remove(&name);
    }
    made
}

/// What a scene sets on a light, without what it sets on nodes that the chosen graph has no more, or has anew.
pub fn settings_for(set: &BTreeMap<String, Setting>, graph: &Graph, catalog: &Catalog) -> BTreeMap<String, Setting> {
    let kept = |path: &str| {
        let node = path.rsplit_once('.').and_then(|(node, _)| graph.nodes.get(node));
        node.is_some_and(|n| !is_shadow(catalog, &n.kind))
    };
    set.iter().filter(|(path, _)| kept(path)).map(|(path, setting)| (path.clone(), setting.clone())).collect()
}

/// A scene in another folder, with other files for some of its lights (by name; paths as that folder has them): all other
/// paths lead where they led.
pub fn scene_with(
    scene: &Scene,
    file: &Path,
    folder: &Path,
    lights: &BTreeMap<String, (String, Graph)>,
    catalog: &Catalog,
) -> Scene {
    let mut made = scene.clone();
    let moved = |reference: &mut FileReference| {
        let target = absolute(&relative(&reference.path, &file.display().to_string()));
        reference.path = between(&absolute(folder), &target);
        reference.span = None;
    };
    for light in &mut made.lights {
        match lights.get(&light.name) {
            Some((path, graph)) => {
                light.graph = FileReference::new(path.clone());
                light.set = settings_for(&light.set, graph, catalog);
            }
            None => moved(&mut light.graph),
        }
    }
    for object in &mut made.objects {
        moved(&mut object.surface);
        if let Shape::Obj(reference) = &mut object.shape {
            moved(reference);
        }
    }
    if let Environment::Image { image, .. } = &mut made.environment {
        moved(image);
    }
    made
}

/// The way from a folder to a file, both absolute, with `/` between folders.
fn between(folder: &Path, target: &Path) -> String {
    let (from, to): (Vec<_>, Vec<_>) = (folder.components().collect(), target.components().collect());
    let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    if common == 0 {
        return target.display().to_string();
    }
    let up = std::iter::repeat_n(PathBuf::from(".."), from.len() - common);
    let down = to[common..].iter().map(|c| PathBuf::from(c.as_os_str()));
    let parts: Vec<String> = up.chain(down).map(|p| p.display().to_string()).collect();
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choose::{Demand, candidates};
    use crate::diagnostic::SourceText;
    use crate::graph;

    fn read(text: &str) -> Graph {
        graph::read(&SourceText::new("a.ron", text)).0.expect("a graph")
    }

    fn some() -> Candidate {
        let demand = Demand { sides: vec![256], parts: vec![2], penumbra: [0.0; 2], footprint: 0.0, soft: false };
        candidates(&demand).remove(0)
    }

    #[test]
    fn two_shadows_become_one_or_none() {
        let old = read(
            "Graph(version: 1, nodes: {\"sun\": (kind: \"directional_light\", options: {\"warp\": \"perspective\"}), \
             \"a\": (kind: \"pcf_shadow\"), \"b\": (kind: \"variance_shadow\", params: {\"bleeding_reduction\": 0.2})}, \
             links: [\"sun -> a\", \"a -> b\"], output: \"b\")",
        );
        let catalog = Catalog::embedded();
        let one = rewritten(&old, "sun", &catalog, Some(&some()));
        assert_eq!(one.nodes.keys().collect::<Vec<_>>(), ["b", "sun"]);
        assert_eq!(one.nodes["b"].kind, "hard_shadow");
        assert_eq!(one.nodes["sun"].options, BTreeMap::from([("splits".to_owned(), "2".to_owned())]));
        assert_eq!(one.output, Some(End::node("b")));
        let text = graph::write(&one);
        assert!(text.contains("\"sun -> b\""), "{text}");
        assert_eq!(graph::write(&read(&text)), text, "the text is canonical");
        let none = rewritten(&old, "sun", &catalog, None);
        assert_eq!(none.nodes.keys().collect::<Vec<_>>(), ["sun"]);
        assert!(none.links.is_empty() && none.output == Some(End::node("sun")));
    }

    #[test]
    fn a_light_without_a_shadow_gets_one() {
        let old = read("Graph(version: 1, nodes: {\"shadow\": (kind: \"spot_light\")})");
        let one = rewritten(&old, "shadow", &Catalog::embedded(), Some(&some()));
        assert_eq!(one.nodes.keys().collect::<Vec<_>>(), ["shadow", "shadow_2"]);
        assert_eq!(one.links.len(), 1);
    }

    #[test]
    fn ways_between_folders_lead_back() {
        assert_eq!(between(Path::new("/a/b"), Path::new("/a/c/d.ron")), "../c/d.ron");
        assert_eq!(between(Path::new("/a"), Path::new("/a/d.ron")), "d.ron");
    }
}
