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

mod blockers;
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
pub use facts::{Facts, covered, facts};
pub use filter::{Filter, Sample, Seen};
pub use judge::{Judge, Storage, lit};
pub use plan::{Decision, Needless, Priced, Verdict, Wish, decisions, holds, ranked, unmodelled};
pub use predict::{Metric, Outlook, cut, predict};
pub use pyramid::{Cell, Pyramid};
pub use receiver::{Effort, Receiver, Receivers, Site, Stratum, looked, receivers};
pub use texels::{Looked, Plane, Texel, Texels};

/// What each code of choosing means, for `shadetree explain`.
pub const CODES: &[(&str, &str)] = &[
    ("ST0700", "Shadows are chosen for a scene, and the file is a graph."),
    ("ST0701", "The scene has no light, so there is no shadow to choose."),
    ("ST0702", "The scene has no light of the name that `--light` gives."),
    (
        "ST0703",
        "Shadows can be chosen for light graphs with one light node, with it and its shadows in the graph itself rather \
         than in a subgraph; this one is otherwise.",
    ),
    ("ST0704", "No shadow keeps to the error and the time that were asked for, or the chosen one was found not to."),
    ("ST0705", "One light graph was to be written, but shadows are chosen for several lights."),
    ("ST0706", "The constants of a device cannot be used: the file holds none, or lacks some."),
    ("ST0707", "The constants of this device could not be kept in the user's folder for caches."),
];
