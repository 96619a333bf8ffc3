//! Projections of lights: what each is made from, how many views it has, and which of them sees a point.
//!
//! The rows of [`PROJECTIONS`] are all that the compiler knows about them; the renderer knows how to compute each.

use std::collections::BTreeMap;

use super::definition::{Definition, SpaceSpec};

/// A kind of projection.
#[derive(Debug, PartialEq, Eq)]
pub struct Projection {
    /// Its name in `space:` lines.
    pub name: &'static str,
    /// What it is made from, in order. Those behind `needed` are for several views only.
    pub inputs: &'static [&'static str],
    /// How many of the inputs every node with this projection has.
    pub needed: usize,
    /// Settings that may follow, with their values. The first value is the default; `*` stands for any number of views
    /// from 1 to [`MOST_VIEWS`].
    pub settings: &'static [(&'static str, &'static [&'static str])],
    /// How many views: a number, or the name of the setting that says it.
    views: Views,
}

#[derive(Debug, PartialEq, Eq)]
enum Views {
    Fixed(u32),
    Setting(&'static str),
}

/// Most views of one light.
pub const MOST_VIEWS: u32 = 6;

/// Every projection.
pub const PROJECTIONS: &[Projection] = &[
    Projection {
        name: "perspective",
        inputs: &["position", "direction", "outer_angle", "near", "range", "radius"],
        needed: 6,
        settings: &[("warp", &["off", "perspective"])],
        views: Views::Fixed(1),
    },
    Projection {
        name: "rectangle",
        inputs: &["position", "direction", "outer_angle", "near", "range", "width", "height"],
        needed: 7,
        settings: &[],
        views: Views::Fixed(1),
    },
    Projection {
        name: "cube",
        inputs: &["position", "near", "range", "radius"],
        needed: 4,
        settings: &[],
        views: Views::Fixed(6),
    },
    Projection {
        name: "orthographic",
        inputs: &["direction", "center", "radius", "angle", "split_balance", "split_reach"],
        needed: 4,
        settings: &[
            ("splits", &["1", "*"]),
            ("fit", &["tight", "stable"]),
            ("choice", &["pixel", "quad"]),
            ("blend", &["off", "on"]),
            ("warp", &["off", "perspective"]),
        ],
        views: Views::Setting("splits"),
    },
];

impl Projection {
    /// The projection with this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        PROJECTIONS.iter().find(|p| p.name == name)
    }

    /// As a `space:` line writes it.
    pub fn signature(&self) -> String {
        format!("{}({})", self.name, self.inputs[..self.needed].join(", "))
    }
}

impl SpaceSpec {
    /// The value of a setting once options are chosen; the default where the line does not say it.
    pub fn setting<'a>(&'a self, definition: &'a Definition, name: &str) -> &'a str {
        let said = self.settings.iter().find(|(key, _)| key == name);
        let default = || {
            let known = Projection::named(&self.projection)?.settings.iter().find(|(key, _)| *key == name)?;
            known.1.first().copied()
        };
        said.map_or_else(|| default().unwrap_or_default(), |(_, value)| definition.setting(value))
    }

    /// Every setting of the projection with its value.
    pub fn all_settings(&self, definition: &Definition) -> BTreeMap<String, String> {
        let known = Projection::named(&self.projection).map_or(&[][..], |p| p.settings);
        known.iter().map(|(name, _)| ((*name).to_owned(), self.setting(definition, name).to_owned())).collect()
    }

    /// Number of views: layers of the light's maps.
    pub fn views(&self, definition: &Definition) -> u32 {
        match Projection::named(&self.projection).map(|p| &p.views) {
            Some(Views::Fixed(n)) => *n,
            Some(Views::Setting(name)) => {
                self.setting(definition, name).parse().map_or(1, |n: u32| n.clamp(1, MOST_VIEWS))
            }
            None => 1,
        }
    }

    /// The function of the library `light_space` that takes part in telling which view sees a point, if one does.
    pub fn selector(&self, definition: &Definition) -> Option<&'static str> {
        let several = self.views(definition) > 1;
        match (self.projection.as_str(), self.setting(definition, "choice")) {
            ("cube", _) => Some("cube_view"),
            (_, "quad") if several => Some("split_of_quad"),
            _ => None,
        }
    }

    /// Whether neighbouring views go over into each other, so that a shadow is made in two of them and mixed.
    pub fn blends(&self, definition: &Definition) -> bool {
        self.views(definition) > 1 && self.setting(definition, "blend") == "on"
    }

    /// The library whose functions take the place of those of `light_space`, where this light needs others.
    pub fn variant(&self, definition: &Definition) -> Option<&'static str> {
        let warped = self.views(definition) == 1 && self.setting(definition, "warp") == "perspective";
        warped.then_some("light_space_warped")
    }

    /// The inputs that define it with the options that are chosen: those that the node then has.
    pub fn inputs_of<'a>(&'a self, definition: &'a Definition) -> impl Iterator<Item = &'a String> {
        self.inputs.iter().filter(|name| definition.input(name).is_some())
    }
}
