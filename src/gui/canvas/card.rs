//! Where the parts of a node's card lie, in points of the plane. Knows documents and no screen.

use std::collections::BTreeMap;
use std::sync::Arc;

use eframe::egui::{Pos2, Rect, Vec2, pos2, vec2};

use super::camera::at;
use crate::graph::{End, Graph};
use crate::node::Catalog;
use crate::view::{Document, NodeView, PortView, arrange, node_view};

/// Height of a card's title.
pub(in crate::gui) const TITLE: f32 = 26.0;
/// Height of a port.
pub(in crate::gui) const ROW: f32 = 20.0;
/// Width of a card.
pub(in crate::gui) const WIDTH: f32 = 196.0;
/// Side of the picture below the ports, where pictures are shown.
pub(in crate::gui) const THUMBNAIL: f32 = 112.0;
const FOOT: f32 = 8.0;

/// Looks up the graph that a node stands for.
pub(in crate::gui) type Subgraphs<'a> = &'a dyn Fn(&str) -> Option<Arc<Graph>>;

/// What is known of the cards of a document, kept until it changes.
#[derive(Default)]
pub(in crate::gui) struct Cards {
    structure: Option<u64>,
    values: Option<u64>,
    thumbnails: bool,
    sizes: BTreeMap<String, Vec2>,
    auto: BTreeMap<String, [f64; 2]>,
    views: BTreeMap<String, Arc<NodeView>>,
    /// Where cards lie, at one revision of the document.
    rects: BTreeMap<String, Rect>,
    revision: Option<u64>,
}

impl Cards {
    /// Brings sizes and places up to date with the document.
    pub(in crate::gui) fn refresh(
        &mut self,
        document: &Document,
        catalog: &Catalog,
        subgraphs: Subgraphs<'_>,
        thumbnails: bool,
    ) {
        let structure = document.structure_revision();
        if self.structure != Some(structure) || self.thumbnails != thumbnails {
            self.structure = Some(structure);
            self.rects.clear();
            self.thumbnails = thumbnails;
            self.views.clear();
            self.sizes.clear();
            let graph = document.graph();
            // Of equal kinds with equal choices the ports are counted once.
            let mut known: BTreeMap<(&str, &BTreeMap<String, String>), usize> = BTreeMap::new();
            for (name, node) in &graph.nodes {
                let plain = node.graph.is_none() && node.wgsl.is_none() && catalog.get(&node.kind).is_some();
                let rows = match known.get(&(node.kind.as_str(), &node.options)).filter(|_| plain) {
                    Some(rows) => *rows,
                    None => {
                        let view =
                            node_view(graph, catalog, name, node.graph.as_deref().and_then(subgraphs).as_deref());
                        let rows = rows(&view);
                        if plain {
                            known.insert((&node.kind, &node.options), rows);
                        }
                        rows
                    }
                };
                let picture = if thumbnails { THUMBNAIL + FOOT } else { 0.0 };
                #[allow(clippy::cast_precision_loss, reason = "a node has few ports")]
                let height = TITLE + rows as f32 * ROW + FOOT + picture;
                self.sizes.insert(name.clone(), vec2(WIDTH, height));
            }
            self.auto.clear();
        }
        if document.graph().nodes.keys().any(|n| !document.graph().layout.contains_key(n) && !self.auto.contains_key(n))
        {
            self.auto = crate::view::placed(document.graph(), &|name| self.size_of(document.graph(), name));
        }
        if self.revision != Some(document.revision()) || self.rects.is_empty() {
            self.revision = Some(document.revision());
            let graph = document.graph();
            self.rects = graph.nodes.keys().map(|name| (name.clone(), self.placed(graph, name))).collect();
        }
        let values = document.value_revision();
        if self.values != Some(values) {
            self.values = Some(values);
            self.views.clear();
        }
    }

    /// Size of a card in points of the plane.
    pub(in crate::gui) fn size(&self, graph: &Graph, name: &str) -> Vec2 {
        let size = self.sizes.get(name).copied().unwrap_or(vec2(WIDTH, TITLE));
        if graph.collapsed.contains(name) { vec2(size.x, TITLE) } else { size }
    }

    /// The same for documents' own layouts.
    pub(in crate::gui) fn size_of(&self, graph: &Graph, name: &str) -> [f64; 2] {
        let size = self.size(graph, name);
        [f64::from(size.x), f64::from(size.y)]
    }

    /// Where a card lies: as it was when this was last brought up to date, for those that were there.
    pub(in crate::gui) fn rect(&self, graph: &Graph, name: &str) -> Rect {
        self.rects.get(name).copied().unwrap_or_else(|| self.placed(graph, name))
    }

    fn placed(&self, graph: &Graph, name: &str) -> Rect {
        let place = graph.layout.get(name).or_else(|| self.auto.get(name)).copied().unwrap_or_default();
        Rect::from_min_size(at(place), self.size(graph, name))
    }

    /// What a card shows.
    pub(in crate::gui) fn view(
        &mut self,
        graph: &Graph,
        catalog: &Catalog,
        subgraphs: Subgraphs<'_>,
        name: &str,
    ) -> Arc<NodeView> {
        if let Some(view) = self.views.get(name) {
            return view.clone();
        }
        let inner = graph.nodes.get(name).and_then(|n| n.graph.as_deref()).and_then(subgraphs);
        let view = Arc::new(node_view(graph, catalog, name, inner.as_deref()));
        self.views.insert(name.to_owned(), view.clone());
        view
    }

    /// The rectangle around all cards and frames.
    pub(in crate::gui) fn bounds(&self, graph: &Graph) -> Option<Rect> {
        let frames = graph.frames.values().map(|f| Rect::from_min_size(at(f.at), at(f.size).to_vec2()));
        graph.nodes.keys().map(|name| self.rect(graph, name)).chain(frames).reduce(Rect::union)
    }

    /// New places for all nodes.
    pub(in crate::gui) fn arranged(&self, graph: &Graph) -> BTreeMap<String, [f64; 2]> {
        arrange(graph, &|name| self.size_of(graph, name))
    }
}

/// Ports of a card that have a row of their own: outputs, then inputs.
pub(in crate::gui) fn rows(view: &NodeView) -> usize {
    outputs(view).count() + inputs(view).count()
}

pub(in crate::gui) fn outputs(view: &NodeView) -> impl Iterator<Item = &PortView> {
    view.outputs.iter().filter(|p| !p.hidden)
}

pub(in crate::gui) fn inputs(view: &NodeView) -> impl Iterator<Item = &PortView> {
    view.inputs.iter().filter(|p| !p.hidden)
}

/// Where a link's end lies on a card: at a port's row, or at the title where it names no port.
pub(in crate::gui) fn anchor(card: Rect, view: Option<&NodeView>, end: &End, leaves: bool) -> Pos2 {
    let x = if leaves { card.right() } else { card.left() };
    let row = view.zip(end.port.as_ref()).and_then(|(view, port)| {
        if leaves {
            outputs(view).position(|p| p.name == *port)
        } else {
            inputs(view).position(|p| p.name == *port).map(|i| i + outputs(view).count())
        }
    });
    // A collapsed card has its title alone.
    let row = row.filter(|_| card.height() > TITLE + 1.0);
    #[allow(clippy::cast_precision_loss, reason = "a node has few ports")]
    let y = row.map_or(TITLE / 2.0, |row| TITLE + (row as f32 + 0.5) * ROW);
    pos2(x, card.top() + y)
}
