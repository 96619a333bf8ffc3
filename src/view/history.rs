//! Steps that can be taken back, and what a step changes.

use std::collections::{BTreeMap, BTreeSet};
use std::mem::{Discriminant, discriminant};

use crate::graph::Edit;
use crate::semantic::Value;

/// A step of the history: what takes it back, or makes it again.
pub(super) struct Step {
    pub(super) label: String,
    /// Number of the state that the step leads to.
    pub(super) state: u64,
    /// To be made in this order.
    pub(super) edits: Vec<Edit>,
    /// What the edits restore, as long as each restores a thing of its own and their order means nothing.
    targets: Option<BTreeSet<Target>>,
}

/// What an edit sets: the sort of edit, and the names that it gives.
type Target = (u8, String, String);

impl Step {
    pub(super) fn new(label: String, state: u64, inverse: Edit) -> Self {
        let mut edits = Vec::new();
        flatten(inverse, &mut edits);
        let targets: Option<BTreeSet<Target>> = edits.iter().map(target).collect();
        let targets = targets.filter(|set| set.len() == edits.len());
        Self { label, state, edits, targets }
    }

    /// Makes the step take back one more change, which came after it.
    pub(super) fn join(&mut self, inverse: Edit) {
        let mut later = Vec::new();
        flatten(inverse, &mut later);
        if let Some(targets) = &mut self.targets
            && later.iter().all(|edit| target(edit).is_some())
        {
            // Of two edits that restore the same thing the oldest says how it was before the step.
            for edit in later.into_iter().rev() {
                if target(&edit).is_some_and(|target| targets.insert(target)) {
                    self.edits.push(edit);
                }
            }
            return;
        }
        self.targets = None;
        self.edits.splice(0..0, later);
    }
}

/// The edits of a batch, in order, without the batches.
pub(super) fn flatten(edit: Edit, out: &mut Vec<Edit>) {
    let mut open = vec![edit];
    while let Some(edit) = open.pop() {
        match edit {
            Edit::Batch(edits) => open.extend(edits.into_iter().rev()),
            edit => out.push(edit),
        }
    }
}

/// What an edit sets, if it changes nothing that other edits need.
fn target(edit: &Edit) -> Option<Target> {
    Some(match edit {
        Edit::Move(node, _) => (0, node.clone(), String::new()),
        Edit::SetParam { node, param, .. } => (1, node.clone(), param.clone()),
        Edit::SetOption { node, option, .. } => (2, node.clone(), option.clone()),
        Edit::SetFrame(name, _) => (3, name.clone(), String::new()),
        Edit::SetCollapsed(node, _) => (4, node.clone(), String::new()),
        Edit::SetWaypoints(from, to, _) => (5, from.to_string(), to.to_string()),
        Edit::SetMuted(node, _) => (6, node.clone(), String::new()),
        Edit::SetNodeNote(node, _) => (7, node.clone(), String::new()),
        Edit::SetLinkNote(from, to, _) => (8, from.to_string(), to.to_string()),
        Edit::SetNote(_) => (9, String::new(), String::new()),
        Edit::SetName(_) => (10, String::new(), String::new()),
        Edit::SetWgsl(node, _) => (11, node.clone(), String::new()),
        _ => return None,
    })
}

/// How much of the result a change touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Reach {
    /// Only what is seen on the canvas.
    Canvas,
    /// Numbers and truth values that a shader takes while it runs.
    Values,
    /// The shader.
    Structure,
}

/// What sort a value is of; another sort may need another shader.
fn sort(value: Option<&Value>) -> Option<(Discriminant<Value>, usize)> {
    match value? {
        Value::Text(_) => None,
        value => Some((discriminant(value), value.numbers().map_or(0, <[f64]>::len))),
    }
}

/// How far a change reaches: from the edits that were made and those that take them back.
pub(super) fn reach<'a>(edits: impl Iterator<Item = &'a Edit>) -> Reach {
    let mut reach = Reach::Canvas;
    // Sorts of the values that a port had and has.
    let mut sorts = BTreeMap::new();
    let mut open: Vec<&Edit> = edits.collect();
    while let Some(edit) = open.pop() {
        let one = match edit {
            Edit::Batch(edits) => {
                open.extend(edits);
                continue;
            }
            Edit::Move(..)
            | Edit::SetFrame(..)
            | Edit::RenameFrame(..)
            | Edit::SetCollapsed(..)
            | Edit::SetWaypoints(..)
            | Edit::SetNote(_)
            | Edit::SetNodeNote(..)
            | Edit::SetLinkNote(..) => Reach::Canvas,
            Edit::SetParam { node, param, value } => {
                let sort = sort(value.as_ref());
                let known = *sorts.entry((node, param)).or_insert(sort);
                if sort.is_some() && sort == known { Reach::Values } else { Reach::Structure }
            }
            _ => Reach::Structure,
        };
        reach = reach.max(one);
    }
    reach
}
