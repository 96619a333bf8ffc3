//! Resolved wiring in words: which output feeds which port, through which conversions, light by light.

use std::collections::BTreeSet;

use crate::compile::NamedGraph;
use crate::semantic::{Chain, Step};
use crate::weave::{Node, Wire, Woven};

/// One resolved wire.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Resolved {
    /// The file of the graph that it leads into, as it was named.
    pub graph: String,
    /// The file of the graph that it comes from.
    pub from_graph: String,
    /// Node, as its own graph calls it, and output.
    pub from: (String, String),
    /// Node, as its own graph calls it, and input.
    pub to: (String, String),
    /// What happens on the way, a few words each.
    pub conversions: Vec<String>,
    /// Cost of that; 16 is one vector operation.
    pub cost: u32,
}

/// The wires between the nodes of `graphs`: those that were drawn, those that were found, and for each light the way from
/// it over its shadows to what it shines on.
pub fn wiring(woven: &Woven, graphs: &[NamedGraph]) -> Vec<Resolved> {
    let names: Vec<(String, String)> = woven.nodes.iter().map(|n| own_name(n, graphs)).collect();
    let first_output = |node: usize| woven.nodes[node].definition.main.outputs.first().map(|o| o.name.clone());
    let mut found = BTreeSet::new();
    for (index, node) in woven.nodes.iter().enumerate() {
        let mut add = |from: usize, output: &str, port: &str, conversions: &[String], cost: u32| {
            let ((from_graph, from), (graph, to)) = (names[from].clone(), names[index].clone());
            found.insert(Resolved {
                graph,
                from_graph,
                from: (from, output.to_owned()),
                to: (to, port.to_owned()),
                conversions: conversions.to_vec(),
                cost,
            });
        };
        for (port, wire) in node.inputs.iter() {
            match wire {
                Wire::Output { node: from, output, chain } => add(*from, output, port, &words(chain), chain.cost),
                Wire::Light { output, chain } => {
                    node.lights.keys().for_each(|light| add(*light, output, port, &words(chain), chain.cost));
                }
                Wire::Irradiance => {
                    for (light, shadows) in &node.lights {
                        // Light that passes a shadow arrives from there.
                        let before = if shadows.is_empty() { vec![*light] } else { last(woven, shadows) };
                        for from in before {
                            add(from, &first_output(from).unwrap_or_default(), port, &[], 0);
                        }
                    }
                }
                Wire::Space | Wire::Map => {
                    let word = if matches!(wire, Wire::Map) { "map of the light" } else { "space of the light" };
                    for light in node.lights.keys() {
                        add(*light, &first_output(*light).unwrap_or_default(), port, &[word.to_owned()], 0);
                    }
                }
                _ => {}
            }
        }
    }
    found.into_iter().collect()
}

/// What the steps of a chain do, a few words each.
fn words(chain: &Chain) -> Vec<String> {
    let step = |s: &Step| match s.label {
        "" => format!("taken as {}", s.to),
        label => format!("{label}: {}", s.to),
    };
    chain.steps.iter().map(step).collect()
}

/// Of the shadows on a light's way, those that no other of them lies behind.
fn last(woven: &Woven, shadows: &BTreeSet<usize>) -> Vec<usize> {
    let passed = |shadow: &usize| {
        let behind = |other: &usize| woven.nodes[*other].lights.values().any(|above| above.contains(shadow));
        shadows.iter().any(|other| other != shadow && behind(other))
    };
    shadows.iter().copied().filter(|s| !passed(s)).collect()
}

/// The file of a node's graph, and what the node is called in it.
fn own_name(node: &Node, graphs: &[NamedGraph]) -> (String, String) {
    let file = |g: &NamedGraph| g.graph.source.as_ref().map_or_else(|| g.name.clone(), |s| s.name.clone());
    let id = &*node.id;
    if let [only] = graphs {
        return (file(only), id.to_owned());
    }
    let found = graphs.iter().find_map(|g| {
        let own = id.strip_prefix(&*g.name)?.strip_prefix('/')?;
        g.graph.nodes.contains_key(own).then(|| (file(g), own.to_owned()))
    });
    found.unwrap_or_else(|| (String::new(), id.to_owned()))
}
