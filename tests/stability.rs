//! Failures on purpose: one scene and one table for each way in which shadows go wrong, with the law that says how far.
//!
//! A table is a text file in `tests/stability/tables`: what was set, the law that holds there (numbers T1 to T17 name
//! the closed forms that the table states in words), what was measured, and the bound on it. The measured figures are
//! checked against their bounds and against the committed figures, so a table tells when behaviour changes even where
//! no bound is broken. `BLESS=1` writes them.

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
