//! Nodes of another kind.

use std::collections::BTreeSet;

use super::relink;
use crate::graph::{Edit, End, Graph, Node};
use crate::node::{Catalog, Definition};
use crate::semantic::Conversions;
use crate::view::fit::{Side, best, cost, definition, definition_of, is_open, lights, takes_light};
use crate::weave::{is_light, is_shadow};

fn is_lamp(definition: &Definition) -> bool {
    is_light(definition) || is_shadow(definition)
}

/// Makes a node one of another kind. Of its values and choices those stay that the other kind has, too.
pub fn change_kind(node: &mut Node, kind: &str, catalog: &Catalog) {
    node.kind = kind.to_owned();
    // What is wrong with the kind is told when it is woven.
    let Some(file) = catalog.get(kind) else { return };
    if let Ok(header) = file.header() {
        let offers = |name: &str, choice: &str| {
            header.options.iter().any(|o| o.name == name && o.choices.iter().any(|c| c == choice))
        };
        node.options.retain(|name, choice| offers(name, choice));
    }
    if let Ok(definition) = file.definition(&node.options) {
        node.params.retain(|name, _| definition.input(name).is_some_and(|p| !p.hidden));
    }
}

/// Makes a node one of another kind. Its links stay, and of its values and choices those that the other kind has, too.
/// What is pinned to a port that the other kind lacks is pinned to the port that fits, or else to none.
pub fn swap_kind(graph: &Graph, catalog: &Catalog, node: &str, kind: &str) -> Edit {
    let Some(before) = graph.nodes.get(node) else { return Edit::Batch(Vec::new()) };
    let mut after = before.clone();
    (after.graph, after.wgsl) = (None, None);
    change_kind(&mut after, kind, catalog);
    let name = || node.to_owned();
    let mut edits = vec![Edit::SetKind { node: name(), kind: kind.to_owned(), graph: None }];
    if before.wgsl.is_some() {
        edits.push(Edit::SetWgsl(name(), None));
    }
    for param in before.params.keys().filter(|param| !after.params.contains_key(*param)) {
        edits.push(Edit::SetParam { node: name(), param: param.clone(), value: None });
    }
    for option in before.options.keys().filter(|option| !after.options.contains_key(*option)) {
        edits.push(Edit::SetOption { node: name(), option: option.clone(), value: None });
    }
    if let Some(new) = definition(&after, node, catalog) {
        let old = definition_of(graph, catalog, node);
        let work = Repin { graph, catalog, node, old: old.as_deref(), new: &new, conversions: Conversions::default() };
        work.run(&mut edits);
    }
    Edit::Batch(edits)
}

struct Repin<'a> {
    graph: &'a Graph,
    catalog: &'a Catalog,
    node: &'a str,
    old: Option<&'a Definition>,
    new: &'a Definition,
    conversions: Conversions,
}

impl Repin<'_> {
    fn run(&self, edits: &mut Vec<Edit>) {
        let has_input = |name: &String| self.new.input(name).is_some_and(is_open);
        let own = |end: &End| end.node == self.node;
        let pinned = self.graph.links.iter().filter(|l| own(&l.to)).filter_map(|l| l.to.port.clone());
        let mut used: BTreeSet<String> = pinned.filter(has_input).collect();
        for link in &self.graph.links {
            let (mut from, mut to) = (link.from.clone(), link.to.clone());
            if own(&to) && to.port.as_ref().is_some_and(|port| !has_input(port)) {
                let port = to.port.take().unwrap_or_default();
                to.port = self.input(&port, Some(&link.from), &used);
                used.extend(to.port.clone());
            }
            if own(&from) && from.port.as_ref().is_some_and(|port| self.new.output(port).is_none()) {
                let port = from.port.take().unwrap_or_default();
                from.port = self.output(&port);
            }
            relink(self.graph, link, from, to, edits);
        }
        if let Some(output) = self.graph.output.as_ref().filter(|end| own(end))
            && output.port.as_ref().is_some_and(|port| self.new.output(port).is_none())
        {
            edits.push(Edit::SetOutput(Some(End::node(self.node))));
        }
        self.exposed(edits);
    }

    /// The input in place of one that is gone: of the nearest type, else what takes what the link brings.
    fn input(&self, gone: &str, from: Option<&End>, used: &BTreeSet<String>) -> Option<String> {
        let free = |name: &str| !used.contains(name);
        if let Some(ty) = self.old.and_then(|old| old.input(gone)).map(|port| &port.ty) {
            let open = self.new.inputs().filter(|p| is_open(p) && !takes_light(self.new, p) && free(&p.name));
            let near = open.filter_map(|p| Some((cost(&self.conversions, ty, &p.ty)?, p))).min_by_key(|(c, _)| *c);
            if let Some((_, port)) = near {
                return Some(port.name.clone());
            }
        }
        let from = from?;
        let source = definition_of(self.graph, self.catalog, &from.node)?;
        let from = Side { name: &from.node, definition: &source, port: from.port.as_deref() };
        let to = Side { name: self.node, definition: self.new, port: None };
        best(&self.conversions, from, to, &free).map(|pair| pair.input)
    }

    /// The output in place of one that is gone: what can be used where that was.
    fn output(&self, gone: &str) -> Option<String> {
        let ty = &self.old?.output(gone)?.ty;
        let outputs = self.new.main.outputs.iter();
        let near = outputs.filter_map(|p| Some((cost(&self.conversions, &p.ty, ty)?, p))).min_by_key(|(c, _)| *c);
        near.map(|(_, port)| port.name.clone())
    }

    /// What the graph exposes of the node, by the ports and options that it has now.
    fn exposed(&self, edits: &mut Vec<Edit>) {
        if !self.graph.expose.ends().any(|end| end.node == self.node) {
            return;
        }
        let mut expose = self.graph.expose.clone();
        for ends in expose.inputs.values_mut() {
            ends.retain_mut(|end| {
                let gone = end.node == self.node && end.port.as_ref().is_some_and(|p| self.new.input(p).is_none());
                if gone {
                    end.port = self.input(end.port.as_deref().unwrap_or_default(), None, &BTreeSet::new());
                }
                !gone || end.port.is_some()
            });
        }
        for ends in expose.options.values_mut() {
            let has = |end: &End| self.new.header.options.iter().any(|o| Some(&o.name) == end.port.as_ref());
            ends.retain(|end| end.node != self.node || has(end));
        }
        expose.inputs.retain(|_, ends| !ends.is_empty());
        expose.options.retain(|_, ends| !ends.is_empty());
        for end in expose.outputs.values_mut().filter(|end| end.node == self.node) {
            if end.port.as_ref().is_some_and(|port| self.new.output(port).is_none()) {
                end.port = end.port.as_ref().and_then(|port| self.output(port));
            }
        }
        edits.push(Edit::SetExpose(Box::new(expose)));
    }
}

/// Kinds that can stand in a node's place with its links, those of its own category first: any shadow for any shadow.
pub fn compatible_kinds(graph: &Graph, catalog: &Catalog, node: &str) -> Vec<String> {
    let Some(given) = graph.nodes.get(node) else { return Vec::new() };
    let current = definition_of(graph, catalog, node);
    let conversions = Conversions::default();
    let category = current.as_ref().map(|d| d.header.category.clone());
    let neighbour = |end: &End| (end.clone(), definition_of(graph, catalog, &end.node));
    let to_us = graph.links.iter().filter(|l| l.to.node == node).map(|l| (neighbour(&l.from), &l.to));
    let incoming: Vec<_> = to_us.collect();
    let from_us = graph.links.iter().filter(|l| l.from.node == node).map(|l| (&l.from, neighbour(&l.to)));
    let outgoing: Vec<_> = from_us.collect();
    let mut found: Vec<(bool, String)> = Vec::new();
    for file in catalog.files().filter(|file| file.kind() != given.kind) {
        let mut after = given.clone();
        (after.graph, after.wgsl) = (None, None);
        change_kind(&mut after, file.kind(), catalog);
        let Some(new) = definition(&after, node, catalog) else { continue };
        let own = Side { name: node, definition: &new, port: None };
        let mut used: BTreeSet<String> = BTreeSet::new();
        let fed = incoming.iter().all(|((from, source), to)| {
            let Some(source) = source else { return true };
            // What is lit stays lit: its light is no number for something else.
            if to.port.is_none() && (lights(source, &new) || is_lamp(source)) {
                return lights(source, &new);
            }
            let from = Side { name: &from.node, definition: source, port: from.port.as_deref() };
            let same = to.port.as_deref().filter(|port| new.input(port).is_some_and(is_open));
            let pair = best(&conversions, from, Side { port: same, ..own }, &|name| !used.contains(name));
            let Some(pair) = pair else { return false };
            used.insert(pair.input)
        });
        let feeds = outgoing.iter().all(|(from, (to, target))| {
            let Some(target) = target else { return true };
            let lit = current.as_ref().is_some_and(|current| lights(current, target)) && to.port.is_none();
            if lit || is_lamp(&new) {
                return lit && lights(&new, target);
            }
            let same = from.port.as_deref().filter(|port| new.output(port).is_some());
            let to = Side { name: &to.node, definition: target, port: to.port.as_deref() };
            best(&conversions, Side { port: same, ..own }, to, &|_| true).is_some()
        });
        // A shadow needs light that a light does not, so neither stands for the other.
        let shadow = current.as_deref().is_some_and(is_shadow);
        let alone = incoming.is_empty() && outgoing.is_empty();
        if fed && feeds && (alone || shadow == is_shadow(&new)) {
            found.push((category.as_ref() != Some(&new.header.category), file.kind().to_owned()));
        }
    }
    found.sort();
    found.into_iter().map(|(_, kind)| kind).collect()
}
