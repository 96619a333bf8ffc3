//! The scene chooses its shadow: from what a light and the camera see, in float64 and before anything is rendered, how far
//! off each kind of shadow would be with each of its settings, what it would cost on a device, and which is the cheapest
//! that is exact enough.
//!
//! [`receivers`] draws points that the camera sees, with their true visibility by rays. A [`Texels`] is a light's map as
//! rays know it. For each candidate of the table ([`MODELS`]) its filter is read there ([`Filter`]) and its closed form
//! applied ([`Judge`]): aliasing, bleeding, contacts, receiver edges and penumbrae all show in the difference
//! ([`predict`]). Work is counted and priced by constants that were measured ([`CostTable`]), and the cheapest that holds
//! the bound is taken, with its reasons ([`decisions`]). Nothing here reads files or asks a device; the same input gives
//! the same choice.

mod candidate;
mod cost;
mod facts;
mod filter;
mod judge;
mod plan;
mod predict;
mod pyramid;
mod receiver;
mod texels;

pub use candidate::{Candidate, Demand, MODELS, Model, candidates};
pub use cost::{CostTable, Load, Share, VERSION, Work, work};
pub use facts::{Facts, facts};
pub use filter::{Filter, Sample, Seen};
pub use judge::{Judge, Storage, lit};
pub use plan::{Decision, Needless, Priced, Verdict, Wish, decisions, holds, ranked, unmodelled};
pub use predict::{Metric, Outlook, cut, predict};
pub use pyramid::{Cell, Pyramid};
pub use receiver::{Effort, Receiver, Receivers, Site, looked, receivers};
pub use texels::{Looked, Plane, Texel, Texels};
