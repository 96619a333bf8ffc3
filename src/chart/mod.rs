//! Records of a study as a chart and a report: error against time, what no other beats, and what was claimed.
//!
//! Everything here is text made of records: the same records give the same bytes. No file is read and no pixel is drawn,
//! but that pictures which are handed over are made small.

mod claims;
mod data;
mod front;
mod json;
mod legend;
mod marks;
mod metric;
mod panel;
mod page;
mod published;
mod report;
mod scale;
mod svg;
mod tables;
mod text;
mod thumbnail;

pub use data::{Chart, Choice, Curve, Panel, Point, Time};
pub use json::json;
pub use metric::{METRICS, Metric, REGIONS};
pub use report::{Report, html};
pub use svg::svg;
pub use thumbnail::small;
