//! `render`: graphs or a scene to a picture.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::context::Context;
use super::exit::{Failure, Outcome};
use crate::studio::settings::Assignment;

/// Render graphs or a scene to a picture
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  shadetree render graphs/scenes/car.ron -o car.png
  shadetree render spot_vsm.ron bumpy_glass.ron -o glass.png      # on a ball over a ground
  shadetree render matte.ron --scene graphs/scenes/car.ron -o matte_car.png
  shadetree render graphs/scenes/car.ron --aov visibility:key -o shadow.exr --size 512x512
  shadetree render graphs/scenes/car.ron --aov visibility:spot --reference pcf -o truth.png   # needs no adapter
  shadetree render graphs/scenes/car.ron -o pcf.png --kind shadow=pcf_shadow
  shadetree render graphs/scenes/car.ron -o car.png --set spot.range=20 --adapter cpu --watch")]
pub(super) struct Render {
    /// Graph files, woven together by type; or one scene file; `-` is stdin
    #[arg(required = true, value_name = "FILE")]
    pub(super) files: Vec<PathBuf>,
    /// Picture to write: .png (8 bits, sRGB) or .exr (floats, linear)
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: PathBuf,
    /// Scene that the graphs are shown in: they replace the surface of every object, and its lights if they have one
    #[arg(long, value_name = "FILE")]
    pub(super) scene: Option<PathBuf>,
    /// Columns and rows
    #[arg(long, default_value = "960x540", value_name = "WxH", value_parser = size)]
    pub(super) size: (u32, u32),
    /// What to show: radiance, normal, depth, visibility:LIGHT, irradiance:LIGHT, map:LIGHT
    #[arg(long, default_value = "radiance", value_name = "NAME", value_parser = aov)]
    pub(super) aov: Aov,
    /// Compute visibility:LIGHT as it ought to be, in float64: by rays, or by filtering a map that is many times finer with
    /// the filter of the light's shadow. One sample a pixel; adapters and surfaces have no part in it
    #[arg(long, value_enum, value_name = "HOW")]
    pub(super) reference: Option<Reference>,
    /// Rays a pixel (default 256, rounded up to 16s), or fine texels along a texel of the map (2 to 64, default 8)
    #[arg(long, value_name = "N", requires = "reference", value_parser = clap::value_parser!(u32).range(1..=1_048_576))]
    pub(super) reference_samples: Option<u32>,
    /// Texels across the filter of `--reference pcf`, rather than what the shadow says
    #[arg(long, value_name = "WIDTH", requires = "reference", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub(super) kernel: Option<u32>,
    /// Give a port another value
    #[arg(long, value_name = "NODE.PORT=VALUE")]
    pub(super) set: Vec<Assignment>,
    /// Choose a structural option
    #[arg(long, value_name = "NODE.NAME=VALUE")]
    pub(super) option: Vec<Assignment>,
    /// Make a node one of another kind, with its links: any shadow can be any other
    #[arg(long, value_name = "NODE=KIND", value_parser = crate::studio::settings::kind)]
    pub(super) kind: Vec<Assignment>,
    /// Part of an adapter's name, or `cpu` for a software one
    #[arg(long, value_name = "NAME")]
    pub(super) adapter: Option<String>,
    /// Samples per pixel
    #[arg(long, value_enum, default_value_t = Samples::Four)]
    pub(super) samples: Samples,
    /// Folder with further nodes; may be given several times
    #[arg(long, value_name = "DIR")]
    pub(super) nodes: Vec<PathBuf>,
    /// Render again whenever a file changes
    #[arg(long)]
    pub(super) watch: bool,
}

/// How the truth is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Reference {
    /// Percentage-closer filtering of every texel of a finer map.
    Pcf,
    /// Rays to all parts of the light.
    Rays,
}

#[cfg(feature = "render")]
impl From<Reference> for crate::studio::truth::Reference {
    fn from(reference: Reference) -> Self {
        match reference {
            Reference::Pcf => Self::Pcf,
            Reference::Rays => Self::Rays,
        }
    }
}

/// Samples per pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Samples {
    /// 1
    #[value(name = "1")]
    One,
    /// 4
    #[value(name = "4")]
    Four,
}

/// What is shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Aov {
    /// Something that the fragment shader writes.
    Output(crate::compile::Output),
    /// The first map of a light.
    Map(String),
}

/// What a build without the renderer says.
#[cfg(not(feature = "render"))]
pub(super) fn cannot_render() -> Failure {
    use crate::diagnostic::{Diagnostic, Place};
    let diagnostic = Diagnostic::error("ST0515", "this build cannot render", Place::default())
        .help("build it with `cargo build --release --features render`");
    Failure::new(super::Exit::NoAdapter, diagnostic)
}

pub(super) fn size(text: &str) -> Result<(u32, u32), String> {
    let wrong = || "expected COLUMNSxROWS, each 1 to 16384, as in 960x540".to_owned();
    let (width, height) = text.split_once('x').ok_or_else(wrong)?;
    let side = |t: &str| t.parse::<u32>().ok().filter(|n| (1..=16_384).contains(n)).ok_or_else(wrong);
    Ok((side(width)?, side(height)?))
}

fn aov(text: &str) -> Result<Aov, String> {
    use crate::compile::Output;
    let (name, light) = match text.split_once(':') {
        Some((name, light)) if !light.is_empty() => (name, Some(light.to_owned())),
        _ => (text, None),
    };
    Ok(match (name, light) {
        ("radiance", None) => Aov::Output(Output::Radiance),
        ("normal", None) => Aov::Output(Output::Normal),
        ("depth", None) => Aov::Output(Output::Depth),
        ("visibility", Some(light)) => Aov::Output(Output::Visibility(light)),
        ("irradiance", Some(light)) => Aov::Output(Output::Irradiance(light)),
        ("map", Some(light)) => Aov::Map(light),
        _ => return Err("expected radiance, normal, depth, visibility:LIGHT, irradiance:LIGHT or map:LIGHT".into()),
    })
}

impl Render {
    pub(super) fn run(&self, context: &Context) -> Outcome {
        let extension = self.output.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        if !matches!(extension.as_deref(), Some("png" | "exr")) {
            return Err(Failure::usage(
                format!("`{}` is neither a .png nor an .exr", self.output.display()),
                "name the picture with one of these extensions",
            ));
        }
        if self.reference == Some(Reference::Pcf) && self.reference_samples.is_some_and(|n| !(2..=64).contains(&n)) {
            let help = "take rays for more samples, or a wider --kernel for more blur";
            return Err(Failure::usage("--reference pcf takes 2 to 64 fine texels along a texel", help));
        }
        self.start(context)
    }

    /// What is to be seen.
    #[cfg(feature = "render")]
    pub(super) fn subject(&self) -> crate::studio::Subject<'_> {
        let shape = &crate::studio::Shown::Sphere;
        crate::studio::Subject { files: &self.files, scene: self.scene.as_deref(), shape }
    }

    #[cfg(not(feature = "render"))]
    fn start(&self, _: &Context) -> Outcome {
        Err(cannot_render())
    }

    #[cfg(feature = "render")]
    fn start(&self, context: &Context) -> Outcome {
        let gpu = std::cell::RefCell::new(None);
        super::watch::watch(context, self.watch, &self.files, |loader| {
            if self.reference.is_some() {
                return super::truth::once(self, context, loader);
            }
            super::picture::once(self, context, loader, &mut gpu.borrow_mut())
        })
    }
}

/// How adapters are looked for: by name, `cpu`, or any; within WGPU_BACKEND.
#[cfg(feature = "render")]
pub(super) fn adapter_options(name: Option<&str>) -> crate::render::AdapterOptions {
    use crate::render::{AdapterChoice, AdapterOptions};
    let choice = match name {
        None => AdapterChoice::Any,
        Some("cpu") => AdapterChoice::Cpu,
        Some(name) => AdapterChoice::Name(name.into()),
    };
    AdapterOptions { choice, backends: std::env::var("WGPU_BACKEND").ok() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_outputs_are_read() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        assert!(["", "640", "0x4", "4x-1", "99999x1"].iter().all(|t| size(t).is_err()));
        assert_eq!(aov("map:key"), Ok(Aov::Map("key".into())));
        assert!(["", "visibility", "normal:x", "map:"].iter().all(|t| aov(t).is_err()));
    }
}
