//! What can be added, and where it fits.

use std::collections::BTreeSet;

use super::commands::Pending;
use super::fit::{cost, definition_of, is_light_type, is_open};
use crate::graph::Graph;
use crate::node::{Catalog, Choices, Definition, NodeFile};
use crate::semantic::{Conversions, Type};
use crate::weave::{is_light, is_lit, is_shadow};

/// A kind of node that can be added.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hit {
    /// The kind.
    pub kind: String,
    /// Its name for people.
    pub label: String,
    /// Its family.
    pub category: String,
    /// The first sentence of its description.
    pub summary: String,
}

/// What a kind must have to be found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fit {
    /// An input that takes values of this type.
    Takes(Type),
    /// An output that can be used where this type is wanted.
    Gives(Type),
}

/// Kinds that have to do with every word of the query, best first; all for an empty one. Where nothing is found, kinds
/// whose names hold the letters of the query in their order. With `fits` only kinds that fit, those that need the least
/// conversion first.
pub fn find(catalog: &Catalog, query: &str, fits: Option<&Fit>) -> Vec<Hit> {
    let mut files: Vec<&NodeFile> = catalog.search(query).into_iter().map(|file| &**file).collect();
    if files.is_empty() {
        files = catalog.files().map(|file| &**file).filter(|file| has_letters(file, query)).collect();
    }
    let conversions = Conversions::default();
    let mut found: Vec<(u32, Hit)> = Vec::new();
    for file in files {
        let Ok(header) = file.header() else { continue };
        let cost = match fits {
            None => Some(0),
            Some(fit) => file.definition(&Choices::new()).ok().and_then(|d| fit_cost(&conversions, &d, fit)),
        };
        let Some(cost) = cost else { continue };
        let summary = header.description.split_inclusive(". ").next().unwrap_or_default().trim().to_owned();
        let hit = Hit {
            kind: file.kind().to_owned(),
            label: header.label.clone(),
            category: header.category.clone(),
            summary,
        };
        found.push((cost, hit));
    }
    found.sort_by_key(|(cost, _)| *cost);
    found.into_iter().map(|(_, hit)| hit).collect()
}

fn has_letters(file: &NodeFile, query: &str) -> bool {
    let label = file.header().map_or_else(|_| String::new(), |header| header.label.to_lowercase());
    let query: Vec<char> = query.to_lowercase().chars().filter(|c| !c.is_whitespace()).take(64).collect();
    [file.kind(), &label].iter().any(|name| {
        let mut letters = name.chars();
        query.iter().all(|wanted| letters.any(|c| c == *wanted))
    })
}

fn fit_cost(conversions: &Conversions, definition: &Definition, fit: &Fit) -> Option<u32> {
    match fit {
        Fit::Takes(ty) if is_light_type(ty) => (is_lit(definition) || is_shadow(definition)).then_some(0),
        Fit::Takes(ty) => definition.inputs().filter(|p| is_open(p)).filter_map(|p| cost(conversions, ty, &p.ty)).min(),
        Fit::Gives(ty) if is_light_type(ty) => (is_light(definition) || is_shadow(definition)).then_some(0),
        Fit::Gives(ty) => definition.main.outputs.iter().filter_map(|p| cost(conversions, &p.ty, ty)).min(),
    }
}

/// What fits the loose end of a wire. None where its port is not known.
pub fn fit_of(graph: &Graph, catalog: &Catalog, pending: &Pending) -> Option<Fit> {
    let definition = definition_of(graph, catalog, &pending.end.node)?;
    let port = pending.end.port.as_deref();
    if pending.from_output {
        // What lights is told from its node, whichever of its outputs is drawn.
        let outputs = || definition.main.outputs.iter();
        let light = outputs().find(|o| is_light_type(&o.ty)).filter(|_| port.is_none());
        let output = light.or_else(|| outputs().find(|o| port.is_none_or(|name| name == o.name)))?;
        return Some(Fit::Takes(output.ty.clone()));
    }
    definition.input(port?).map(|input| Fit::Gives(input.ty.clone()))
}

/// Categories of all kinds that read, sorted.
pub fn categories(catalog: &Catalog) -> Vec<String> {
    let all: BTreeSet<String> = catalog.files().filter_map(|f| f.header().ok()).map(|h| h.category.clone()).collect();
    all.into_iter().collect()
}
