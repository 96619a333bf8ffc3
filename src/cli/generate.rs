//! `generate`: graphs to shader text.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use super::output;
use super::watch::watch;
use crate::compile::Options;
use crate::export::{Target, export};
use crate::reflect::reflect;
use crate::studio::load::Loader;
use crate::studio::settings::{Assignment, overrides};
use crate::studio::weave::{Input, Known, Shader, Weaver};

/// Weave graphs into a shader and print it
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  shadetree generate graphs/lights/spot_vsm.ron graphs/surfaces/bumpy_glass.ron
  shadetree generate spot.ron matte.ron -o matte.wgsl --reflect matte.json
  shadetree generate spot.ron matte.ron --target spirv -o matte.spv
  shadetree generate spot_pcf.ron matte.ron --option pcf.width=7 --set spot.range=20
  shadetree generate graphs/scenes/car.ron          # every surface with all lights")]
pub(super) struct Generate {
    /// Graph files, woven together by type; or one scene file; `-` is stdin
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Where to write; `-` is stdout
    #[arg(short, long, default_value = "-", value_name = "OUT")]
    output: PathBuf,
    /// Language; told by OUT's extension if not given
    #[arg(long, value_name = "LANGUAGE")]
    target: Option<Language>,
    /// Also write bindings, parameters and passes as JSON
    #[arg(long, value_name = "FILE")]
    reflect: Option<PathBuf>,
    /// Folder with further nodes; may be given several times
    #[arg(long, value_name = "DIR")]
    nodes: Vec<PathBuf>,
    /// Write parameters as constants
    #[arg(long)]
    bake: bool,
    /// Choose a structural option
    #[arg(long, value_name = "NODE.NAME=VALUE")]
    option: Vec<Assignment>,
    /// Make a node one of another kind, with its links
    #[arg(long, value_name = "NODE=KIND", value_parser = crate::studio::settings::kind)]
    kind: Vec<Assignment>,
    /// Give a port another value
    #[arg(long, value_name = "NODE.PORT=VALUE")]
    set: Vec<Assignment>,
    /// Run again whenever a file changes
    #[arg(long)]
    watch: bool,
}

/// A language, as clap lists it.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Language {
    Wgsl,
    Spirv,
    Msl,
    Hlsl,
    Glsl,
}

impl Language {
    fn target(self) -> Target {
        match self {
            Self::Wgsl => Target::Wgsl,
            Self::Spirv => Target::Spirv,
            Self::Msl => Target::Msl,
            Self::Hlsl => Target::Hlsl,
            Self::Glsl => Target::Glsl,
        }
    }
}

impl Generate {
    pub(super) fn run(&self, context: &Context) -> Outcome {
        let target = self.target()?;
        if output::is_dash(&self.output) {
            if self.reflect.as_deref().is_some_and(output::is_dash) {
                let message = "--reflect and the shader cannot both go to stdout";
                return Err(Failure::usage(message, "name a file with -o or with --reflect"));
            }
            if target.is_binary() {
                output::refuse_terminal("SPIR-V")?;
            }
        }
        watch(context, self.watch, &self.files, |loader| self.once(context, loader, target))
    }

    /// The language, and a contradiction between what is said and what the file is called.
    fn target(&self) -> Result<Target, Failure> {
        let extension = self.output.extension().map(|e| e.to_string_lossy().into_owned());
        let named = extension.as_deref().map(Target::of_extension);
        match (self.target.map(Language::target), named) {
            (None, None) => Ok(Target::Wgsl),
            (Some(target), None) => Ok(target),
            (given, Some(Some(named))) if given.is_none_or(|g| g == named) => Ok(named),
            (Some(given), _) => Err(Failure::usage(
                format!("--target {} does not fit the file name `{}`", given.name(), self.output.display()),
                format!("call it .{}, or leave --target out", given.extensions()[0]),
            )),
            (None, _) => Err(Failure::usage(
                format!("the extension of `{}` names no shading language", self.output.display()),
                "use .wgsl, .spv, .metal, .hlsl or .glsl, or say --target",
            )),
        }
    }

    fn once(&self, context: &Context, loader: &Loader, target: Target) -> Outcome {
        let (catalog, found) = loader.catalog(&self.nodes)?;
        context.report(&found);
        let options = Options { bake: self.bake, ..Options::default() };
        let set = overrides(&self.kind, &self.set, &self.option);
        let known = Known::default();
        let weaver = Weaver { options, set: &set, ..Weaver::new(context, loader, &catalog, &known) };
        let shaders = match weaver.read(&self.files)? {
            Input::Graphs(graphs) => vec![weaver.weave_graphs(graphs)?],
            Input::Scene(scene, file) => weaver.weave_scene(&scene, &file)?,
        };
        let mut parts = Vec::new();
        for shader in &shaders {
            let files = export(&shader.verified, &shader.compiled.module.wgsl, target);
            parts.push(files.map_err(|d| vec![*d])?);
        }
        let files: Vec<_> =
            shaders.iter().zip(&parts).flat_map(|(s, files)| files.iter().map(move |f| (s, f))).collect();
        let mut outputs: Vec<(PathBuf, Vec<u8>)> = Vec::new();
        if output::is_dash(&self.output) {
            if target.is_binary() && files.len() > 1 {
                return Err(Failure::usage("several binary modules cannot share stdout", "name a file with -o"));
            }
            let mut text = Vec::new();
            for (shader, file) in &files {
                if files.len() > 1 {
                    let objects = shader.objects.join(", ");
                    text.extend(format!("// ---- {objects} {}\n", file.extension).into_bytes());
                }
                text.extend(&file.bytes);
            }
            outputs.push((self.output.clone(), text));
        } else {
            let several = shaders.len() > 1;
            for (shader, file) in &files {
                let path = self.path(several.then(|| shader.objects.join("+")).as_deref(), file.extension);
                // Long lists of objects are cut, and may begin alike.
                let path = (1..).map(|n| numbered(&path, n)).find(|p| outputs.iter().all(|o| o.0 != *p));
                outputs.extend(path.map(|p| (p, file.bytes.clone())));
            }
        }
        if let Some(path) = &self.reflect {
            outputs.push((path.clone(), reflection(&shaders).into_bytes()));
        }
        // Everything is made before anything is written, so that a failure leaves the last good output.
        let all: Vec<(&Path, &[u8])> = outputs.iter().map(|(p, b)| (p.as_path(), b.as_slice())).collect();
        output::write_all(&all)?;
        for (path, _) in all.iter().filter(|(path, _)| !output::is_dash(path)) {
            context.detail(&format!("wrote {}", path.display()));
        }
        Ok(Exit::Done)
    }

    /// `OUT`, with the object and the stage before the extension where there are several.
    fn path(&self, objects: Option<&str>, extension: &str) -> PathBuf {
        let stage = extension.split_once('.').map(|(stage, _)| stage);
        if objects.is_none() && stage.is_none() {
            return self.output.clone();
        }
        let mut name = self.output.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        // Long lists of objects would make names that no file system takes.
        for part in objects.map(|o| o.chars().take(80).collect::<String>()).iter().map(String::as_str).chain(stage) {
            name = format!("{name}.{}", part.replace(['/', '\\'], "_"));
        }
        let own = self.output.extension().map_or_else(|| extension.to_owned(), |e| e.to_string_lossy().into_owned());
        self.output.parent().unwrap_or(Path::new("")).join(format!("{name}.{own}"))
    }
}

/// The path itself, or the `n`th with a number before its extension.
fn numbered(path: &Path, n: usize) -> PathBuf {
    if n == 1 {
        return path.to_path_buf();
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}.{n}.{extension}"))
}

/// One reflection, or for a scene a list with the objects of each.
fn reflection(shaders: &[Shader]) -> String {
    let one = |s: &Shader| reflect(&s.compiled, &s.verified);
    let json = match shaders {
        [single] if single.objects.is_empty() => one(single),
        all => {
            let list = all.iter().map(|s| serde_json::json!({ "objects": s.objects, "shader": one(s) }));
            serde_json::json!({ "schema": crate::reflect::SCHEMA, "shaders": list.collect::<Vec<_>>() })
        }
    };
    format!("{json:#}\n")
}
