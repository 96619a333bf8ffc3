//! What is asked, and what is answered.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use super::{PassTiming, Point, Resolved, Shown};
use crate::compile::{Compiled, Output};
use crate::cost::Cost;
use crate::diagnostic::Diagnostic;
use crate::scene::{Camera, Environment};

/// What is to be seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Comes back with every answer.
    pub revision: u64,
    /// Texts that stand in place of files: open documents by path. A document without a file has a made-up path.
    pub overlay: BTreeMap<PathBuf, Arc<str>>,
    /// What is shown.
    pub show: Show,
    /// How it is looked at.
    pub look: Look,
    /// From where; none for the scene's own camera.
    pub camera: Option<Camera>,
    /// What lies around it; none for what the scene or the stage has. Paths of pictures are whole.
    pub environment: Option<Environment>,
    /// Columns and rows.
    pub size: (u32, u32),
    /// Samples per pixel: 1 or 4.
    pub samples: u32,
    /// Time that animated nodes see, seconds.
    pub time: f32,
    /// Folders with further nodes.
    pub nodes: Vec<PathBuf>,
}

/// What is shown.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Show {
    /// Graphs, woven together, on a shape over a floor.
    Stage {
        /// The shape.
        shape: Shown,
        /// Files of the graphs.
        graphs: Vec<PathBuf>,
    },
    /// The scene of this file.
    Scene(PathBuf),
}

/// How it is looked at.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Look {
    /// What the fragment shader writes.
    Output(Output),
    /// One of the distinct maps of a light.
    Map {
        /// The light.
        light: String,
        /// Which of its maps.
        index: usize,
    },
    /// The visibility of a light against the truth by rays: white where right, red where too light, blue where too dark.
    Error {
        /// The light.
        light: String,
    },
    /// The value or surface of one node.
    Node {
        /// File of its graph.
        graph: PathBuf,
        /// The node.
        node: String,
        /// One of its outputs; the first if none.
        port: Option<String>,
    },
}

/// What became of the graphs.
#[derive(Clone, Debug)]
pub struct Shaders {
    /// That of the request.
    pub revision: u64,
    /// Everything that was found, whether or not there are shaders.
    pub diagnostics: Vec<Diagnostic>,
    /// The shaders; none where there is an error.
    pub shaders: Vec<ShaderText>,
    /// How ports are fed; none where there is an error.
    pub wiring: Vec<Resolved>,
    /// What each node costs, by its name in source maps; where several shaders have it, the most.
    pub cost: BTreeMap<String, Cost>,
    /// How long it took; 0 where nothing had changed.
    pub milliseconds: f64,
}

/// A shader and who has it.
#[derive(Clone, Debug)]
pub struct ShaderText {
    /// Names of objects; none where it is for all.
    pub objects: Vec<String>,
    /// The text with its source map, and the plan.
    pub compiled: Arc<Compiled>,
}

/// A picture.
#[derive(Clone, Debug)]
pub struct Image {
    /// That of the request.
    pub revision: u64,
    /// Columns and rows.
    pub size: (u32, u32),
    /// sRGB and coverage, rows from the top, four bytes a pixel, not multiplied by coverage. Radiance is tone-mapped.
    pub rgba: Vec<u8>,
    /// What each pass took.
    pub timings: Vec<PassTiming>,
    /// From the request's turn to the last byte.
    pub milliseconds: f64,
    /// Name of the adapter.
    pub adapter: String,
    /// Whether it computes on the CPU: its times say nothing about graphics cards.
    pub software: bool,
    /// What was done otherwise than asked.
    pub messages: Vec<String>,
    /// What came of a measurement, with its name.
    pub number: Option<(String, f64)>,
    /// The camera that was used.
    pub camera: Camera,
    /// Pipelines that the device has built in all.
    pub pipelines_built: usize,
    /// Names of the lights.
    pub lights: Vec<String>,
}

/// What the engine has to say.
#[derive(Clone, Debug)]
pub enum Answer {
    /// Graphs were compiled, or refused.
    Shaders(Shaders),
    /// A picture is done.
    Image(Image),
    /// The picture of a node is done.
    Thumbnail {
        /// The node.
        node: String,
        /// Its picture.
        image: Image,
    },
    /// One kind of shadow is measured.
    Point(Point),
    /// A figure is written, or why not.
    Figure {
        /// Its file.
        path: PathBuf,
        /// What went wrong.
        failure: Option<String>,
    },
    /// Nothing more is measured: all kinds are, or it was called off.
    Measured,
    /// A picture or measurement could not be made.
    Failed {
        /// That of the request.
        revision: u64,
        /// What went wrong.
        message: String,
        /// What to do about it.
        help: Option<String>,
    },
}
