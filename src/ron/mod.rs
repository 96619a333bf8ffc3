//! Reading and writing RON (Rusty Object Notation) as a tree that knows where every value stands.
//!
//! The `ron` crate reads into a value type that has no positions, forgets struct names and cannot tell a field from a
//! map key. Here every mistake must be reported at its `file:line:col`, fields that this version does not know must
//! survive a load and a save, and a hostile file must neither panic nor exhaust memory. So the reader is our own; tests
//! hold it against the `ron` crate.
//!
//! Comments are not part of the tree. The reader hands them over beside it ([`Document::comments`]) so that a program
//! that rewrites the file can keep them as data.

mod fields;
mod read;
mod scan;
mod series;
mod tree;
mod write;

#[cfg(test)]
mod tests;

pub use fields::{expect_fields, field, unknown_fields};
pub use read::{Comment, Document, read};
pub use tree::{Field, Node, Reading, Tree};
pub use write::{identifier, inline, number, text};

/// Largest text that is read, in bytes.
pub const MAX_BYTES: usize = 64 << 20;
/// Deepest nesting of values that is read.
pub const MAX_DEPTH: usize = 64;
/// Most values and comments that one text may hold; bounds the memory that a small text can ask for.
pub const MAX_VALUES: usize = 1_000_000;
/// Most mistakes that one text is told of.
pub const MAX_ERRORS: usize = 50;

/// What each code of this module means, for `shadetree explain`.
pub const CODES: &[(&str, &str)] = &[
    ("ST0001", "The text is not RON: a value, comma, colon or bracket is missing or out of place."),
    ("ST0002", "A string, character or block comment is not closed."),
    ("ST0003", "A string or character holds an escape that RON does not have."),
    ("ST0004", "Values are nested more deeply than 64 levels."),
    ("ST0005", "The file is larger than 64 MiB or holds more than 1,000,000 values."),
    ("ST0006", "A struct names the same field twice, or a map the same key twice."),
    ("ST0007", "The file goes on after its one value ended."),
    ("ST0008", "A value has another type than is needed here."),
    ("ST0009", "A number cannot be read, or is NaN or infinite where a finite number is needed."),
    ("ST0010", "A field is not known here. It is kept when the file is saved, but has no effect."),
    ("ST0011", "A field that must be given is missing."),
    ("ST0012", "The file has too many mistakes to list them all."),
];
