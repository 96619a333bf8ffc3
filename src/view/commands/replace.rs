//! Another graph in the place of one, as a step that can be taken back.

use crate::graph::{Edit, Graph, write};

/// What makes a graph into another. None where fields that are not known here differ: no edit says those.
pub fn replace(graph: &Graph, with: &Graph) -> Option<Edit> {
    let fields = |graph: &Graph| {
        let bare = Graph { unknown: graph.unknown.clone(), ..Graph::default() };
        write(&bare)
    };
    if fields(graph) != fields(with) {
        return None;
    }
    let mut edits: Vec<Edit> = graph.nodes.keys().cloned().map(Edit::RemoveNode).collect();
    edits.extend(graph.frames.keys().map(|name| Edit::SetFrame(name.clone(), None)));
    edits.extend(with.nodes.iter().map(|(name, node)| Edit::AddNode(name.clone(), Box::new(node.clone()))));
    edits.extend(with.links.iter().map(|link| Edit::Link(Box::new(link.clone()))));
    edits.extend(with.layout.iter().map(|(name, at)| Edit::Move(name.clone(), Some(*at))));
    edits.extend(with.frames.iter().map(|(name, frame)| Edit::SetFrame(name.clone(), Some(Box::new(frame.clone())))));
    edits.extend(with.collapsed.iter().map(|name| Edit::SetCollapsed(name.clone(), true)));
    let bends = with.waypoints.iter();
    edits.extend(bends.map(|((from, to), bends)| Edit::SetWaypoints(from.clone(), to.clone(), bends.clone())));
    edits.push(Edit::SetOutput(with.output.clone()));
    edits.push(Edit::SetExpose(Box::new(with.expose.clone())));
    edits.push(Edit::SetName(with.name.clone()));
    edits.push(Edit::SetNote(with.note.clone()));
    Some(Edit::Batch(edits))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::SourceText;
    use crate::graph::read;
    use crate::view::Document;

    fn graph(text: &str) -> Graph {
        read(&SourceText::new("a.ron", text)).0.expect("a graph")
    }

    #[test]
    fn one_graph_becomes_another_and_back() {
        let one = graph(
            "Graph(version: 1, name: \"A\", nodes: {\"a\": (kind: \"lambert\"), \"n\": (kind: \"sine\")}, links: [\"n -> a\"], layout: {\"a\": (1, 2)}, frames: {\"f\": (at: (0, 0), size: (10, 10))})",
        );
        let other = graph(
            "Graph(version: 1, note: \"B\", nodes: {\"a\": (kind: \"ggx\"), \"m\": (kind: \"sine\")}, links: [\"m -> a.roughness\"], output: \"a\", collapsed: [\"m\"])",
        );
        let mut document = Document::new(one.clone());
        document.change("Replace", replace(&one, &other).expect("an edit")).expect("made");
        assert_eq!(document.text(), write(&other));
        document.undo();
        assert_eq!(document.text(), write(&one));
        let odd = graph("Graph(version: 1, nodes: {}, future: 3)");
        assert!(replace(&one, &odd).is_none());
    }
}
