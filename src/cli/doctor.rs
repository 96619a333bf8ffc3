//! `doctor`: what this machine can do.

use std::path::PathBuf;

use clap::Args;
use serde_json::{Value as Json, json};

use super::context::Context;
use super::exit::Outcome;
use super::{Exit, output};
use crate::studio::load::Loader;

/// Show what this machine and this build can do
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  shadetree doctor
  shadetree doctor --format json
  shadetree doctor --nodes my_nodes     # also reads a folder of nodes")]
pub(super) struct Doctor {
    /// Folder with further nodes; may be given several times
    #[arg(long, value_name = "DIR")]
    nodes: Vec<PathBuf>,
}

impl Doctor {
    pub(super) fn run(&self, context: &Context) -> Outcome {
        let loader = Loader::default();
        let (catalog, found) = loader.catalog(&self.nodes)?;
        let broken = context.report(&found);
        let (adapters, trouble) = adapters();
        let folders: Vec<String> = self.nodes.iter().map(|n| n.display().to_string()).collect();
        if context.is_json() {
            let all = json!({
                "schema": 1,
                "version": env!("CARGO_PKG_VERSION"),
                "render": cfg!(feature = "render"),
                "adapters": adapters,
                "trouble": trouble,
                "nodes": catalog.kinds().count(),
                "node_folders": folders,
                "cache": Json::Null,
            });
            output::print(format!("{all:#}\n").as_bytes())?;
        } else {
            let mut text = format!("shadetree {}\n", env!("CARGO_PKG_VERSION"));
            text += &format!("nodes: {} kinds", catalog.kinds().count());
            text += &if folders.is_empty() {
                ", all built in\n".to_owned()
            } else {
                format!(", with {}\n", folders.join(", "))
            };
            text += "cache: none is kept\n";
            text += &format!(
                "rendering: {}\n",
                if cfg!(feature = "render") { "built in" } else { "not built in (feature `render`)" }
            );
            for adapter in &adapters {
                text += &line(adapter);
            }
            if let Some(trouble) = trouble {
                text += &format!("no adapter: {trouble}\n");
            }
            output::print(text.as_bytes())?;
        }
        Ok(if broken { Exit::Input } else { Exit::Done })
    }
}

fn line(adapter: &Json) -> String {
    let word = |key: &str| adapter[key].as_str().unwrap_or_default().to_owned();
    let list = |key: &str| {
        let items = adapter[key].as_array().into_iter().flatten();
        items.filter_map(Json::as_str).collect::<Vec<_>>().join(", ")
    };
    format!(
        "adapter: {} ({}, {}, {})\n  features: {}\n  formats: {}\n",
        word("name"),
        word("backend"),
        word("kind"),
        word("driver"),
        list("features"),
        list("formats"),
    )
}

#[cfg(feature = "render")]
fn adapters() -> (Vec<Json>, Option<String>) {
    match crate::render::adapters(&super::render::adapter_options(None)) {
        Ok(list) if !list.is_empty() => {
            let one = |a: &crate::render::AdapterSummary| {
                let formats: Vec<&str> = a.formats.iter().map(|(name, _)| name.as_str()).collect();
                json!({
                    "name": a.name,
                    "backend": a.backend,
                    "driver": a.driver,
                    "kind": a.kind,
                    "features": a.features,
                    "formats": formats,
                })
            };
            (list.iter().map(one).collect(), None)
        }
        Ok(_) => {
            let none = crate::render::RenderError::NoAdapter { wanted: None, found: Vec::new() };
            (Vec::new(), none.help())
        }
        Err(error) => (Vec::new(), Some(error.to_string())),
    }
}

#[cfg(not(feature = "render"))]
fn adapters() -> (Vec<Json>, Option<String>) {
    (Vec::new(), None)
}
