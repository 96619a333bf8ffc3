//! Things on the device that are kept from one picture to the next, by the fingerprint of everything that they depend on.

use std::collections::HashMap;

use super::fingerprint::Fingerprint;

/// Things kept in a bounded room: what was longest not asked for makes place.
#[derive(Debug)]
pub(super) struct Shelf<T> {
    kept: HashMap<Fingerprint, Kept<T>>,
    /// Bytes that there is room for.
    room: u64,
    /// Bytes that are taken.
    taken: u64,
    /// Counts what was asked for.
    clock: u64,
}

#[derive(Debug)]
struct Kept<T> {
    thing: T,
    bytes: u64,
    asked: u64,
}

impl<T: Clone> Shelf<T> {
    pub(super) fn new(room: u64) -> Self {
        Self { kept: HashMap::new(), room, taken: 0, clock: 0 }
    }

    /// What is kept under this name.
    pub(super) fn get(&mut self, name: Fingerprint) -> Option<T> {
        self.clock += 1;
        let kept = self.kept.get_mut(&name)?;
        kept.asked = self.clock;
        Some(kept.thing.clone())
    }

    /// Keeps a thing, unless it is larger than all room.
    pub(super) fn put(&mut self, name: Fingerprint, thing: T, bytes: u64) {
        self.clock += 1;
        if let Some(old) = self.kept.insert(name, Kept { thing, bytes, asked: self.clock }) {
            self.taken -= old.bytes;
        }
        self.taken += bytes;
        self.make_room();
    }

    /// Changes how much is kept.
    pub(super) fn set_room(&mut self, bytes: u64) {
        self.room = bytes;
        self.make_room();
    }

    fn make_room(&mut self) {
        while self.taken > self.room
            && let Some(name) = self.kept.iter().min_by_key(|(_, kept)| kept.asked).map(|(name, _)| *name)
            && let Some(old) = self.kept.remove(&name)
        {
            self.taken -= old.bytes;
        }
    }

    /// Whether nothing is kept.
    #[cfg(test)]
    pub(super) fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }

    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        self.kept.clear();
        self.taken = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::super::fingerprint::Fingerprinter;
    use super::*;

    #[test]
    fn what_was_longest_not_asked_for_makes_place() {
        let name = |n: u64| Fingerprinter::new().number(n).finish();
        let mut shelf = Shelf::new(100);
        for n in 0..4 {
            shelf.put(name(n), n, 25);
        }
        assert_eq!(shelf.get(name(0)), Some(0));
        shelf.put(name(4), 4, 50);
        let left: Vec<u64> = (0..5).filter_map(|n| shelf.get(name(n))).collect();
        assert_eq!((left, shelf.taken), (vec![0, 3, 4], 100));
        shelf.put(name(5), 5, 101);
        assert_eq!((shelf.get(name(5)), shelf.taken), (None, 0), "what fits nowhere is not kept");
        shelf.put(name(6), 6, 60);
        shelf.put(name(6), 7, 10);
        assert_eq!((shelf.get(name(6)), shelf.taken), (Some(7), 10));
        shelf.set_room(9);
        assert_eq!(shelf.get(name(6)), None);
    }
}
