//! Speed against accuracy: what is measured of every cell of a study, and what follows from it.
//!
//! A [`Record`] is one cell: a shadow with its settings on one light of one scene at one frame size, with the times of
//! its passes, round by round, and its errors against the truth. Everything else (medians, ratios, fronts, claims) is
//! computed from records, and no record holds a conclusion.

pub mod cells;
#[cfg(feature = "render")]
pub mod check;
pub mod claims;
mod codes;
pub mod document;
pub mod figures;
pub mod fit;
pub mod folder;
pub mod front;
pub mod published;
pub mod read;
mod reading;
pub mod record;
pub mod resample;
#[cfg(feature = "render")]
pub mod run;
pub mod select;
pub mod sheet;
#[cfg(feature = "render")]
mod silhouette;
pub mod statistics;
pub mod table;
pub mod write;

pub use codes::CODES;
pub use document::Study;
pub use record::{Errors, Machine, Record, Role, Series};
pub use statistics::Spread;
