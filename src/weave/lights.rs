//! Which lights reach which node, and through which shadows.

use std::collections::{BTreeMap, BTreeSet};

use super::collect::Collected;
use super::{is_light, is_lit, is_shadow, is_surface};
use crate::diagnostic::Diagnostic;

/// For each node: light to the shadows between it and the node (for a shadow, itself included).
pub(crate) type Lights = Vec<BTreeMap<usize, BTreeSet<usize>>>;

/// Follows links from lights through shadows. Two shadows on one light both count, in a row or side by side.
pub(crate) fn follow(collected: &Collected, out: &mut Vec<Diagnostic>) -> Lights {
    let nodes = &collected.nodes;
    let mut lights: Lights = vec![BTreeMap::new(); nodes.len()];
    for (i, node) in nodes.iter().enumerate() {
        let Some(definition) = &node.definition else { continue };
        if is_light(definition) {
            lights[i].insert(i, BTreeSet::new());
            continue;
        }
        let shadow = is_shadow(definition);
        if !shadow && !is_lit(definition) && !is_surface(definition) {
            continue;
        }
        let mut reached: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
        for &link in &collected.incoming[i] {
            let from = collected.links[link].from;
            let lamp = nodes[from].definition.as_ref().is_some_and(|d| is_light(d) || is_shadow(d));
            if lamp {
                for (light, shadows) in &lights[from] {
                    reached.entry(*light).or_default().extend(shadows);
                }
            }
        }
        // A layer that no light is linked to is lit as what lies under it.
        if reached.is_empty() && is_surface(definition) {
            for &link in &collected.incoming[i] {
                let from = collected.links[link].from;
                if nodes[from].definition.as_deref().is_some_and(is_surface) {
                    for (light, shadows) in &lights[from] {
                        reached.entry(*light).or_default().extend(shadows);
                    }
                }
            }
        }
        if shadow {
            // A light that is misspelt has been reported.
            let unknown = collected.incoming[i].iter().any(|l| nodes[collected.links[*l].from].is_doubtful());
            if reached.is_empty() && !unknown && !node.is_doubtful() && definition.inputs().any(needs_light) {
                let message = format!("the shadow `{}` is on no light", node.id);
                let help = format!("link a light to it: `\"LIGHT -> {}\"`", short(&node.id));
                out.push(Diagnostic::error("ST0211", message, collected.place(i)).help(help));
            }
            for shadows in reached.values_mut() {
                shadows.insert(i);
            }
        }
        lights[i] = reached;
    }
    lights
}

fn needs_light(port: &crate::node::Port) -> bool {
    matches!(port.ty.meaning.kind, crate::semantic::Kind::Space | crate::semantic::Kind::Map)
}

/// The name within its own graph.
pub(crate) fn short(id: &str) -> &str {
    id.rsplit('/').next().unwrap_or(id)
}
