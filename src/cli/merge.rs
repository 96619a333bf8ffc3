//! `study merge`: results of several folders in one.

use std::collections::BTreeSet;

use serde_json::json;

use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use super::folder::Folder;
use super::output;
use super::results::read;
use super::study::Merge;
use crate::diagnostic::{Diagnostic, Place};
use crate::studio::Loader;
use crate::study::{Machine, Record};

pub(super) fn run(command: &Merge, context: &Context) -> Outcome {
    let mut study: Option<(String, String)> = None;
    let mut parts = Vec::new();
    for folder in &command.folders {
        let path = folder.join("study.ron");
        let text = std::fs::read_to_string(&path).map_err(|e| {
            let message = format!("cannot read {}: {e}", path.display());
            let diagnostic = Diagnostic::error("ST0501", message, Place::file(path.display().to_string()));
            Failure::new(Exit::Io, diagnostic.help("name folders that `shadetree study` wrote"))
        })?;
        match &study {
            Some((known, first)) if *known != text => {
                let message = format!("{} and {first} hold results of different studies", folder.display());
                let place = Place::file(path.display().to_string());
                return Err(vec![Diagnostic::error("ST0621", message, place).help("merge folders of one study")].into());
            }
            Some(_) => {}
            None => study = Some((text, folder.display().to_string())),
        }
        parts.push((folder, read(folder, &Loader::default())?.records));
    }
    let machines: BTreeSet<&Machine> = parts.iter().flat_map(|(_, r)| r).map(|r| &r.machine).collect();
    if machines.len() > 1 && !command.mixed {
        let names: Vec<String> = machines.iter().map(|m| format!("{} ({})", m.adapter, m.driver)).collect();
        let message = format!("the results are of different adapters: {}", names.join("; "));
        let place = Place::file(command.output.display().to_string());
        let help = "merge those of one adapter, or add --mixed";
        return Err(vec![Diagnostic::error("ST0623", message, place).help(help)].into());
    }
    let mut whole = Folder::open(&command.output, &study.unwrap_or_default().0)?;
    let mut merged = 0;
    for (folder, records) in parts {
        // Where several have one cell, the first is kept.
        let new: Vec<Record> = records.into_iter().filter(|r| !whole.records.contains_key(&r.cell)).collect();
        let mut pictures = Vec::new();
        for stem in new.iter().filter_map(|r| r.pictures.as_ref()) {
            pictures.extend([format!("{stem}.visibility.png"), format!("{stem}.error.png")]);
        }
        for record in &new {
            let stem = record.truth_pictures.iter();
            pictures
                .extend(stem.flat_map(|s| record.errors.keys().map(move |reference| format!("{s}.{reference}.png"))));
        }
        pictures.sort();
        pictures.dedup();
        let found = pictures.into_iter().filter(|name| is_below(name));
        let found: Vec<_> =
            found.filter_map(|name| Some((name.clone(), std::fs::read(folder.join(&name)).ok()?))).collect();
        merged += new.len();
        whole.add(new, &found)?;
    }
    let cells = whole.records.len();
    let text = if context.is_json() {
        format!("{}\n", json!({"folder": command.output.display().to_string(), "cells": cells, "added": merged}))
    } else {
        format!("{merged} cells added; {} holds {cells}\n", command.output.display())
    };
    output::print(text.as_bytes())?;
    Ok(Exit::Done)
}

/// Whether a name leads to a picture of the folder: results may come from anywhere.
fn is_below(name: &str) -> bool {
    name.strip_prefix("pictures/").is_some_and(|rest| !rest.contains(['/', '\\']) && rest != "..")
}
