//! What the editor shows, made off its thread: shaders with their diagnostics at once, pictures when they are done.
//!
//! One thread compiles and one renders. Each takes the newest request; older ones that were not begun are dropped. What
//! did not change is not made again: shaders are kept by the texts that they come from, meshes, images and surroundings by
//! file and time, pipelines and maps by the renderer. While graphs are broken, the last good shaders stay.

mod compiler;
mod engine;
mod messages;
mod renderer;
#[cfg(test)]
mod tests;

pub use crate::cost::Cost;
pub use crate::render::PassTiming;
pub use crate::studio::measure::Point;
pub use crate::studio::{Resolved, Shown};
pub use engine::Engine;
pub use messages::{Answer, Image, Look, Request, ShaderText, Shaders, Show};
