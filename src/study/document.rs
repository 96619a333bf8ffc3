//! A study as its file says it: which shadows, on which lights of which scenes, varied in which way.

use std::collections::BTreeMap;

use super::claims::Claim;
use super::published::Published;
use crate::diagnostic::Span;

/// Version of the files that are read.
pub const VERSION: u32 = 1;

/// What is to be measured.
#[derive(Clone, Debug, Default)]
pub struct Study {
    /// What it is called: the title of its chart.
    pub title: String,
    /// What it is for.
    pub note: String,
    /// Scenes with the light that is looked at, in the order of the file.
    pub cases: Vec<Case>,
    /// Shadows with their settings, in the order of the file.
    pub methods: Vec<Method>,
    /// Name of the method that all others are compared with: a plain shadow map.
    pub plain: String,
    /// Which of them are measured, and how they are varied.
    pub grids: Vec<Grid>,
    /// What errors are measured against.
    pub truth: TruthSettings,
    /// What is drawn when times are taken.
    pub shown: Timed,
    /// How often each cell is drawn and counted.
    pub rounds: usize,
    /// How often before that.
    pub warm_up: usize,
    /// What others have measured.
    pub published: Vec<Published>,
    /// What is claimed of the times.
    pub claims: Vec<Claim>,
}

/// A scene and one of its lights.
#[derive(Clone, Debug, Default)]
pub struct Case {
    /// Its name in the study.
    pub name: String,
    /// Scene file, relative to the study's.
    pub scene: String,
    /// Name of the light in the scene. Its graph has one shadow, which every method takes the place of.
    pub light: String,
    /// What class of scenes it stands for: one panel of the chart.
    pub class: String,
    /// Values of nodes of the light's graph (`NODE.NAME`).
    pub set: BTreeMap<String, String>,
    /// Where it is written.
    pub span: Option<Span>,
}

/// A shadow with its settings.
#[derive(Clone, Debug, Default)]
pub struct Method {
    /// Its name in the study: one curve of the chart.
    pub name: String,
    /// Kind of the shadow node.
    pub shadow: String,
    /// Ports and options of the shadow node by name, and those of the light as `light.NAME`.
    pub set: BTreeMap<String, String>,
    /// What is varied wherever it is measured, in the order of the file; the last varies fastest.
    pub vary: Vec<(String, Vec<String>)>,
    /// Where it is written.
    pub span: Option<Span>,
}

/// Cases, methods and frames that are all measured with each other.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    /// Names of cases; all of them if empty.
    pub cases: Vec<String>,
    /// Names of methods; all of them if empty.
    pub methods: Vec<String>,
    /// Columns and rows of the frames.
    pub frames: Vec<(u32, u32)>,
    /// What is varied besides; methods without such a setting are measured once.
    pub vary: Vec<(String, Vec<String>)>,
    /// Whether it is part of the quick form of the study.
    pub quick: bool,
}

/// What errors are measured against.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TruthSettings {
    /// `rays` to all parts of the light, `pcf` for exhaustive filtering with the method's own kernel.
    pub references: Vec<String>,
    /// Columns and rows of the pictures of visibility that are compared.
    pub size: (u32, u32),
    /// Rays a pixel; none for the usual number.
    pub samples: Option<u32>,
}

impl Default for TruthSettings {
    fn default() -> Self {
        Self { references: vec!["rays".into()], size: (320, 240), samples: None }
    }
}

/// What is drawn when times are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Timed {
    /// The visibility of the light alone: what the shadow costs.
    #[default]
    Visibility,
    /// The picture with its surfaces and lights.
    Radiance,
}

impl Study {
    /// The method of that name.
    pub fn method(&self, name: &str) -> Option<&Method> {
        self.methods.iter().find(|m| m.name == name)
    }
}
