//! Port types, values, and the one table of conversions with its shortest-path search.

mod convert;
mod meaning;
mod value;

pub use convert::{Chain, Conversions, OPERATION, Step};
pub use meaning::{Encoding, Frame, Kind, Length, Meaning, Quantity, Shape, Type};
pub use value::Value;
