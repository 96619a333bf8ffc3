//! `--watch`: run, wait for a change, run again.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::Duration;

use notify_debouncer_mini::notify::RecursiveMode;
use notify_debouncer_mini::{DebounceEventResult, new_debouncer};

use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use super::load::Loader;
use super::output::is_dash;
use crate::diagnostic::{Diagnostic, Place};

/// Editors write a file in several steps; this is how long they get.
const SETTLE: Duration = Duration::from_millis(100);

/// Runs `work` once; with `again`, whenever a file that it read changes, until Ctrl-C. Mistakes are shown and waited
/// out; output is only ever replaced by good output.
pub(super) fn watch(context: &Context, again: bool, files: &[PathBuf], work: impl Fn(&Loader) -> Outcome) -> Outcome {
    if !again {
        return work(&Loader::default());
    }
    if files.iter().any(|f| is_dash(f)) {
        return Err(Failure::usage("--watch cannot watch stdin", "name files"));
    }
    let trouble = |e: &dyn std::fmt::Display| {
        let diagnostic = Diagnostic::error("ST0519", format!("cannot watch for changes: {e}"), Place::default());
        Failure::new(Exit::Io, diagnostic.help("run again without --watch"))
    };
    let (send, changes) = mpsc::channel();
    let mut debouncer = new_debouncer(SETTLE, move |event: DebounceEventResult| {
        let _ = send.send(event);
    })
    .map_err(|e| trouble(&e))?;
    let mut folders = BTreeSet::new();
    loop {
        let loader = Loader::default();
        match work(&loader) {
            Ok(_) => context.say("done; waiting for changes"),
            Err(failure) => {
                context.report(&failure.diagnostics);
                context.say("waiting for changes");
            }
        }
        let touched: BTreeSet<PathBuf> = loader.touched().into_iter().map(|p| absolute(&p)).collect();
        // Folders, not files: saving by renaming replaces the file that would be watched.
        for folder in touched.iter().filter_map(|p| if p.is_dir() { Some(p.as_path()) } else { p.parent() }) {
            if folder.is_dir() && folders.insert(folder.to_path_buf()) {
                debouncer.watcher().watch(folder, RecursiveMode::NonRecursive).map_err(|e| trouble(&e))?;
            }
        }
        loop {
            let events = changes.recv().map_err(|e| trouble(&e))?.map_err(|e| trouble(&e))?;
            if events.iter().any(|e| concerns(&touched, &absolute(&e.path))) {
                break;
            }
        }
    }
}

/// Whether a changed path was read, or is a node file in a watched node folder.
fn concerns(touched: &BTreeSet<PathBuf>, path: &Path) -> bool {
    touched.contains(path)
        || (path.extension().is_some_and(|e| e == "wgsl") && path.parent().is_some_and(|p| touched.contains(p)))
}

/// One spelling for a path, also for a file that is not there (yet).
fn absolute(path: &Path) -> PathBuf {
    if let Ok(full) = std::fs::canonicalize(path) {
        return full;
    }
    let full = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    match (full.parent().and_then(|p| std::fs::canonicalize(p).ok()), full.file_name()) {
        (Some(parent), Some(name)) => parent.join(name),
        _ => full,
    }
}
