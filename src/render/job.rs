//! What is to be rendered, and what comes of it.

use std::collections::BTreeMap;

use glam::{Mat4, Vec4};

use super::{AdapterSummary, LightSpace};
use crate::compile::Compiled;
use crate::scene::{Camera, Mesh};
use crate::semantic::Value;

/// One object.
#[derive(Clone, Debug)]
pub struct Draw<'a> {
    /// Its shape.
    pub mesh: &'a Mesh,
    /// Its place. Must be invertible.
    pub object_to_world: Mat4,
    /// Whether it is drawn into the maps of lights.
    pub casts: bool,
    /// Whether shadows fall on it.
    pub receives: bool,
    /// Its material.
    pub shader: &'a Compiled,
    /// Values by the path of a parameter, in the unit of files; others keep the graph's.
    pub values: BTreeMap<String, Value>,
}

/// Light from all around.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surroundings {
    /// Equirectangular pictures of radiance, each half the size of the one before (rounded down, at least 1) and
    /// rougher. The top row is +y, the middle is -z, +x lies to the right of it.
    pub levels: Vec<SurroundingsLevel>,
    /// Spherical harmonics of the irradiance, in the order of [`crate::module::FRAME_WGSL`].
    pub irradiance: [Vec4; 9],
    /// Whether the first level is seen behind the objects.
    pub background: bool,
}

/// One picture of [`Surroundings`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurroundingsLevel {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Rows from the top, each from the left: linear radiance, and a fourth number that nothing reads.
    pub pixels: Vec<[f32; 4]>,
}

/// A decoded image.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Rows from the top, each from the left.
    pub texels: Texels,
}

/// The texels of a [`Picture`].
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// As in the file; decoded from sRGB when sampled if the graph says so.
    Bytes(Vec<[u8; 4]>),
    /// Linear, whatever the graph says.
    Floats(Vec<[f32; 4]>),
}

/// Precision of the picture while it is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ColorFormat {
    /// 16 bits per channel: values up to 65504, 11 significant bits.
    #[default]
    Half,
    /// 32 bits per channel.
    Float,
}

/// Reads an image: path as the graph gives it, and the file that mentions it. The error is a sentence.
pub type ImageLoader<'a> = dyn Fn(&str, &str) -> Result<Picture, String> + 'a;

/// A picture to make.
pub struct Job<'a> {
    /// What is seen.
    pub draws: Vec<Draw<'a>>,
    /// From where.
    pub camera: Camera,
    /// In front of what; black if none.
    pub surroundings: Option<&'a Surroundings>,
    /// Columns and rows.
    pub size: (u32, u32),
    /// Samples per pixel: 1 or 4.
    pub samples: u32,
    /// Time that animated nodes see, seconds.
    pub time: f32,
    /// How images are read.
    pub images: &'a ImageLoader<'a>,
    /// Precision.
    pub output: ColorFormat,
}

/// A finished picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Columns and rows.
    pub size: (u32, u32),
    /// Linear colour, multiplied by coverage, and coverage; rows from the top, each from the left.
    pub pixels: Vec<[f32; 4]>,
    /// What each pass took, in the order that they ran.
    pub timings: Vec<PassTiming>,
    /// Where it ran.
    pub adapter: AdapterSummary,
    /// What was done otherwise than asked, because the adapter cannot do it.
    pub messages: Vec<String>,
}

/// How long a pass took.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTiming {
    /// Light and pass, or `main`.
    pub name: String,
    /// Time on the device; none where it cannot be measured.
    pub milliseconds: Option<f64>,
}

/// A light's map, read back.
#[derive(Clone, Debug, PartialEq)]
pub struct MapPicture {
    /// Columns and rows.
    pub size: (u32, u32),
    /// As stored, rows from the top, each from the left; missing channels are 0, 0 and 1.
    pub pixels: Vec<[f32; 4]>,
    /// Channels that are stored.
    pub channels: usize,
    /// Name of the format that the adapter could make.
    pub format: &'static str,
    /// The space that it was made in.
    pub space: LightSpace,
    /// What was done otherwise than asked.
    pub messages: Vec<String>,
}
