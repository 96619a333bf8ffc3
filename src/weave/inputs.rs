//! What feeds the inputs of a node: a few pairs, which are found sooner by looking at each than by any order.

use super::Wire;

/// Wires by the name of the input, each name once.
#[derive(Clone, Default)]
pub struct Inputs {
    wires: Vec<(String, Wire)>,
}

impl Inputs {
    /// What feeds the input.
    pub fn get(&self, name: &str) -> Option<&Wire> {
        self.wires.iter().find(|(n, _)| n == name).map(|(_, wire)| wire)
    }

    /// What feeds the input, to change.
    pub fn get_mut(&mut self, name: &str) -> Option<&mut Wire> {
        self.wires.iter_mut().find(|(n, _)| n == name).map(|(_, wire)| wire)
    }

    /// Whether anything feeds the input.
    pub fn contains_key(&self, name: &str) -> bool {
        self.get(name).is_some()
    }

    /// Feeds an input, whatever fed it before.
    pub fn insert(&mut self, name: String, wire: Wire) {
        match self.get_mut(&name) {
            Some(known) => *known = wire,
            None => self.wires.push((name, wire)),
        }
    }

    /// Names and wires, in the order in which they were decided.
    pub fn iter(&self) -> impl Iterator<Item = (&String, &Wire)> {
        self.wires.iter().map(|(name, wire)| (name, wire))
    }

    /// The wires alone.
    pub fn values(&self) -> impl Iterator<Item = &Wire> {
        self.wires.iter().map(|(_, wire)| wire)
    }
}
