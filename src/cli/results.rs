//! Reading of a folder of results.

use std::path::Path;
use std::sync::Arc;

use super::exit::{Exit, Failure};
use crate::diagnostic::{Diagnostic, Place, SourceText, has_errors};
use crate::studio::Loader;
use crate::study::Record;
use crate::study::folder::{RESULTS, STUDY, parse};

/// What a folder holds.
pub(super) struct Results {
    /// All cells, in the order of the file; of those that were measured twice, what was measured last. At least one.
    pub(super) records: Vec<Record>,
    /// The text of the study, where it is there.
    pub(super) study: Option<Arc<SourceText>>,
    /// What is not quite right, but hinders nothing.
    pub(super) warnings: Vec<Diagnostic>,
}

/// Reads a folder that `study` wrote.
pub(super) fn read(folder: &Path, loader: &Loader) -> Result<Results, Failure> {
    let name = folder.display().to_string();
    let fail = |exit, code, message: String, help: &str| {
        Failure::new(exit, Diagnostic::error(code, message, Place::file(&*name)).help(help))
    };
    let results = folder.join(RESULTS);
    match std::fs::metadata(folder) {
        Err(error) => {
            let help = "give the folder that `shadetree study FILE -o DIR` wrote";
            return Err(fail(Exit::Io, "ST0501", format!("cannot read {name}: {error}"), help));
        }
        Ok(meta) if !meta.is_dir() => {
            let help = "give the folder that the file lies in";
            return Err(fail(Exit::Input, "ST0660", format!("{name} is a file, not a folder of results"), help));
        }
        Ok(_) if !results.exists() => {
            let help = "run `shadetree study FILE -o DIR` first";
            return Err(fail(Exit::Input, "ST0660", format!("there is no {RESULTS} in {name}"), help));
        }
        Ok(_) => {}
    }
    let (records, found) = parse(&loader.text(&results)?);
    if has_errors(&found) {
        return Err(found.into());
    }
    if records.is_empty() {
        let help = "run `shadetree study` until at least one cell is done";
        return Err(fail(Exit::Input, "ST0660", format!("{} holds no cell", results.display()), help));
    }
    let study = folder.join(STUDY);
    let study = if study.exists() { Some(loader.text(&study)?) } else { None };
    Ok(Results { records, study, warnings: found })
}
