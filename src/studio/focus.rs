//! One node of a graph in place of what the graph exports: to see what a wire carries.

use std::collections::BTreeSet;
use std::path::PathBuf;

use crate::graph::{End, Graph};

/// Which node of which graph file is looked at.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Focus {
    /// The graph's file.
    pub graph: PathBuf,
    /// The node.
    pub node: String,
    /// One of its outputs, or the first.
    pub port: Option<String>,
}

impl Focus {
    /// Makes the graph export the node. What does not lead to it is left out, with its mistakes.
    pub(super) fn apply(&self, graph: &mut Graph) {
        let mut kept = BTreeSet::from([self.node.clone()]);
        let mut open = vec![self.node.clone()];
        while let Some(node) = open.pop() {
            for link in graph.links.iter().filter(|l| l.to.node == node) {
                if kept.insert(link.from.node.clone()) {
                    open.push(link.from.node.clone());
                }
            }
        }
        graph.nodes.retain(|name, _| kept.contains(name));
        graph.links.retain(|l| kept.contains(&l.from.node) && kept.contains(&l.to.node) && l.from.node != self.node);
        graph.output = Some(End { node: self.node.clone(), port: self.port.clone() });
        graph.output_span = None;
        graph.expose.inputs.clear();
        graph.expose.outputs.clear();
        graph.expose.options.clear();
    }
}
