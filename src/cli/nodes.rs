//! `nodes`: the catalogue.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;

use super::context::{Context, Format};
use super::exit::Outcome;
use super::{Exit, output};
use crate::diagnostic::{Diagnostic, Place};
use crate::node::{self, Choices};
use crate::studio::load::Loader;

/// List the nodes, or describe one port by port
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  shadetree nodes
  shadetree nodes oren_nayar
  shadetree nodes --format md > NODES.md
  shadetree nodes glass --format json
  shadetree nodes --nodes my_nodes")]
pub(super) struct Nodes {
    /// Kind, label or other name of a node
    name: Option<String>,
    /// Folder with further nodes; may be given several times
    #[arg(long, value_name = "DIR")]
    nodes: Vec<PathBuf>,
}

impl Nodes {
    pub(super) fn run(&self, context: &Context) -> Outcome {
        let loader = Loader::default();
        let (catalog, found) = loader.catalog(&self.nodes)?;
        context.report(&found);
        let Some(name) = &self.name else {
            let mut definitions = Vec::new();
            for file in catalog.files() {
                definitions.push(file.definition(&Choices::new())?);
            }
            let text = match context.format {
                Format::Json => {
                    let list: Vec<_> = definitions.iter().map(|d| node::json(d)).collect();
                    format!("{:#}\n", serde_json::json!({ "schema": 1, "nodes": list }))
                }
                Format::Md => {
                    let parts: Vec<String> = definitions.iter().map(|d| node::markdown(d)).collect();
                    format!("# Nodes\n\n{}", parts.join("\n"))
                }
                Format::Text => {
                    let mut text = String::new();
                    let mut sorted: Vec<_> = definitions.iter().collect();
                    sorted.sort_by_key(|d| (&d.header.category, &d.kind));
                    let mut category = "";
                    for d in sorted {
                        if category != d.header.category {
                            category = &d.header.category;
                            let _ = writeln!(text, "{category}");
                        }
                        let summary = d.header.description.split_inclusive(". ").next().unwrap_or_default();
                        let _ = writeln!(text, "  {:<24} {}", d.kind, summary.trim_end());
                    }
                    text
                }
            };
            output::print(text.as_bytes())?;
            return Ok(Exit::Done);
        };
        let kind = if catalog.get(name).is_some() { Some(name.clone()) } else { catalog.nearest(name) };
        let exact = kind.as_ref().and_then(|k| Some((k, catalog.get(k)?))).filter(|(k, file)| {
            let named = |other: &str| other.eq_ignore_ascii_case(name);
            *k == name || file.header().is_ok_and(|h| named(&h.label) || h.synonyms.iter().any(|s| named(s)))
        });
        let Some((_, file)) = exact else {
            let help = match kind {
                Some(kind) => format!("did you mean `{kind}`?"),
                None => "`shadetree nodes` lists all of them".into(),
            };
            let message = format!("there is no node called `{name}`");
            return Err(vec![Diagnostic::error("ST0516", message, Place::default()).help(help)].into());
        };
        let definition = file.definition(&Choices::new())?;
        let text = match context.format {
            Format::Json => format!("{:#}\n", node::json(&definition)),
            Format::Md => node::markdown(&definition),
            Format::Text => node::text(&definition),
        };
        output::print(text.as_bytes())?;
        Ok(Exit::Done)
    }
}
