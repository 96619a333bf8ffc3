//! `figure`: tree, text and picture in one drawing.

use std::path::PathBuf;

use clap::Args;

use super::context::Context;
use super::exit::{Failure, Outcome};
use crate::studio::settings::Assignment;

/// Draw graphs, the code that they make and how it looks as one figure
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  shadetree figure graphs/surfaces/bumpy_glass.ron -o glass.svg
  shadetree figure graphs/lights/spot_vsm.ron graphs/surfaces/bumpy_glass.ron -o glass.png
  shadetree figure rust.ron --scene graphs/scenes/car.ron -o rust.svg --set iron.roughness=0.2")]
pub(super) struct DrawFigure {
    /// Graph files, woven together by type; `-` is stdin
    #[arg(required = true, value_name = "GRAPH")]
    files: Vec<PathBuf>,
    /// Drawing to write: .svg, or .png with two pixels a point
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Scene that the graphs are shown in, rather than on a ball
    #[arg(long, value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// Columns and rows of the picture
    #[arg(long, default_value = "960x640", value_name = "WxH", value_parser = super::render::size)]
    size: (u32, u32),
    /// Give a port another value
    #[arg(long, value_name = "NODE.PORT=VALUE")]
    set: Vec<Assignment>,
    /// Part of an adapter's name, or `cpu` for a software one
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Folder with further nodes; may be given several times
    #[arg(long, value_name = "DIR")]
    nodes: Vec<PathBuf>,
}

impl DrawFigure {
    pub(super) fn run(&self, context: &Context) -> Outcome {
        let extension = self.output.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        if !matches!(extension.as_deref(), Some("svg" | "png")) {
            return Err(Failure::usage(
                format!("`{}` is neither an .svg nor a .png", self.output.display()),
                "name the figure with one of these extensions",
            ));
        }
        self.draw(context)
    }

    #[cfg(not(feature = "render"))]
    fn draw(&self, _: &Context) -> Outcome {
        let _ = (&self.files, &self.scene, &self.size, &self.set, &self.adapter, &self.nodes);
        Err(super::render::cannot_render())
    }

    #[cfg(feature = "render")]
    fn draw(&self, context: &Context) -> Outcome {
        super::watch::watch(context, false, &self.files, |loader| self.once(context, loader))
    }

    #[cfg(feature = "render")]
    fn once(&self, context: &Context, loader: &crate::studio::Loader) -> Outcome {
        use super::exit::Exit;
        use super::output;
        use crate::render::Gpu;
        use crate::studio::figure::{Form, Request, make};
        use crate::studio::load::is_dash;
        use crate::studio::weave::{Known, Weaver};
        use crate::studio::{self, Shown};

        // Files are read twice, and stdin cannot be.
        let piped;
        let mut loader = loader;
        if let Some(dash) = self.files.iter().find(|f| is_dash(f)) {
            let text = loader.text(dash)?.text.as_str().into();
            piped = studio::Loader::with_overlay([(dash.clone(), text)].into());
            loader = &piped;
        }
        let (catalog, found) = loader.catalog(&self.nodes)?;
        context.report(&found);
        let known = Known::default();
        let weaver = Weaver { set: &self.set, ..Weaver::new(context, loader, &catalog, &known) };
        let request = Request {
            files: self.files.clone(),
            scene: self.scene.clone(),
            shape: Shown::Sphere,
            camera: None,
            size: self.size,
            form: Form::of(&self.output).unwrap_or(Form::Svg),
        };
        let open = || Gpu::new(&super::render::adapter_options(self.adapter.as_deref()));
        let bytes = make(&request, &weaver, open)?;
        output::write(&self.output, &bytes)?;
        context.detail(&format!("wrote {}", self.output.display()));
        Ok(Exit::Done)
    }
}
