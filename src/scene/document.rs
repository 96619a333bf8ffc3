//! A scene as a file says it, in the units of the file. Everything here can be written back without loss.

use std::collections::BTreeMap;

use glam::DVec3;

use super::{Camera, Environment, Shape, Transform};
use crate::diagnostic::Span;
use crate::ron;
use crate::semantic::Value;

/// Surfaces on objects and lights in space, seen from somewhere.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Version of the format that the file was written in.
    pub version: u32,
    /// Title.
    pub name: String,
    /// What it shows.
    pub note: String,
    /// Where the picture is taken from.
    pub camera: CameraSettings,
    /// What surrounds everything.
    pub environment: Environment,
    /// Lights, sorted by name.
    pub lights: Vec<LightInstance>,
    /// Objects, sorted by name.
    pub objects: Vec<Object>,
    /// Fields that this version does not know, in file order.
    pub unknown: Unknown,
}

/// The path of a file as another file gives it, relative to that file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FileReference {
    /// The path, with `/` between folders.
    pub path: String,
    /// Where it is mentioned.
    pub span: Option<Span>,
}

impl FileReference {
    /// A path that no file mentions.
    pub fn new(path: impl Into<String>) -> Self {
        Self { path: path.into(), span: None }
    }
}

/// A value that a scene gives to a port of a graph that it uses.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The value, in the unit of the port's file.
    pub value: Value,
    /// Where it is given.
    pub span: Option<Span>,
}

/// Fields that are kept without being understood.
pub type Unknown = Vec<(String, ron::Node)>;

/// Settings by `node.port`.
pub type Settings = BTreeMap<String, Setting>;

/// A light graph put into the scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightInstance {
    /// Its name, unique among the lights.
    pub name: String,
    /// Where the name stands.
    pub span: Option<Span>,
    /// A remark.
    pub note: String,
    /// The graph, which exports a light.
    pub graph: FileReference,
    /// Values other than the graph's own.
    pub set: Settings,
    /// Fields that this version does not know, in file order.
    pub unknown: Unknown,
}

/// Something to see.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Its name, unique among the objects.
    pub name: String,
    /// Where the name stands.
    pub span: Option<Span>,
    /// A remark.
    pub note: String,
    /// Its geometry.
    pub shape: Shape,
    /// The graph of its surface.
    pub surface: FileReference,
    /// Values other than the graph's own.
    pub set: Settings,
    /// Where it stands.
    pub transform: Transform,
    /// Whether it is drawn into shadow maps.
    pub casts: bool,
    /// Whether shadows fall on it.
    pub receives: bool,
    /// Fields that this version does not know, in file order.
    pub unknown: Unknown,
}

impl Object {
    /// An object at the origin that casts and receives shadows.
    pub fn new(name: impl Into<String>, shape: Shape, surface: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            span: None,
            note: String::new(),
            shape,
            surface: FileReference::new(surface),
            set: Settings::new(),
            transform: Transform::default(),
            casts: true,
            receives: true,
            unknown: Unknown::new(),
        }
    }
}

/// A camera in the units of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraSettings {
    /// Eye, metres.
    pub position: [f64; 3],
    /// What it looks at, metres.
    pub target: [f64; 3],
    /// Which way is up, any length, not along the view.
    pub up: [f64; 3],
    /// Vertical field of view, degrees, between 0 and 180.
    pub fov: f64,
    /// Nearest visible distance, metres, greater than 0.
    pub near: f64,
    /// Farthest visible distance, metres, greater than `near`.
    pub far: f64,
    /// Fields that this version does not know, in file order.
    pub unknown: Unknown,
}

impl Default for CameraSettings {
    fn default() -> Self {
        Self {
            position: [0.0, 1.5, 5.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            fov: 40.0,
            near: 0.1,
            far: 100.0,
            unknown: Unknown::new(),
        }
    }
}

impl CameraSettings {
    /// The camera that a renderer uses.
    pub fn camera(&self) -> Camera {
        Camera {
            position: DVec3::from_array(self.position).as_vec3(),
            target: DVec3::from_array(self.target).as_vec3(),
            up: DVec3::from_array(self.up).normalize_or(DVec3::Y).as_vec3(),
            fov_y: self.fov.to_radians() as f32,
            near: self.near as f32,
            far: self.far as f32,
        }
    }
}
