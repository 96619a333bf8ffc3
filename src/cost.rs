//! What each node costs a shader, counted in naga's form of the verified module.
//!
//! An operation is a unary or binary operator, a selection, a derivative, a test, a built-in function of numbers or a
//! conversion, whatever the width of what it works on. Reading variables, and taking vectors apart or putting them together,
//! is free. Samples, gathers and loads of textures are counted apart. A function that is called counts for the node whose
//! text calls it, each time that it is called, with all that it calls. A loop counts as often as it turns where its text says
//! how often that is, else once, and both sides of a branch count: these are figures to compare nodes by, not times.

mod turns;

use std::collections::BTreeMap;

use naga::{Expression, Function, Handle, Span, Statement};

use turns::turns;

use crate::module::Module;
use crate::verify::Verified;

/// What a node costs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Operations on numbers and vectors.
    pub operations: u32,
    /// Samples, gathers and loads of textures.
    pub texture_reads: u32,
    /// Whether some of it is done for each vertex.
    pub vertex: bool,
}

impl Cost {
    fn add(&mut self, other: Self) {
        self.operations = self.operations.saturating_add(other.operations);
        self.texture_reads = self.texture_reads.saturating_add(other.texture_reads);
        self.vertex |= other.vertex;
    }

    fn times(self, turns: u32) -> Self {
        Self {
            operations: self.operations.saturating_mul(turns),
            texture_reads: self.texture_reads.saturating_mul(turns),
            ..self
        }
    }
}

/// What all fragment stages of a shader cost, whosever it is.
pub fn total(verified: &Verified) -> Cost {
    let module = &verified.module;
    let mut counter =
        Counter { owners: Vec::new(), module, known: BTreeMap::new(), nodes: BTreeMap::new(), rest: Cost::default() };
    let mut sum = Cost::default();
    for entry in module.entry_points.iter().filter(|e| e.stage == naga::ShaderStage::Fragment) {
        sum.add(counter.total_of(&entry.function));
    }
    sum
}

/// What each node costs, by its name in the source map. What the shader does besides is no node's.
pub fn cost(module: &Module, verified: &Verified) -> BTreeMap<String, Cost> {
    let (nodes, _) = shares(module, verified);
    nodes.into_iter().map(|(node, cost)| (node.to_owned(), cost)).collect()
}

/// What each node costs, and what belongs to none.
fn shares<'a>(module: &'a Module, verified: &Verified) -> (BTreeMap<&'a str, Cost>, Cost) {
    let mut counter = Counter {
        owners: owners(module),
        module: &verified.module,
        known: BTreeMap::new(),
        nodes: BTreeMap::new(),
        rest: Cost::default(),
    };
    for entry in &verified.module.entry_points {
        counter.share(&entry.function, entry.stage == naga::ShaderStage::Vertex, 1);
    }
    (counter.nodes, counter.rest)
}

/// The innermost owner of the bytes from each place on, up to the next place.
fn owners(module: &Module) -> Vec<(usize, Option<&str>)> {
    let mut places = Vec::new();
    let mut open: Vec<(usize, &str)> = Vec::new();
    // Ranges are sorted by their starts, and inner ones follow outer ones.
    let mut all: Vec<(usize, usize, &str)> = module.source_map.iter().map(|o| (o.start, o.end, &*o.node)).collect();
    all.push((usize::MAX, usize::MAX, ""));
    for (start, end, node) in all {
        while let Some(&(last, _)) = open.last().filter(|(end, _)| *end <= start) {
            open.pop();
            places.push((last, open.last().map(|(_, node)| *node)));
        }
        if start < end {
            places.push((start, Some(node)));
            open.push((end, node));
        }
    }
    places
}

struct Counter<'a, 'b> {
    owners: Vec<(usize, Option<&'a str>)>,
    module: &'b naga::Module,
    /// What functions cost with all that they call.
    known: BTreeMap<Handle<Function>, Cost>,
    nodes: BTreeMap<&'a str, Cost>,
    rest: Cost,
}

impl<'a> Counter<'a, '_> {
    fn owner(&self, span: Span) -> Option<&'a str> {
        let start = span.to_range()?.start;
        let next = self.owners.partition_point(|(place, _)| *place <= start);
        self.owners.get(next.checked_sub(1)?)?.1
    }

    /// Shares out what a function does among the nodes in whose text it stands.
    fn share(&mut self, function: &Function, vertex: bool, times: u32) {
        let module = self.module;
        for (done, span, turns) in work(module, function) {
            let turns = turns.saturating_mul(times);
            match done {
                Work::Own(own) => {
                    let cost = Cost { vertex, ..own }.times(turns);
                    self.give(self.owner(span), cost);
                }
                Work::Call(callee) => match self.owner(span) {
                    Some(node) => {
                        let total = Cost { vertex, ..self.total(callee) }.times(turns);
                        self.give(Some(node), total);
                    }
                    // A part of the stage that is a function of its own, or what no node asked for.
                    None => self.share(&module.functions[callee], vertex, turns),
                },
            }
        }
    }

    fn give(&mut self, node: Option<&'a str>, cost: Cost) {
        match node {
            Some(node) => self.nodes.entry(node).or_default().add(cost),
            None => self.rest.add(cost),
        }
    }

    /// What a function costs with all that it calls.
    fn total(&mut self, handle: Handle<Function>) -> Cost {
        if let Some(known) = self.known.get(&handle) {
            return *known;
        }
        let module = self.module;
        let total = self.total_of(&module.functions[handle]);
        self.known.insert(handle, total);
        total
    }

    fn total_of(&mut self, function: &Function) -> Cost {
        let mut total = Cost::default();
        // No function calls itself, directly or not, so that this ends.
        for (done, _, turns) in work(self.module, function) {
            let own = match done {
                Work::Own(own) => own,
                Work::Call(callee) => self.total(callee),
            };
            total.add(own.times(turns));
        }
        total
    }
}

/// What an expression costs by itself.
fn weight(expression: &Expression) -> Cost {
    match expression {
        Expression::Unary { .. }
        | Expression::Binary { .. }
        | Expression::Select { .. }
        | Expression::Derivative { .. }
        | Expression::Relational { .. }
        | Expression::Math { .. }
        | Expression::As { convert: Some(_), .. } => Cost { operations: 1, ..Cost::default() },
        Expression::ImageSample { .. } | Expression::ImageLoad { .. } => Cost { texture_reads: 1, ..Cost::default() },
        _ => Cost::default(),
    }
}

/// Something that a function does.
enum Work {
    /// An expression of its own.
    Own(Cost),
    /// A call.
    Call(Handle<Function>),
}

/// What a function does, each with its place and how often, for all that its loops tell.
fn work(module: &naga::Module, function: &Function) -> Vec<(Work, Span, u32)> {
    let mut found = Vec::new();
    let mut open = vec![(&function.body, 1u32)];
    while let Some((block, times)) = open.pop() {
        let mut before: Vec<&Statement> = Vec::new();
        for (statement, span) in block.span_iter() {
            match statement {
                // What is not emitted is a name or a number, and free.
                Statement::Emit(range) => {
                    for handle in range.clone() {
                        let own = weight(&function.expressions[handle]);
                        if own.operations + own.texture_reads > 0 {
                            found.push((Work::Own(own), function.expressions.get_span(handle), times));
                        }
                    }
                }
                Statement::Call { function, .. } => found.push((Work::Call(*function), *span, times)),
                Statement::Block(inner) => open.push((inner, times)),
                Statement::If { accept, reject, .. } => open.extend([(accept, times), (reject, times)]),
                Statement::Switch { cases, .. } => open.extend(cases.iter().map(|c| (&c.body, times))),
                Statement::Loop { body, continuing, .. } => {
                    let turns = times.saturating_mul(turns(module, function, &before, (body, continuing)));
                    open.extend([(body, turns), (continuing, turns)]);
                }
                _ => {}
            }
            before.push(statement);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compile::{NamedGraph, Options, compile};
    use crate::diagnostic::SourceText;
    use crate::node::Catalog;
    use crate::verify::verify;

    /// The parts of small graphs, and that they are all that the entry points cost.
    fn costs(texts: &[(&str, &str)]) -> BTreeMap<String, Cost> {
        let named = |(name, text): &(&str, &str)| {
            let (graph, found) = crate::graph::read(&SourceText::new(*name, *text));
            assert_eq!(found, [], "{name}");
            NamedGraph { name: (*name).to_owned(), graph: graph.expect("a graph"), set: BTreeMap::new() }
        };
        let graphs: Vec<NamedGraph> = texts.iter().map(named).collect();
        let (compiled, found) = compile(&graphs, &Catalog::embedded(), &Options::default());
        let module = compiled.unwrap_or_else(|| panic!("{found:?}")).module;
        let verified = verify(&module).expect("valid");
        let (nodes, rest) = shares(&module, &verified);
        let mut sum = rest;
        nodes.values().for_each(|c| sum.add(*c));
        let mut counter = Counter {
            owners: Vec::new(),
            module: &verified.module,
            known: BTreeMap::new(),
            nodes: BTreeMap::new(),
            rest: Cost::default(),
        };
        let mut all = Cost::default();
        verified.module.entry_points.iter().for_each(|e| all.add(counter.total_of(&e.function)));
        assert_eq!((sum.operations, sum.texture_reads), (all.operations, all.texture_reads));
        cost(&module, &verified)
    }

    const GRAPH: &str = "Graph(version: 1, nodes: {NODES}, links: [LINKS])";

    fn graph(nodes: &str, links: &str) -> String {
        GRAPH.replace("NODES", nodes).replace("LINKS", links)
    }

    #[test]
    fn a_sine_costs_operations_and_a_picture_a_read() {
        let nodes = r#""wave": (kind: "sine", params: {"x": 0.5}), "look": (kind: "emission")"#;
        let found = costs(&[("a", &graph(nodes, r#""wave -> look.color""#))]);
        assert!(found["wave"].operations >= 1 && found["wave"].texture_reads == 0, "{found:?}");
        let nodes = r#""photo": (kind: "image", params: {"image": "x.png"}), "look": (kind: "emission")"#;
        let found = costs(&[("a", &graph(nodes, r#""photo.color -> look.color""#))]);
        assert_eq!(found["photo"].texture_reads, 1, "{found:?}");
        assert!(found.values().all(|c| !c.vertex), "{found:?}");
    }

    #[test]
    fn what_is_shared_counts_where_it_is_called() {
        let text = std::fs::read_to_string("graphs/surfaces/bumpy_glass.ron").expect("an example");
        let light = std::fs::read_to_string("graphs/lights/spot_vsm.ron").expect("an example");
        let found = costs(&[("spot_vsm", &light), ("bumpy_glass", &text)]);
        // Library functions make noise dearer than the text of its own node.
        assert!(found["bumpy_glass/noise"].operations > 60, "{found:?}");
        assert_eq!(found["spot_vsm/shadow"].texture_reads, 1, "{found:?}");
        assert_eq!(found["bumpy_glass/glass"].texture_reads, 2, "{found:?}");
        let twice = r#""a": (kind: "fbm3d"), "b": (kind: "fbm3d", params: {"scale": 3}), "sum": (kind: "add"), "look": (kind: "emission")"#;
        let found = costs(&[("a", &graph(twice, r#""a -> sum.a", "b -> sum.b", "sum -> look.color""#))]);
        assert_eq!(found["a"].operations, found["b"].operations, "{found:?}");
    }

    #[test]
    fn owners_are_the_innermost() {
        let origin = |start, end, node: &str| crate::module::Origin { start, end, node: node.into(), port: None };
        let source_map = vec![origin(2, 9, "a"), origin(2, 4, "b"), origin(6, 9, "c"), origin(12, 14, "d")];
        let module = Module { source_map, ..Module::default() };
        let places = owners(&module);
        for byte in 0..16 {
            let next = places.partition_point(|(place, _)| *place <= byte);
            let found = next.checked_sub(1).and_then(|i| places[i].1);
            assert_eq!(found, module.origin_of(byte).map(|o| &*o.node), "{byte}: {places:?}");
        }
    }
}
