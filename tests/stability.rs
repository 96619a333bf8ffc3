//! Failures on purpose: one scene and one table for each way in which shadows go wrong, with the law that says how far.
//!
//! A table is a text file in `tests/stability/tables`: what was set, the law that holds there (numbers T1 to T17 name
//! the closed forms that the table states in words), what was measured, and the bound on it. The measured figures are
//! checked against their bounds and against the committed figures, so a table tells when behaviour changes even where
//! no bound is broken. `BLESS=1` writes them. Bounds with a star are for Vulkan's lavapipe; each table says by how much
//! other adapters may be off, and why.
//!
//! `tests/stability/CLAIMS.md` holds the claims of the source papers against such measurements.

mod bench;
mod bias;
mod bleeding;
mod claims;
mod depths;
mod exponentials;
mod formats;
mod moments4;
mod motion;
mod places;
mod scales;
mod splits;
mod table;
mod timing;

/// Tables that no test makes would never be checked.
#[test]
fn every_table_is_made_by_a_test() {
    let sources = crate::support::files("tests/stability", "rs");
    let sources: String = sources.iter().map(|path| crate::support::text(path).text.clone()).collect();
    let known: Vec<String> = crate::support::files("tests/stability/tables", "txt")
        .iter()
        .filter(|path| sources.contains(&format!("\"{}\",", path.file_stem().expect("a name").to_string_lossy())))
        .map(|path| path.display().to_string())
        .collect();
    crate::support::no_strays("tests/stability/tables", "txt", &known);
}
