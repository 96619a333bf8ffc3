//! Where the parts of a node's card lie, in points of the plane. Knows documents and no screen.

use std::collections::{BTreeMap, BTreeSet, HashMap};
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

/// What is known of a card for as long as the structure of the document stays.
struct Known {
    name: String,
    /// Its size when it is not collapsed.
    size: Vec2,
    /// Family of the node.
    category: Arc<str>,
    muted: bool,
}

/// A card as it lies on the plane.
#[derive(Clone, Copy)]
pub(super) struct Lying<'a> {
    pub(super) name: &'a str,
    pub(super) rect: Rect,
    /// Family of the node; empty if it is not known.
    pub(super) category: &'a Arc<str>,
    pub(super) muted: bool,
    pub(super) selected: bool,
}

/// What is known of the cards of a document, kept until it changes. In the order of their names, so that walks over all
/// of them look up none.
#[derive(Default)]
pub(in crate::gui) struct Cards {
    structure: Option<u64>,
    values: Option<u64>,
    thumbnails: bool,
    known: Vec<Known>,
    index: HashMap<String, usize>,
    /// Cards at the ends of each link, in the links' order.
    ends: Vec<Option<(usize, usize)>>,
    auto: BTreeMap<String, [f64; 2]>,
    views: HashMap<String, Arc<NodeView>>,
    /// Where cards lie, at one revision of the document.
    rects: Vec<Rect>,
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
        let graph = document.graph();
        if self.structure != Some(structure) || self.thumbnails != thumbnails {
            self.structure = Some(structure);
            self.thumbnails = thumbnails;
            self.revision = None;
            self.views.clear();
            self.auto.clear();
            self.know(graph, catalog, subgraphs);
        }
        if self.revision != Some(document.revision()) {
            self.revision = Some(document.revision());
            if graph.nodes.keys().any(|n| !graph.layout.contains_key(n) && !self.auto.contains_key(n)) {
                self.auto = crate::view::placed(graph, &|name| self.size_of(graph, name));
            }
            self.place(graph);
        }
        let values = document.value_revision();
        if self.values != Some(values) {
            self.values = Some(values);
            self.views.clear();
        }
    }

    fn know(&mut self, graph: &Graph, catalog: &Catalog, subgraphs: Subgraphs<'_>) {
        // Of equal kinds with equal choices the ports are counted once.
        type Sort<'a> = (&'a str, &'a BTreeMap<String, String>);
        let mut counted: BTreeMap<Sort<'_>, (usize, Arc<str>)> = BTreeMap::new();
        self.known.clear();
        for (name, node) in &graph.nodes {
            let plain = node.graph.is_none() && node.wgsl.is_none() && catalog.get(&node.kind).is_some();
            let (rows, category) = match counted.get(&(node.kind.as_str(), &node.options)).filter(|_| plain) {
                Some(found) => found.clone(),
                None => {
                    let view = node_view(graph, catalog, name, node.graph.as_deref().and_then(subgraphs).as_deref());
                    let found = (rows(&view), Arc::from(view.category.as_str()));
                    if plain {
                        counted.insert((&node.kind, &node.options), found.clone());
                    }
                    found
                }
            };
            let picture = if self.thumbnails { THUMBNAIL + FOOT } else { 0.0 };
            #[allow(clippy::cast_precision_loss, reason = "a node has few ports")]
            let height = TITLE + rows as f32 * ROW + FOOT + picture;
            self.known.push(Known { name: name.clone(), size: vec2(WIDTH, height), category, muted: node.muted });
        }
        self.index = self.known.iter().enumerate().map(|(i, card)| (card.name.clone(), i)).collect();
        let card = |end: &End| self.index.get(&end.node).copied();
        self.ends = graph.links.iter().map(|l| card(&l.from).zip(card(&l.to))).collect();
    }

    fn place(&mut self, graph: &Graph) {
        // Nodes and places are sorted alike.
        let mut places = graph.layout.iter().peekable();
        self.rects.clear();
        for card in &self.known {
            while places.next_if(|(name, _)| **name < card.name).is_some() {}
            let place = places.next_if(|(name, _)| **name == card.name).map(|(_, place)| *place);
            let place = place.or_else(|| self.auto.get(&card.name).copied()).unwrap_or_default();
            let collapsed = !graph.collapsed.is_empty() && graph.collapsed.contains(&card.name);
            let size = if collapsed { vec2(card.size.x, TITLE) } else { card.size };
            self.rects.push(Rect::from_min_size(at(place), size));
        }
    }

    /// Size of a card in points of the plane.
    pub(in crate::gui) fn size(&self, graph: &Graph, name: &str) -> Vec2 {
        let size = self.index.get(name).map_or(vec2(WIDTH, TITLE), |i| self.known[*i].size);
        if graph.collapsed.contains(name) { vec2(size.x, TITLE) } else { size }
    }

    /// The same for documents' own layouts.
    pub(in crate::gui) fn size_of(&self, graph: &Graph, name: &str) -> [f64; 2] {
        let size = self.size(graph, name);
        [f64::from(size.x), f64::from(size.y)]
    }

    /// Where a card lies: as it was when this was last brought up to date, for those that were there.
    pub(in crate::gui) fn rect(&self, graph: &Graph, name: &str) -> Rect {
        let found = self.index.get(name).and_then(|i| self.rects.get(*i));
        found.copied().unwrap_or_else(|| {
            let place = graph.layout.get(name).or_else(|| self.auto.get(name)).copied().unwrap_or_default();
            Rect::from_min_size(at(place), self.size(graph, name))
        })
    }

    /// All cards as they lay when this was last brought up to date, by name.
    pub(super) fn lying<'a>(&'a self, selection: &'a BTreeSet<String>) -> impl Iterator<Item = Lying<'a>> {
        let mut chosen = selection.iter().peekable();
        self.known.iter().zip(&self.rects).map(move |(card, rect)| {
            while chosen.next_if(|name| **name < card.name).is_some() {}
            let selected = chosen.next_if(|name| **name == card.name).is_some();
            Lying { name: &card.name, rect: *rect, category: &card.category, muted: card.muted, selected }
        })
    }

    /// Where the cards lie at the ends of each link of the document that this was last brought up to date with.
    pub(super) fn ends(&self) -> impl Iterator<Item = Option<(Rect, Rect)>> {
        self.ends.iter().map(|ends| ends.map(|(from, to)| (self.rects[from], self.rects[to])))
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
        self.rects.iter().copied().chain(frames).reduce(Rect::union)
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
