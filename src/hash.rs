//! Hash tables for what is looked up often: a fast hash, whose order nobody may see. Made with `default()`.

use foldhash::fast::RandomState;

/// A map with a fast hash.
pub(crate) type HashMap<K, V> = std::collections::HashMap<K, V, RandomState>;
/// A set with a fast hash.
pub(crate) type HashSet<T> = std::collections::HashSet<T, RandomState>;
