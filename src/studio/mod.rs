//! From files to proven shaders and to all that a picture needs besides: what the command line and the editor share.
//!
//! Files are read here, and may be stood in for by texts that are not saved (`load`). Graphs and scenes become shaders
//! (`weave`), what is shown becomes a scene with the shaders of its objects (`shot`), and with its meshes, surroundings and
//! images (`stock`) a picture (`picture`). Nothing is printed: what is found is told to a [`Listener`].

pub mod assets;
#[cfg(feature = "render")]
pub mod choice;
pub mod failure;
#[cfg(feature = "render")]
pub mod figure;
pub mod focus;
pub mod load;
#[cfg(feature = "render")]
pub mod measure;
#[cfg(feature = "render")]
pub mod picture;
pub mod settings;
pub mod shot;
pub mod stage;
#[cfg(feature = "render")]
pub mod stock;
#[cfg(feature = "render")]
pub mod trial;
pub mod truth;
mod truth_light;
pub mod weave;
pub mod wiring;
pub mod write;

pub use failure::{Collected, Failure, FailureKind, Listener};
pub use focus::Focus;
pub use load::Loader;
pub use shot::{Shot, Subject};
pub use stage::Shown;
pub use wiring::Resolved;
pub use write::write;
