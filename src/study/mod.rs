//! Speed against accuracy: what is measured of every cell of a study, and what follows from it.
//!
//! A [`Record`] is one cell: a shadow with its settings on one light of one scene at one frame size, with the times of
//! its passes, round by round, and its errors against the truth. Everything else (medians, ratios, fronts, claims) is
//! computed from records, and no record holds a conclusion.

pub mod claims;
mod codes;
pub mod figures;
pub mod fit;
pub mod folder;
pub mod front;
pub mod published;
mod reading;
pub mod record;
pub mod resample;
pub mod select;
pub mod sheet;
pub mod statistics;

pub use codes::CODES;
pub use record::{Errors, Machine, Record, Role, Series};
pub use statistics::Spread;
