//! A graph with its history and what of it is saved.

use std::collections::VecDeque;

use super::history::{Reach, Step, flatten, reach};
use crate::graph::{Edit, EditError, Graph, apply, write};

/// Most steps that can be taken back; of more the oldest are forgotten.
const MAX_STEPS: usize = 10_000;

/// A graph with its history and what of it is saved.
pub struct Document {
    graph: Graph,
    undo: VecDeque<Step>,
    redo: Vec<Step>,
    /// Number of the state before the oldest step that can be taken back.
    base: u64,
    /// Number of the state that is saved.
    saved: u64,
    /// The gesture that further changes with the same key join.
    gesture: Option<String>,
    /// The last number that was given out: to a state or a revision.
    last: u64,
    revision: u64,
    values: u64,
    structure: u64,
}

impl Document {
    /// A document of a graph, which counts as saved as it is.
    pub fn new(graph: Graph) -> Self {
        Self {
            graph,
            undo: VecDeque::new(),
            redo: Vec::new(),
            base: 0,
            saved: 0,
            gesture: None,
            last: 0,
            revision: 0,
            values: 0,
            structure: 0,
        }
    }

    /// The graph as it is now.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// A number that is another after every change, undo and redo.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// A number that is another after every change that the picture can depend on: of a value, or of the structure.
    pub fn value_revision(&self) -> u64 {
        self.values
    }

    /// A number that is another after every change that can need another shader. Changes of numbers and truth values
    /// that are given before and after, in as many components, need none, nor does anything on the canvas, nor a note.
    pub fn structure_revision(&self) -> u64 {
        self.structure
    }

    /// Makes a change that is a step of its own.
    ///
    /// # Errors
    /// Why it cannot be made. Then nothing has changed.
    pub fn change(&mut self, label: &str, edit: Edit) -> Result<(), EditError> {
        self.gesture = None;
        self.make(label, edit, false)
    }

    /// Makes a change that joins the step before, if that is a gesture with the same key that has not ended.
    ///
    /// # Errors
    /// Why it cannot be made. Then nothing has changed, and the gesture goes on.
    pub fn gesture(&mut self, label: &str, key: &str, edit: Edit) -> Result<(), EditError> {
        let join = self.gesture.as_deref() == Some(key);
        if !join {
            self.gesture = None;
        }
        let before = self.revision;
        self.make(label, edit, join)?;
        // A first change that changes nothing makes no step to join.
        if self.revision != before {
            self.gesture = Some(key.to_owned());
        }
        Ok(())
    }

    /// Ends a gesture: whatever comes next is a step of its own.
    pub fn end_gesture(&mut self) {
        self.gesture = None;
    }

    fn make(&mut self, label: &str, edit: Edit, join: bool) -> Result<(), EditError> {
        let made = edit.clone();
        let inverse = apply(&mut self.graph, edit)?;
        let mut parts = Vec::new();
        flatten(inverse, &mut parts);
        if parts.is_empty() {
            return Ok(());
        }
        self.touched(reach(parts.iter().chain([&made])));
        let inverse = Edit::Batch(parts);
        let state = self.number();
        self.redo.clear();
        match self.undo.back_mut().filter(|_| join) {
            Some(step) => {
                step.join(inverse);
                step.state = state;
            }
            None => self.undo.push_back(Step::new(label.to_owned(), state, inverse)),
        }
        while self.undo.len() > MAX_STEPS {
            self.base = self.undo.pop_front().map_or(self.base, |step| step.state);
        }
        Ok(())
    }

    fn number(&mut self) -> u64 {
        self.last += 1;
        self.last
    }

    fn touched(&mut self, reach: Reach) {
        self.revision = self.number();
        if reach >= Reach::Values {
            self.values = self.revision;
        }
        if reach >= Reach::Structure {
            self.structure = self.revision;
        }
    }

    /// Makes the edits of a step, and a step of what takes them back.
    fn turn(&mut self, step: Step) -> Option<Step> {
        self.gesture = None;
        let edit = Edit::Batch(step.edits);
        let made = edit.clone();
        // It was made from the very state that it meets, so it cannot fail.
        let inverse = apply(&mut self.graph, edit).ok()?;
        self.touched(reach([&made, &inverse].into_iter()));
        Some(Step::new(step.label, step.state, inverse))
    }

    /// Takes the last step back, and says what it was.
    pub fn undo(&mut self) -> Option<String> {
        let step = self.undo.pop_back()?;
        let step = self.turn(step)?;
        let label = step.label.clone();
        self.redo.push(step);
        Some(label)
    }

    /// Makes the step that was taken back last again, and says what it is.
    pub fn redo(&mut self) -> Option<String> {
        let step = self.redo.pop()?;
        let step = self.turn(step)?;
        let label = step.label.clone();
        self.undo.push_back(step);
        Some(label)
    }

    /// What [`Self::undo`] would take back.
    pub fn undo_label(&self) -> Option<&str> {
        self.undo.back().map(|step| step.label.as_str())
    }

    /// What [`Self::redo`] would make again.
    pub fn redo_label(&self) -> Option<&str> {
        self.redo.last().map(|step| step.label.as_str())
    }

    /// What was done, oldest first, without what was taken back.
    pub fn history(&self) -> impl Iterator<Item = &str> {
        self.undo.iter().map(|step| step.label.as_str())
    }

    fn state(&self) -> u64 {
        self.undo.back().map_or(self.base, |step| step.state)
    }

    /// Whether the graph is another than the one that was saved. Undoing to what was saved makes it the same again.
    pub fn is_changed(&self) -> bool {
        self.state() != self.saved
    }

    /// Says that the graph is saved as it is now. It ends a gesture, so that undoing leads back here.
    pub fn mark_saved(&mut self) {
        self.gesture = None;
        self.saved = self.state();
    }

    /// The canonical text of the graph.
    pub fn text(&self) -> String {
        write(&self.graph)
    }
}
