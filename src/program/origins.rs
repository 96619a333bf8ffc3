//! Which nodes an expression stands for: nearly always one, and then without memory of its own.

/// Indices of nodes in ascending order, each once.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origins {
    first: Option<usize>,
    more: Vec<usize>,
}

impl Origins {
    /// The least.
    pub fn first(&self) -> Option<usize> {
        self.first
    }

    /// All, in ascending order.
    pub fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.first.into_iter().chain(self.more.iter().copied())
    }

    /// Adds one, if it is not among them.
    pub fn insert(&mut self, node: usize) {
        let Some(first) = self.first else {
            self.first = Some(node);
            return;
        };
        if node == first {
            return;
        }
        self.first = Some(first.min(node));
        let node = first.max(node);
        // Nodes come in ascending order, so this is the end nearly always.
        let place = self.more.partition_point(|n| *n < node);
        if self.more.get(place) != Some(&node) {
            self.more.insert(place, node);
        }
    }
}

impl Extend<usize> for Origins {
    fn extend<I: IntoIterator<Item = usize>>(&mut self, nodes: I) {
        nodes.into_iter().for_each(|n| self.insert(n));
    }
}

impl FromIterator<usize> for Origins {
    fn from_iter<I: IntoIterator<Item = usize>>(nodes: I) -> Self {
        let mut origins = Self::default();
        origins.extend(nodes);
        origins
    }
}

#[cfg(test)]
mod tests {
    use super::Origins;

    #[test]
    fn each_is_there_once_and_in_order() {
        for nodes in [&[][..], &[4], &[4, 4], &[4, 2, 9, 2, 4, 0], &[1, 2, 3], &[3, 2, 1, 3]] {
            let set: std::collections::BTreeSet<usize> = nodes.iter().copied().collect();
            let origins: Origins = nodes.iter().copied().collect();
            assert_eq!(origins.iter().collect::<Vec<_>>(), set.iter().copied().collect::<Vec<_>>());
            assert_eq!(origins.first(), set.first().copied());
        }
    }
}
