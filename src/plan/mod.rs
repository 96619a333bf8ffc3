//! What must be rendered before a module can run: the maps that its shadow nodes demand, as chains of fixed passes.
//!
//! A plan names no shadow method. Two maps are the same map when light and passes are equal, also across modules.

mod build;

use std::collections::BTreeMap;

pub use crate::node::PassKind;
pub use build::plan;

/// Everything that a module needs besides its own bindings.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    /// Lights in use, sorted by name.
    pub lights: Vec<Light>,
    /// Maps in use, sorted by light and then by first demand.
    pub maps: Vec<Map>,
}

/// A light and the projection that its maps are made in.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Name of the light node, with its graph's name before a `/` if there are several graphs.
    pub name: String,
    /// Its projection, if it declares one.
    pub space: Option<Space>,
}

/// A projection by name, and the parameters that define it.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    /// Name of one of [`crate::node::PROJECTIONS`]. `perspective`: position (m, world), direction (along the axis, any
    /// length), outer_angle (radians, half the opening), near (m), range (m), radius (m, of the light itself).
    /// `rectangle`: as before, but with width and height (m) of the light. `cube`: position, near, range, radius.
    /// `orthographic`: direction, center (m, world), radius (m; 0 = fit the scene), angle (radians, from the middle of the
    /// light to its rim), and for several splits their balance (0 even, 1 logarithmic) and reach (m; 0 = all).
    pub projection: String,
    /// Path of the parameter for each of those, in that order.
    pub inputs: Vec<String>,
    /// Settings of the projection, all of them.
    pub settings: BTreeMap<String, String>,
    /// Number of views, and so of layers of each map.
    pub views: u32,
}

/// A texture in a light's space.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The light.
    pub light: String,
    /// Passes in order: one that draws the casters, then image and mip passes.
    pub passes: Vec<Pass>,
    /// Whether any sampler of it interpolates (then the format must be filterable).
    pub filtered: bool,
}

impl Map {
    /// Side in texels: the `size` option of the first pass that has one.
    pub fn size(&self) -> u32 {
        self.passes.iter().find_map(|p| p.number("size")).unwrap_or(1024)
    }
}

/// One fixed pass with its options chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    /// File stem in `shaders/`.
    pub name: String,
    /// What the pass does.
    pub kind: PassKind,
    /// Options, all of them.
    pub choices: BTreeMap<String, String>,
    /// Complete WGSL with entry points `vs_main` and `fs_main`, or `cs_main` of a compute pass.
    pub wgsl: String,
    /// Target formats, best first (`rg32float`, ...; `depth32float` alone means a depth target and no colour).
    pub targets: Vec<String>,
    /// Clear value per channel.
    pub clear: Vec<f64>,
    /// Whether the light's view is read, a `LightSpace`: group 0 binding 1 of an image pass, 2 of a compute pass.
    pub reads_light: bool,
    /// Factor between the distances (texels, from 1 on, below the side) that the pass is run for, each time over what it
    /// made before; the distance is group 0 binding 3, a `u32`. None: it runs once.
    pub repeat: Option<u32>,
    /// What takes its place where the adapter cannot run it.
    pub otherwise: Option<Box<Pass>>,
}

impl Pass {
    /// The choice of an option as a whole number. Options with these names mean something to who runs the passes: `size`
    /// (texels on a side), `scale` (how many times smaller the target is than the source), `samples` (per texel, of a
    /// geometry pass), `cull` (`front` or `back` sides of triangles left out), `format`.
    pub fn number(&self, option: &str) -> Option<u32> {
        self.choices.get(option)?.parse().ok()
    }

    /// The distances that the pass is run for on an image of this side; none for a pass that runs once.
    pub fn distances(&self, side: u32) -> Vec<u32> {
        let Some(factor) = self.repeat else { return Vec::new() };
        let next = |distance: &u32| distance.checked_mul(factor.max(2));
        let all: Vec<u32> = std::iter::successors(Some(1), next).take_while(|d| *d < side).collect();
        // A single texel is its own sum; the pass is run all the same, as it may change the format.
        if all.is_empty() { vec![1] } else { all }
    }
}
