//! What is computed for each vertex and interpolated, rather than computed for each fragment: what a node marked `vertex`
//! is fed, where the vertex stage can compute it.
//!
//! It can where nothing is read that only fragments have: derivatives, pixels, which side faces the eye, and whatever is
//! bound as a texture. What it cannot compute stays where it is, so that a program never means something else for it.

use std::collections::{BTreeMap, BTreeSet};

use super::{Reached, reach};
use crate::node::{Catalog, Item, mentions, reachable};
use crate::program::{Id, Op, Program, Varying};
use crate::semantic::Shape;

/// Most values that are interpolated beside what meshes bring: WebGPU promises 16 in all.
const MOST: usize = 7;
/// Most expressions behind one of them.
const DEEPEST: usize = 256;
/// Built-in functions that only the fragment stage has.
const FRAGMENT_ONLY: &[&str] = &[
    "dpdx",
    "dpdxCoarse",
    "dpdxFine",
    "dpdy",
    "dpdyCoarse",
    "dpdyFine",
    "fwidth",
    "fwidthCoarse",
    "fwidthFine",
    "textureSample",
    "textureSampleBias",
    "textureSampleCompare",
];

/// The stages of a program.
pub(crate) struct Stages {
    /// What the fragment stage reaches.
    pub(crate) fragment: Reached,
    /// What is computed for each vertex: the name under which it is interpolated, and what carries it.
    pub(crate) interpolated: BTreeMap<Id, (String, Shape)>,
    /// What the vertex stage reaches for that.
    pub(crate) vertex: Reached,
    /// What either reaches.
    pub(crate) all: Reached,
}

/// Tells what is computed where.
pub(crate) fn stages(program: &Program, root: Id, catalog: &Catalog) -> Stages {
    let marked = |reached: &Reached| -> Vec<Id> {
        reached.order.iter().copied().filter(|id| matches!(program.get(*id).op, Op::Interpolated)).collect()
    };
    let mut fragment = reach(program, &[root], &BTreeSet::new());
    let mut interpolated: BTreeMap<Id, (String, Shape)> = BTreeMap::new();
    let mut able: BTreeMap<usize, bool> = BTreeMap::new();
    // From the root on: what is interpolated hides what lies behind it.
    for id in marked(&fragment).into_iter().rev() {
        let expression = program.get(id);
        let shape = expression.shape.clone().filter(|s| matches!(s, Shape::F32(_)));
        if let Some(shape) = shape.filter(|_| interpolated.len() < MOST && is_able(program, id, catalog, &mut able)) {
            interpolated.insert(id, (String::new(), shape));
        }
    }
    if !interpolated.is_empty() {
        let cut: BTreeSet<Id> = interpolated.keys().copied().collect();
        fragment = reach(program, &[root], &cut);
        interpolated.retain(|id, _| fragment.order.contains(id));
    }
    for (index, (id, (name, _))) in interpolated.iter_mut().enumerate() {
        *name = format!("{}_{}", super::names::sanitise(&program.get(*id).name), index + 1);
    }
    let inner: Vec<Id> = interpolated.keys().flat_map(|id| program.get(*id).operands.clone()).collect();
    let vertex = reach(program, &inner, &BTreeSet::new());
    let all = both(&fragment, &vertex);
    Stages { fragment, interpolated, vertex, all }
}

/// Whether the vertex stage can compute what a marked expression is fed.
fn is_able(program: &Program, id: Id, catalog: &Catalog, able: &mut BTreeMap<usize, bool>) -> bool {
    let inner = reach(program, &program.get(id).operands, &BTreeSet::new());
    let fine = |id: &Id| match &program.get(*id).op {
        Op::Call(function) => is_function_able(program, *function, catalog, able),
        Op::Template { text, function } => {
            let plain = !mentions(text).iter().any(|word| FRAGMENT_ONLY.contains(&word.as_str()));
            plain && function.is_none_or(|f| is_function_able(program, f, catalog, able))
        }
        Op::Input(_) | Op::Resource(_) => false,
        _ => true,
    };
    inner.order.len() <= DEEPEST && inner.order.iter().all(fine)
}

fn is_function_able(program: &Program, index: usize, catalog: &Catalog, able: &mut BTreeMap<usize, bool>) -> bool {
    *able.entry(index).or_insert_with(|| {
        let instance = &program.functions[index];
        let libraries = catalog.libraries_of(&instance.definition);
        let items: Vec<&Item> =
            instance.definition.items.iter().chain(libraries.iter().flat_map(|l| &l.items)).collect();
        let kept = reachable(&items, &[instance.function().name.as_str()]);
        let mut used = items.iter().filter(|i| kept.contains(i.name.as_str())).flat_map(|i| &i.mentions);
        !used.any(|word| FRAGMENT_ONLY.contains(&word.as_str()))
    })
}

/// What is reached in either stage.
fn both(fragment: &Reached, vertex: &Reached) -> Reached {
    let known: BTreeSet<Id> = fragment.order.iter().copied().collect();
    let more = vertex.order.iter().copied().filter(|id| !known.contains(id));
    Reached {
        order: fragment.order.iter().copied().chain(more).collect(),
        uses: fragment.uses.iter().zip(&vertex.uses).map(|(a, b)| a + b).collect(),
        varyings: fragment.varyings.union(&vertex.varyings).copied().collect::<BTreeSet<Varying>>(),
        inputs: fragment.inputs.union(&vertex.inputs).copied().collect(),
        functions: fragment.functions.union(&vertex.functions).copied().collect(),
        resources: fragment.resources.union(&vertex.resources).cloned().collect(),
    }
}
