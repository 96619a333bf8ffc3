//! The one facade: graphs and a catalogue in, a module with its plan out. (interface)

use std::collections::BTreeMap;

use crate::module::Module;
use crate::plan::Plan;

/// What the fragment shader writes.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Output {
    /// Linear radiance, alpha 1.
    #[default]
    Radiance,
    /// World-space shading normal in rgb.
    Normal,
    /// Distance along the view axis in all channels, metres.
    Depth,
    /// Visibility of the light with this name: the product of its shadows.
    Visibility(String),
    /// Irradiance of the light with this name, shadows included, facing the light.
    Irradiance(String),
}

/// How to compile.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// What to write.
    pub output: Output,
    /// Write parameters as constants instead of uniform members.
    pub bake: bool,
    /// Overrides of structural options: (`node`, option) to choice.
    pub choices: BTreeMap<(String, String), String>,
}

/// A module and what must be rendered before it can run.
#[derive(Clone, Debug, PartialEq)]
pub struct Compiled {
    /// The shader.
    pub module: Module,
    /// Its maps and lights.
    pub plan: Plan,
}
