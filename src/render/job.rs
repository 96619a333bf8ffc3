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
    /// Linear colour, multiplied by coverage, and coverage; rows from the top, each from the left. None where only times
    /// were asked for.
    pub pixels: Vec<[f32; 4]>,
    /// What each pass took, in the order that they ran.
    pub timings: Vec<PassTiming>,
    /// Where it ran.
    pub adapter: AdapterSummary,
    /// What was done otherwise than asked, because the adapter cannot do it.
    pub messages: Vec<String>,
}

impl Frame {
    /// What each pass took, and all of them, as lines of a table. Adapters that compute on the CPU are named as such:
    /// their times say nothing about graphics cards.
    pub fn timing_table(&self) -> Vec<String> {
        let width = self.timings.iter().map(|t| t.name.chars().count()).max().unwrap_or(0).max("all passes".len());
        let line = |name: &str, time: Option<f64>| match time {
            Some(ms) => format!("{name:<width$} {ms:>9.3} ms"),
            None => format!("{name:<width$} {:>9}", "unknown"),
        };
        let mut lines: Vec<String> = self.timings.iter().map(|t| line(&t.name, t.milliseconds)).collect();
        // A sum without one of its parts would be no sum.
        let all: Option<f64> = self.timings.iter().map(|t| t.milliseconds).sum();
        let software = if self.adapter.software { ", computed on the CPU" } else { "" };
        lines.push(format!(
            "{}, {} x {} on {}{software}",
            line("all passes", all),
            self.size.0,
            self.size.1,
            self.adapter.name
        ));
        lines
    }
}

/// How long a pass took.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTiming {
    /// Light and pass, or `main`.
    pub name: String,
    /// Time on the device; none where it cannot be measured.
    pub milliseconds: Option<f64>,
}

/// A light's map, as an adapter makes it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MapSummary {
    /// The light.
    pub light: String,
    /// Texels on a side of the finished map.
    pub side: u32,
    /// Views of the light, each with a layer.
    pub layers: usize,
    /// Name of the format of the finished map.
    pub format: &'static str,
    /// Bits of a texel of it.
    pub bits: u32,
}

/// A light's map, read back.
#[derive(Clone, Debug, PartialEq)]
pub struct MapPicture {
    /// Columns and rows: the views of the light lie one below the other.
    pub size: (u32, u32),
    /// As stored, rows from the top, each from the left; missing channels are 0, 0 and 1. Whole numbers are rounded to what
    /// floats hold.
    pub pixels: Vec<[f32; 4]>,
    /// The same exactly, where whole numbers are stored: 32 bits per channel, missing ones 0. Empty for other formats.
    pub integers: Vec<[u32; 4]>,
    /// Channels that are stored.
    pub channels: usize,
    /// Name of the format that the adapter could make.
    pub format: &'static str,
    /// The views that it was made in.
    pub spaces: Vec<LightSpace>,
    /// What was done otherwise than asked.
    pub messages: Vec<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(times: [Option<f64>; 2], software: bool) -> Frame {
        let names = ["sun: blur x", "main"];
        Frame {
            size: (64, 32),
            pixels: Vec::new(),
            timings: names
                .into_iter()
                .zip(times)
                .map(|(name, milliseconds)| PassTiming { name: name.into(), milliseconds })
                .collect(),
            adapter: AdapterSummary { name: "card".into(), software, ..AdapterSummary::default() },
            messages: Vec::new(),
        }
    }

    #[test]
    fn timings_are_a_table_with_a_sum() {
        let expected =
            ["sun: blur x     0.500 ms", "main           12.250 ms", "all passes     12.750 ms, 64 x 32 on card"];
        assert_eq!(frame([Some(0.5), Some(12.25)], false).timing_table(), expected);
    }

    #[test]
    fn times_that_are_not_known_are_not_summed_and_software_says_so() {
        let expected = [
            "sun: blur x   unknown",
            "main            1.000 ms",
            "all passes    unknown, 64 x 32 on card, computed on the CPU",
        ];
        assert_eq!(frame([None, Some(1.0)], true).timing_table(), expected);
    }
}
