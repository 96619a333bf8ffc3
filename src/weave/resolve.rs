//! Which output feeds which port, all ports of a node together.
//!
//! The order of preference: a pinned port; for nodes under lights, the light's own outputs; then the outputs of direct
//! neighbours by unpinned links, where a pairing is ordered by (role name, port without default, conversion cost) and
//! the whole assignment must be the only best one; then, for a port that has no default, what lies further up the
//! links; then the port's default. A tie is an error that lists the candidates, never a guess.

mod words;

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::rc::Rc;
use std::sync::Arc;

use super::assign::{NEVER, alternative, assign};
use super::collect::Collected;
use super::lights::{Lights, short};
use super::{Found, Inputs, Link, Node, Wire, instantiated, is_light, is_light_port, is_shadow};
use crate::diagnostic::Diagnostic;
use crate::node::{Default, Definition, Port};
use crate::semantic::{Chain, Conversions, Kind, Quantity, Shape, Value};

/// A port whose name is not that of the output or of its node.
const OTHER_ROLE: u64 = 1 << 32;
/// A port that has a default.
const HAS_DEFAULT: u64 = 1 << 24;
/// How many nodes are looked at for a port that no neighbour feeds.
const SEARCH_LIMIT: usize = 256;

pub(crate) fn resolve(
    collected: &Collected<'_>,
    lights: Lights,
    conversions: &Conversions,
    out: &mut Vec<Diagnostic>,
) -> Vec<Option<Node>> {
    let mut done: Vec<Option<Node>> = Vec::with_capacity(collected.nodes.len());
    for (index, (found, lights)) in collected.nodes.iter().zip(lights).enumerate() {
        let node = found.definition.clone().and_then(|definition| {
            let work = Work { collected, conversions, done: &done, index, found, definition, lights };
            work.run(out)
        });
        done.push(node);
    }
    done
}

struct Work<'a> {
    collected: &'a Collected<'a>,
    conversions: &'a Conversions,
    done: &'a [Option<Node>],
    index: usize,
    found: &'a Found<'a>,
    definition: Arc<Definition>,
    lights: BTreeMap<usize, BTreeSet<usize>>,
}

/// The best output of a node for a port.
struct Offer<'a> {
    output: &'a str,
    same_role: bool,
    chain: Rc<Chain>,
}

impl<'a> Work<'a> {
    fn run(self, out: &mut Vec<Diagnostic>) -> Option<Node> {
        let before = out.len();
        let mut inputs = Inputs::default();
        let incoming: Vec<&Link<'_>> =
            self.collected.incoming[self.index].iter().map(|&l| &self.collected.links[l]).collect();
        // A neighbour with mistakes of its own has said so; what it would have fed is not reported as missing.
        let refused = self.found.refused.contains("*");
        let blind = refused || incoming.iter().any(|l| self.done[l.from].is_none());
        self.pinned(&incoming, &mut inputs, out);
        self.under_lights(&mut inputs);
        // A shadow is between this node and a light if one of its own lights has it on the way.
        let on_the_way = |from: usize| {
            let own = self.done[from].as_ref().map(|n| &n.lights).into_iter().flat_map(|l| l.keys());
            own.filter_map(|light| self.lights.get(light)).any(|shadows| shadows.contains(&from))
        };
        let fed_by_light = |link: &&Link<'_>| self.lights.contains_key(&link.from) || on_the_way(link.from);
        let open: Vec<&Link<'_>> = incoming
            .iter()
            .copied()
            .filter(|l| l.to_port.is_none() && self.done[l.from].is_some() && !fed_by_light(l))
            // A shadow that no light reaches has been reported; it is not looked at as a mere value.
            .filter(|l| !self.done[l.from].as_ref().is_some_and(|n| is_shadow(&n.definition) && n.lights.is_empty()))
            .collect();
        let assigned = self.neighbours(&open, &mut inputs, out);
        self.rest(&mut inputs, blind || !assigned, &incoming, out);
        let generic = self.generic(&inputs, out);
        if out[before..].iter().any(|d| d.severity == crate::diagnostic::Severity::Error) || blind {
            return None;
        }
        let Found { id, name, graph, .. } = self.found;
        let graph = &self.collected.graphs[*graph].graph;
        let spans = graph.nodes.get(*name).map(|n| &n.spans);
        let mut node = Node {
            id: id.clone(),
            definition: self.definition.clone(),
            generic,
            inputs,
            lights: self.lights.clone(),
            span: spans.and_then(|s| s.name.as_ref().or(s.whole.as_ref())).cloned(),
            source: graph.source.clone(),
            name_at: id.len() - name.len(),
        };
        self.widen(&mut node, out);
        Some(node)
    }

    fn ports(&self) -> impl Iterator<Item = &Port> {
        self.definition.inputs().filter(|p| !p.hidden)
    }

    /// The best output of node `from` for `port`.
    fn offer(&self, from: usize, from_port: Option<&str>, port: &Port) -> Option<Offer<'a>> {
        let node = self.done[from].as_ref()?;
        let role = short(&node.id);
        let role = role.rsplit('/').next().unwrap_or(role);
        let outputs = node.definition.main.outputs.iter().filter(|o| from_port.is_none_or(|name| name == o.name));
        let offers = outputs.filter_map(|o| {
            let chain = self.conversions.chain(&node.output_type(o), &port.ty)?;
            Some(Offer { output: &o.name, same_role: o.name == port.name || role == port.name, chain })
        });
        // The first of equals: a node's first output is its primary one.
        offers.min_by_key(|o| (!o.same_role, o.chain.cost))
    }

    fn wire(&self, from: usize, offer: &Offer<'_>) -> Wire {
        Wire::Output { node: from, output: offer.output.to_owned(), chain: offer.chain.clone() }
    }

    fn pinned(&self, incoming: &[&Link<'_>], inputs: &mut Inputs, out: &mut Vec<Diagnostic>) {
        let mut pinned = BTreeSet::new();
        for link in incoming {
            let Some(name) = &link.to_port else { continue };
            let Some(port) = self.definition.input(name) else { continue };
            if !pinned.insert(name) {
                let message = format!("two links lead to `{}.{name}`", self.found.id);
                let help = "remove one, or combine the two with a node such as `add` or `mix_values`";
                out.push(Diagnostic::error("ST0212", message, self.collected.link_place(link)).help(help));
                continue;
            }
            if self.done[link.from].is_none() {
                continue;
            }
            match self.offer(link.from, link.from_port.as_deref(), port) {
                Some(offer) => inputs.insert(name.clone(), self.wire(link.from, &offer)),
                None => out.push(self.mismatch(link, port)),
            }
        }
    }

    /// Ports that only a light can feed take its outputs by type.
    fn under_lights(&self, inputs: &mut Inputs) {
        let Some(&light) = self.lights.keys().next().filter(|l| **l != self.index) else { return };
        for port in self.ports() {
            if inputs.contains_key(&port.name) || !is_light_port(&self.definition, port) {
                continue;
            }
            if port.ty.meaning.quantity == Quantity::Irradiance {
                inputs.insert(port.name.clone(), Wire::Irradiance);
            } else if let Some(offer) = self.offer(light, None, port) {
                inputs.insert(port.name.clone(), Wire::Light { output: offer.output.to_owned(), chain: offer.chain });
            }
        }
    }

    /// Unpinned links of direct neighbours, assigned to the free ports together. Whether that could be done.
    fn neighbours(&self, open: &[&Link<'_>], inputs: &mut Inputs, out: &mut Vec<Diagnostic>) -> bool {
        let free: Vec<&Port> =
            self.ports().filter(|p| !inputs.contains_key(&p.name) && !is_light_port(&self.definition, p)).collect();
        if open.is_empty() {
            return true;
        }
        let offers: Vec<Vec<Option<Offer<'_>>>> =
            open.iter().map(|l| free.iter().map(|p| self.offer(l.from, l.from_port.as_deref(), p)).collect()).collect();
        let price = |port: &Port, offer: &Option<Offer<'_>>| match offer {
            None => NEVER,
            Some(o) => {
                let role = if o.same_role { 0 } else { OTHER_ROLE };
                let default = if port.default.is_some() { HAS_DEFAULT } else { 0 };
                role + default + u64::from(o.chain.cost)
            }
        };
        let cost: Vec<Vec<u64>> =
            offers.iter().map(|row| free.iter().zip(row).map(|(p, o)| price(p, o)).collect()).collect();
        let mut useless = false;
        for (link, row) in open.iter().zip(&cost) {
            if row.iter().all(|c| *c >= NEVER) {
                useless = true;
                out.push(self.contributes_nothing(link, &free));
            }
        }
        if useless {
            return false;
        }
        let Some((total, chosen)) = assign(&cost) else {
            let mut names: Vec<String> =
                open.iter().map(|l| format!("`{}`", self.collected.nodes[l.from].id)).collect();
            names.sort_unstable();
            let message =
                format!("{} cannot all feed `{}`: it has too few fitting inputs", names.join(", "), self.found.id);
            let mut error = Diagnostic::error("ST0214", message, self.collected.link_place(open[open.len() - 1]));
            for port in &free {
                error = error.note(format!("free: `{}`, {}", port.name, port.ty));
            }
            out.push(error.help("remove a link, or put a node between them that makes one value of several"));
            return false;
        };
        if let Some((row, other)) = alternative(&cost, total, &chosen)
            && !self.interchangeable(&free, &chosen, row, other)
        {
            out.push(self.ambiguous(open, &free, &offers, &cost, row, chosen[row], other));
            return false;
        }
        for (row, &column) in chosen.iter().enumerate() {
            if let Some(offer) = &offers[row][column] {
                inputs.insert(free[column].name.clone(), self.wire(open[row].from, offer));
            }
        }
        // Further outputs of the same neighbours feed ports of exactly their name.
        for link in open {
            let Some(node) = self.done[link.from].as_ref().filter(|_| link.from_port.is_none()) else { continue };
            for output in node.definition.main.outputs.iter().skip(1) {
                let port = free.iter().find(|p| p.name == output.name && !inputs.contains_key(&p.name));
                if let Some(offer) = port.and_then(|p| self.offer(link.from, Some(&output.name), p)) {
                    inputs.insert(output.name.clone(), self.wire(link.from, &offer));
                }
            }
        }
        true
    }

    /// Whether the two ways differ only in the first two inputs of a node that may swap them.
    fn interchangeable(&self, free: &[&Port], chosen: &[usize], row: usize, other: usize) -> bool {
        let swap = |column: usize| {
            let first_two = self.definition.main.inputs.iter().filter(|p| !p.hidden).take(2);
            first_two.into_iter().any(|p| p.name == free[column].name)
        };
        self.definition.header.commutative && swap(chosen[row]) && swap(other)
    }

    /// Ports that nothing feeds yet.
    fn rest(&self, inputs: &mut Inputs, blind: bool, incoming: &[&Link<'_>], out: &mut Vec<Diagnostic>) {
        let definition = self.definition.clone();
        for port in definition.inputs() {
            if inputs.contains_key(&port.name) {
                continue;
            }
            if let Some(wire) = self.provided(port) {
                inputs.insert(port.name.clone(), wire);
                continue;
            }
            if is_light_port(&definition, port) && self.lights.is_empty() {
                continue;
            }
            match self.further_up(port) {
                Ok(Some(wire)) => inputs.insert(port.name.clone(), wire),
                Ok(None) if blind || self.found.refused.contains(&port.name) => {}
                Err(_) if blind => {}
                Ok(None) => out.push(self.missing(port, incoming)),
                Err(error) => out.push(*error),
            }
        }
    }

    fn provided(&self, port: &Port) -> Option<Wire> {
        if let Some(value) = self.found.values.get(&port.name) {
            return Some(match value {
                Value::Text(path) => {
                    let own = || self.found.base.as_ref().map(|s| s.name.clone()).unwrap_or_default();
                    let base = self.found.bases.get(&port.name).cloned().unwrap_or_else(own);
                    Wire::Image(path.clone(), base)
                }
                other => Wire::Value(other.clone()),
            });
        }
        match (&port.default, port.ty.meaning.kind) {
            (Some(Default::Value(value)), _) => Some(Wire::Value(value.clone())),
            (Some(Default::Source(name)), _) => Some(Wire::Source(name.clone())),
            (None, Kind::Space) => Some(Wire::Space),
            (None, Kind::Map) => Some(Wire::Map),
            (None, Kind::Sampler) => Some(Wire::Sampler),
            _ => None,
        }
    }

    /// The nearest level above the direct neighbours that can feed a port without default.
    fn further_up(&self, port: &Port) -> Result<Option<Wire>, Box<Diagnostic>> {
        if matches!(port.ty.meaning.kind, Kind::Number | Kind::Scalar | Kind::Bool | Kind::Texture) {
            return Ok(None);
        }
        let mut seen = BTreeSet::from([self.index]);
        let mut level: VecDeque<usize> = VecDeque::from([self.index]);
        while !level.is_empty() && seen.len() < SEARCH_LIMIT {
            let mut next = VecDeque::new();
            for node in level {
                for &link in &self.collected.incoming[node] {
                    let from = self.collected.links[link].from;
                    if seen.insert(from) {
                        next.push_back(from);
                    }
                }
            }
            let mut offers: Vec<(usize, Offer<'_>)> =
                next.iter().filter_map(|&n| Some((n, self.offer(n, None, port)?))).collect();
            offers.sort_by_key(|(n, o)| (!o.same_role, o.chain.cost, *n));
            if let [(node, best), others @ ..] = offers.as_slice() {
                if let Some((rival, _)) =
                    others.first().filter(|(_, o)| (o.same_role, o.chain.cost) == (best.same_role, best.chain.cost))
                {
                    let names = [&self.collected.nodes[*node].id, &self.collected.nodes[*rival].id];
                    let message =
                        format!("`{}` or `{}` could feed `{}.{}`", names[0], names[1], self.found.id, port.name);
                    let pin = |n: &str| format!("`\"{} -> {}.{}\"`", short(n), short(&self.found.id), port.name);
                    let help = format!("pin one: {} or {}", pin(names[0]), pin(names[1]));
                    let place = self.collected.place(self.index).port(&port.name);
                    return Err(Box::new(Diagnostic::error("ST0216", message, place).help(help)));
                }
                return Ok(Some(self.wire(*node, best)));
            }
            level = next;
        }
        Ok(None)
    }

    /// The shape of `T`: as wide as the widest thing linked or given to a generic input.
    fn generic(&self, inputs: &Inputs, out: &mut Vec<Diagnostic>) -> Option<Shape> {
        let choices = &self.definition.header.generic;
        let first = choices.first()?;
        let linked = self.definition.inputs().filter(|p| p.ty.shape == Shape::Generic).filter_map(|p| {
            match inputs.get(&p.name)? {
                Wire::Output { node, output, chain } => {
                    let from = self.done[*node].as_ref()?;
                    let end = chain.steps.last().map(|s| s.to.clone());
                    end.unwrap_or(from.output_type(from.definition.output(output)?)).shape.width()
                }
                Wire::Value(Value::Numbers(n)) => u8::try_from(n.len()).ok(),
                _ => None,
            }
        });
        let width = linked.max().unwrap_or(1);
        if let Some(shape) = choices.iter().find(|s| s.width() == Some(width)) {
            return Some(shape.clone());
        }
        if width == 1 {
            return Some(first.clone());
        }
        let message = format!("`{}` ({}) does not work on {width} components", self.found.id, self.definition.kind);
        let help = format!("it works on {}", list(choices.iter().map(|s| format!("`{}`", s.wgsl()))));
        out.push(Diagnostic::error("ST0218", message, self.collected.place(self.index)).help(help));
        None
    }

    /// Conversions of what feeds generic inputs, now that their width is known.
    fn widen(&self, node: &mut Node, out: &mut Vec<Diagnostic>) {
        let definition = node.definition.clone();
        for port in definition.inputs().filter(|p| p.ty.shape == Shape::Generic) {
            let wanted = instantiated(&port.ty, node.generic.as_ref());
            let Some(Wire::Output { node: from, output, chain }) = node.inputs.get_mut(&port.name) else { continue };
            let Some(source) = self.done[*from].as_ref() else { continue };
            let Some(given) = source.definition.output(output).map(|o| source.output_type(o)) else { continue };
            match self.conversions.chain(&given, &wanted) {
                Some(found) => *chain = found,
                None => {
                    let message = format!(
                        "`{}.{output}` is {given}, but `{}` works on {}",
                        source.id,
                        node.id,
                        wanted.shape.wgsl()
                    );
                    let help = "give all inputs of the node the same number of components (one alone is spread)";
                    out.push(
                        Diagnostic::error("ST0218", message, self.collected.place(self.index).port(&port.name))
                            .help(help),
                    );
                }
            }
        }
    }
}

fn list(items: impl Iterator<Item = String>) -> String {
    items.collect::<Vec<_>>().join(", ")
}

/// Whether a node is part of a light program.
pub(crate) fn is_lamp(definition: &Definition) -> bool {
    is_light(definition) || is_shadow(definition)
}
