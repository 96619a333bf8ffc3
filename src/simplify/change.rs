//! Graphs with a swap made. Links name their ports here, so that no swap moves a link to another port.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::swap::{Swap, What};
use crate::graph::{Edit, End, Graph, Link, Node, apply};
use crate::node::{Catalog, Choices, Default, Definition, Formula, Known, Port};
use crate::semantic::{Kind, Quantity, Shape, Value};
use crate::view::commands::{free_name, swap_kind};

/// What outputs come to on average, in linear light, by node and output. A number has it in the first component.
pub type Means = BTreeMap<(String, String), [f64; 3]>;

/// The graph with the swap made, and without the nodes that nothing follows any longer. None where it cannot be made:
/// where a value would have to be computed for every point, or something of a file is not as it was declared.
pub fn made(graph: &Graph, catalog: &Catalog, swap: &Swap, means: &Means) -> Option<Graph> {
    let sinks: BTreeSet<String> = sinks(graph).map(str::to_owned).collect();
    let mut after = graph.clone();
    let change = Change { catalog, node: &swap.node, definition: definition(graph, catalog, &swap.node)? };
    match &swap.what {
        What::Choose(option, choice) => {
            let edit = Edit::SetOption { node: swap.node.clone(), option: option.clone(), value: Some(choice.clone()) };
            apply(&mut after, edit).ok()?;
        }
        What::Become(kind, inputs) => change.become_kind(&mut after, kind, inputs)?,
        What::Pass(input) => change.pass(&mut after, input)?,
        What::Mean => change.mean(&mut after, means)?,
        What::Vertex => change.vertex(&mut after)?,
    }
    prune(&mut after, &sinks);
    Some(after)
}

/// The outputs whose averages the swaps of a graph need: colours and numbers that feed something.
pub fn wanted_means(graph: &Graph, catalog: &Catalog, swaps: &[Swap]) -> Vec<(String, String)> {
    let mut wanted = BTreeSet::new();
    for swap in swaps.iter().filter(|s| s.what == What::Mean) {
        let Some(definition) = definition(graph, catalog, &swap.node) else { continue };
        let links = graph.links.iter().filter(|l| l.from.node == swap.node);
        for port in links.filter_map(|l| definition.output(l.from.port.as_deref()?)) {
            if constant(port).is_some() {
                wanted.insert((swap.node.clone(), port.name.clone()));
            }
        }
    }
    wanted.into_iter().collect()
}

fn definition(graph: &Graph, catalog: &Catalog, node: &str) -> Option<Arc<Definition>> {
    let node = graph.nodes.get(node)?;
    catalog.get(&node.kind)?.definition(&node.options).ok()
}

/// Nodes that nothing follows.
fn sinks(graph: &Graph) -> impl Iterator<Item = &str> {
    let followed: BTreeSet<&String> = graph.links.iter().map(|l| &l.from.node).collect();
    graph.nodes.keys().filter(move |name| !followed.contains(name)).map(String::as_str)
}

/// Takes out what nothing follows any longer, but not what nothing followed before.
fn prune(graph: &mut Graph, before: &BTreeSet<String>) {
    loop {
        let kept = |name: &str| {
            before.contains(name)
                || graph.output.as_ref().is_some_and(|end| end.node == name)
                || graph.expose.outputs.values().any(|end| end.node == name)
        };
        let gone: Vec<String> = sinks(graph).filter(|name| !kept(name)).map(str::to_owned).collect();
        if gone.is_empty() {
            return;
        }
        for name in gone {
            if apply(graph, Edit::RemoveNode(name)).is_err() {
                return;
            }
        }
    }
}

/// The kind of node that holds a value like this output, with its input and output.
fn constant(port: &Port) -> Option<(&'static str, &'static str, &'static str)> {
    match (&port.ty.shape, port.ty.meaning.kind) {
        (Shape::F32(1), _) => Some(("value", "value", "value")),
        // Light is no colour of a thing.
        (Shape::F32(3), Kind::Color) if port.ty.meaning.quantity != Quantity::Radiance => {
            Some(("color", "color", "color"))
        }
        _ => None,
    }
}

/// The sRGB transfer curve (IEC 61966-2-1): colour nodes hold what screens take.
fn srgb_from_linear(x: f64) -> f64 {
    if x <= 0.003_130_8 { x * 12.92 } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

/// Enough digits to be exact on any screen, and few enough to be read.
fn rounded(x: f64) -> f64 {
    (x * 1e4).round() / 1e4
}

struct Change<'a> {
    catalog: &'a Catalog,
    node: &'a str,
    definition: Arc<Definition>,
}

impl Change<'_> {
    fn links<'g>(&self, graph: &'g Graph) -> (Vec<&'g Link>, Vec<&'g Link>) {
        let to = graph.links.iter().filter(|l| l.to.node == self.node).collect();
        (to, graph.links.iter().filter(|l| l.from.node == self.node).collect())
    }

    fn become_kind(&self, graph: &mut Graph, kind: &str, inputs: &[(String, Formula)]) -> Option<()> {
        let new = self.catalog.get(kind)?.definition(&Choices::new()).ok()?;
        let known = |name: &str| self.known(graph, name);
        let ports: Option<Vec<_>> = inputs.iter().map(|(port, f)| Some((port, f.reduce(&known)?))).collect();
        let mut edits = Vec::new();
        let (incoming, _) = self.links(graph);
        for link in &incoming {
            if link.to.port.as_ref().is_some_and(|port| new.input(port).is_none_or(|p| p.hidden)) {
                edits.push(Edit::Unlink(link.from.clone(), link.to.clone()));
            }
        }
        let mut values = Vec::new();
        for (port, known) in ports? {
            new.input(port).filter(|p| !p.hidden)?;
            // What the formula says stands before what a port of the same name was fed.
            let same = |l: &&&Link| l.to.port.as_ref() == Some(port);
            edits.extend(incoming.iter().filter(same).map(|l| Edit::Unlink(l.from.clone(), l.to.clone())));
            match known {
                Known::Numbers(numbers) => {
                    values.push((port, Some(Value::Numbers(numbers.into_iter().map(rounded).collect()))));
                }
                Known::Input(input) => {
                    let feeds = incoming.iter().find(|l| l.to.port.as_ref() == Some(&input))?;
                    let link = Link::new(feeds.from.clone(), End::port(self.node, port.as_str()));
                    edits.push(Edit::Link(Box::new(link)));
                    values.push((port, None));
                }
            }
        }
        // Without their links first, so that swapping the kind finds no other port for them.
        let (unlink, link): (Vec<Edit>, Vec<Edit>) = edits.into_iter().partition(|e| matches!(e, Edit::Unlink(..)));
        apply(graph, Edit::Batch(unlink)).ok()?;
        let swap = swap_kind(graph, self.catalog, self.node, kind);
        apply(graph, swap).ok()?;
        for (param, value) in values {
            let set = Edit::SetParam { node: self.node.to_owned(), param: param.clone(), value };
            apply(graph, set).ok()?;
        }
        apply(graph, Edit::Batch(link)).ok().map(drop)
    }

    /// What is known of an input: the numbers that it is set to, or that it is fed by something.
    fn known(&self, graph: &Graph, name: &str) -> Option<Known> {
        let (incoming, _) = self.links(graph);
        if incoming.iter().any(|l| l.to.port.as_deref() == Some(name)) {
            return Some(Known::Input(name.to_owned()));
        }
        let port = self.definition.input(name)?;
        let value = graph.nodes.get(self.node)?.params.get(name);
        let default = match &port.default {
            Some(Default::Value(value)) => Some(value),
            _ => None,
        };
        let numbers = value.or(default)?.numbers()?;
        // Formulas are about linear light and radians.
        let scaled = port.unit.is_empty() || port.unit == "m";
        scaled.then(|| Known::Numbers(numbers.to_vec()))
    }

    fn pass(&self, graph: &mut Graph, input: &str) -> Option<()> {
        let (incoming, outgoing) = self.links(graph);
        let source = incoming.iter().find(|l| l.to.port.as_deref() == Some(input)).map(|l| l.from.clone());
        let mut edits = Vec::new();
        for link in outgoing {
            edits.push(Edit::Unlink(link.from.clone(), link.to.clone()));
            match &source {
                Some(from) => {
                    // What was lit through two ways stays linked once.
                    let known = graph.links.iter().any(|l| l.from == *from && l.to == link.to);
                    let new = Link::new(from.clone(), link.to.clone());
                    edits.extend((!known).then(|| Edit::Link(Box::new(new))));
                }
                None => self.falls_back(graph, input, &link.to)?,
            }
        }
        if graph.output.as_ref().is_some_and(|end| end.node == self.node) {
            edits.push(Edit::SetOutput(Some(source?)));
        } else if graph.expose.ends().any(|end| end.node == self.node) {
            return None;
        }
        edits.push(Edit::RemoveNode(self.node.to_owned()));
        apply(graph, Edit::Batch(edits)).ok().map(drop)
    }

    /// Whether an input that is fed no longer takes by itself what the node would have taken.
    fn falls_back(&self, graph: &Graph, input: &str, to: &End) -> Option<()> {
        let Some(Default::Source(own)) = &self.definition.input(input)?.default else { return None };
        let target = definition(graph, self.catalog, &to.node)?;
        let Some(Default::Source(other)) = &target.input(to.port.as_deref()?)?.default else { return None };
        let set = graph.nodes.get(&to.node)?.params.contains_key(to.port.as_deref()?);
        (own == other && !set).then_some(())
    }

    /// Puts a node that is computed for each vertex behind every output. None where one stands there.
    fn vertex(&self, graph: &mut Graph) -> Option<()> {
        let rate = self.catalog.files().find(|file| file.header().is_ok_and(|h| h.vertex))?;
        let definition = rate.definition(&Choices::new()).ok()?;
        let (input, output) = (definition.inputs().next()?.name.clone(), definition.main.outputs.first()?.name.clone());
        let is_rate = |end: &End| graph.nodes.get(&end.node).is_some_and(|n| n.kind == rate.kind());
        let mut feeds: BTreeMap<&End, Vec<&End>> = BTreeMap::new();
        for link in self.links(graph).1 {
            if is_rate(&link.to) {
                return None;
            }
            self.definition.output(link.from.port.as_deref()?).filter(|p| matches!(p.ty.shape, Shape::F32(_)))?;
            feeds.entry(&link.from).or_default().push(&link.to);
        }
        let mut edits = Vec::new();
        for (index, (from, targets)) in feeds.iter().enumerate() {
            let number = if index > 0 { format!(" {}", index + 1) } else { String::new() };
            let name = free_name(graph, &format!("{} per vertex{number}", self.node));
            let node = Node { kind: rate.kind().to_owned(), ..Node::default() };
            edits.push(Edit::AddNode(name.clone(), Box::new(node)));
            let mut link = |from: End, to: End| edits.push(Edit::Link(Box::new(Link::new(from, to))));
            link((*from).clone(), End::port(name.as_str(), input.as_str()));
            targets.iter().for_each(|to| link(End::port(name.as_str(), output.as_str()), (*to).clone()));
            edits.extend(targets.iter().map(|to| Edit::Unlink((*from).clone(), (*to).clone())));
        }
        if edits.is_empty() {
            return None;
        }
        apply(graph, Edit::Batch(edits)).ok().map(drop)
    }

    fn mean(&self, graph: &mut Graph, means: &Means) -> Option<()> {
        let is_own = |end: &End| end.node == self.node;
        if graph.output.as_ref().is_some_and(is_own) || graph.expose.ends().any(is_own) {
            return None;
        }
        let mut feeds: BTreeMap<String, Vec<End>> = BTreeMap::new();
        for link in self.links(graph).1 {
            feeds.entry(link.from.port.clone()?).or_default().push(link.to.clone());
        }
        let kind = graph.nodes.get(self.node)?.kind.clone();
        let place = graph.layout.get(self.node).copied();
        apply(graph, Edit::RemoveNode(self.node.to_owned())).ok()?;
        let several = feeds.len() > 1;
        for (index, (output, targets)) in feeds.into_iter().enumerate() {
            let port = self.definition.output(&output)?;
            let (constant, input, result) = constant(port)?;
            let mean = means.get(&(self.node.to_owned(), output.clone()))?;
            let numbers = match constant {
                "color" => mean.iter().map(|x| rounded(srgb_from_linear(x.max(0.0)))).collect(),
                _ => vec![rounded(mean[0])],
            };
            let node = Node {
                kind: constant.to_owned(),
                params: BTreeMap::from([(input.to_owned(), Value::Numbers(numbers))]),
                note: format!("The mean of `{output}` of a node of kind `{kind}`."),
                ..Node::default()
            };
            let wanted = if several { format!("{} {output}", self.node) } else { self.node.to_owned() };
            let name = free_name(graph, &wanted);
            let mut edits = vec![Edit::AddNode(name.clone(), Box::new(node))];
            let offset = 40.0 * f64::from(u32::try_from(index).unwrap_or(0));
            edits.extend(place.map(|[x, y]| Edit::Move(name.clone(), Some([x, y + offset]))));
            let link = |to| Edit::Link(Box::new(Link::new(End::port(name.as_str(), result), to)));
            edits.extend(targets.into_iter().map(link));
            apply(graph, Edit::Batch(edits)).ok()?;
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::SourceText;
    use crate::graph::write;
    use crate::simplify::swaps;

    fn graph(nodes: &str, links: &str) -> Graph {
        let text = format!("Graph(version: 1, nodes: {{{nodes}}}, links: [{links}], output: \"look\")");
        let (graph, found) = crate::graph::read(&SourceText::new("a.ron", text));
        assert_eq!(found, []);
        graph.expect("a graph")
    }

    /// The graph after the swap of this name.
    fn after(graph: &Graph, name: &str, means: &Means) -> Option<String> {
        let catalog = Catalog::embedded();
        let all = swaps(graph, &catalog);
        let swap = all.iter().find(|s| s.name() == name);
        let swap = swap.unwrap_or_else(|| panic!("{name}: {:?}", all.iter().map(Swap::name).collect::<Vec<_>>()));
        made(graph, &catalog, swap, means).as_ref().map(write)
    }

    const STONE: &str = "\"look\": (kind: \"ggx\", params: {\"roughness\": 0.5}), \"veins\": (kind: \"marble\")";

    #[test]
    fn another_kind_takes_what_formulas_say() {
        let fed = graph(STONE, "\"veins.color -> look.base_color\"");
        let text = after(&fed, "look: blinn_phong", &Means::new()).expect("made");
        assert!(text.contains("kind: \"blinn_phong\", params: {\"shininess\": 30, \"specular\": 0.04}"), "{text}");
        assert!(text.contains("\"veins.color -> look.albedo\""), "{text}");
        // Half a metal would need its colour to be computed for every point.
        let metal = STONE.replace("\"roughness\"", "\"metallic\": 0.5, \"roughness\"");
        assert_eq!(
            after(&graph(&metal, "\"veins.color -> look.base_color\""), "look: blinn_phong", &Means::new()),
            None
        );
        let text = after(&graph(&metal, ""), "look: blinn_phong", &Means::new()).expect("made");
        assert!(
            text.contains("\"albedo\": (0.4, 0.4, 0.4)") && text.contains("\"specular\": (0.42, 0.42, 0.42)"),
            "{text}"
        );
    }

    #[test]
    fn means_stand_for_what_they_are_the_means_of() {
        let fed = graph(STONE, "\"veins.color -> look.base_color\", \"veins.vein -> look.metallic\"");
        let mean = |output: &str, x| (("veins".to_owned(), output.to_owned()), [x; 3]);
        let means = Means::from([mean("color", 0.5), mean("vein", 0.25)]);
        let catalog = Catalog::embedded();
        let wanted = wanted_means(&fed, &catalog, &swaps(&fed, &catalog));
        assert_eq!(wanted, means.keys().cloned().collect::<Vec<_>>());
        let text = after(&fed, "veins: its mean", &means).expect("made");
        assert!(
            text.contains("\"veins color\": (kind: \"color\", params: {\"color\": (0.7354, 0.7354, 0.7354)}"),
            "{text}"
        );
        assert!(text.contains("\"veins vein.value -> look.metallic\"") && !text.contains("kind: \"marble\""), "{text}");
        assert_eq!(after(&fed, "veins: its mean", &Means::new()), None);
    }

    #[test]
    fn what_feeds_an_input_stands_for_the_node_and_leaves_nothing_behind() {
        let nodes = "\"look\": (kind: \"clear_coat\"), \"paint\": (kind: \"lambert\"), \"bump\": (kind: \"bump\"), \"n\": (kind: \"fbm3d\")";
        let coat = graph(
            nodes,
            "\"paint.radiance -> look.base\", \"n.value -> bump.height\", \"bump.normal -> paint.normal\"",
        );
        let text = after(&coat, "look: what feeds base", &Means::new()).expect("made");
        assert!(text.contains("output: \"paint.radiance\"") && !text.contains("clear_coat"), "{text}");
        let text = after(&coat, "bump: what feeds normal", &Means::new()).expect("made");
        assert!(
            !text.contains("bump") && !text.contains("fbm3d") && text.contains("paint.radiance -> look.base"),
            "{text}"
        );
        // A roughness does not fall back to a normal.
        let odd = graph("\"look\": (kind: \"ggx\"), \"bump\": (kind: \"bump\")", "\"bump.normal -> look.base_color\"");
        assert_eq!(after(&odd, "bump: what feeds normal", &Means::new()), None);
    }
}
