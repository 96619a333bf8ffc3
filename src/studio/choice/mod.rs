//! Choosing shadows for a scene that lies in files: its lights as [`crate::choose`] wants them, the graphs and scenes that
//! come of it, and what a device says to the choice.
//!
//! A chosen graph is never written to be tried: a text stands in its place beside the file that it was made from.

mod calibrate;
mod decide;
mod graphs;
mod order;
mod stand;
mod table;
mod trial;

pub use calibrate::{FRAMES, calibrate};
pub use decide::{Choice, Measured, candidate, chosen, contenders, error_of, searched, verified};
pub use graphs::{rewritten, scene_with, settings_for};
pub use stand::{Lamp, Stand, demand};
pub use table::{read_table, table_path, write_table};
pub use trial::{Tried, Trier};
