//! `--watch`: run, wait for a change, run again.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

use notify::event::{AccessKind, AccessMode};
use notify::{Event, EventKind, RecursiveMode, Watcher};

use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use crate::diagnostic::{Diagnostic, Place};
use crate::studio::load::{Loader, Stamp, absolute, is_dash};

/// Editors write a file in several steps; a change counts once nothing more came for so long.
const SETTLE: Duration = Duration::from_millis(100);

/// Runs `work` once; with `again`, whenever a file that it read changes, until Ctrl-C. Mistakes are shown and waited
/// out; output is only ever replaced by good output.
pub(super) fn watch(context: &Context, again: bool, files: &[PathBuf], work: impl Fn(&Loader) -> Outcome) -> Outcome {
    if files.iter().filter(|f| is_dash(f)).count() > 1 {
        return Err(Failure::usage("stdin is given more than once, but can be read only once", "name files"));
    }
    if !again {
        let loader = Loader::default();
        return graded(work(&loader), &loader);
    }
    if files.iter().any(|f| is_dash(f)) {
        return Err(Failure::usage("--watch cannot watch stdin", "name files"));
    }
    let (send, changes) = mpsc::channel();
    let mut watcher = notify::recommended_watcher(send).map_err(|e| trouble(&e))?;
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
        let touched: BTreeMap<PathBuf, Option<Stamp>> =
            loader.touched().into_iter().map(|(path, stamp)| (absolute(&path), stamp)).collect();
        // Folders, not files: saving by renaming replaces the file that would be watched.
        for path in touched.keys() {
            // What is in a folder that does not exist yet appears when that folder does.
            let Some(folder) = path.ancestors().skip(usize::from(!path.is_dir())).find(|p| p.is_dir()) else {
                continue;
            };
            if folders.insert(folder.to_path_buf())
                && let Err(error) = watcher.watch(folder, RecursiveMode::NonRecursive)
            {
                folders.remove(folder);
                return Err(trouble(&error));
            }
        }
        // What changed after it was read and before it was watched would otherwise be missed.
        if touched.iter().any(|(path, stamp)| Stamp::of(path) != *stamp) {
            std::thread::sleep(SETTLE);
            continue;
        }
        wait(&changes, &touched, &mut folders)?;
    }
}

/// A file that cannot be read is graver than a mistake in one that can.
fn graded(outcome: Outcome, loader: &Loader) -> Outcome {
    outcome.map_err(|failure| match failure.exit {
        Exit::Input if loader.is_unreadable() => Failure { exit: Exit::Io, ..failure },
        _ => failure,
    })
}

fn trouble(error: &dyn std::fmt::Display) -> Failure {
    let diagnostic = Diagnostic::error("ST0519", format!("cannot watch for changes: {error}"), Place::default());
    Failure::new(Exit::Io, diagnostic.help("run again without --watch"))
}

/// Returns when something that was read has changed and changes no more.
fn wait(
    changes: &Receiver<notify::Result<Event>>,
    touched: &BTreeMap<PathBuf, Option<Stamp>>,
    folders: &mut BTreeSet<PathBuf>,
) -> Result<(), Failure> {
    let mut changed = false;
    loop {
        let next = match changed {
            false => changes.recv().map_err(|_| RecvTimeoutError::Disconnected),
            true => changes.recv_timeout(SETTLE),
        };
        let event = match next {
            Ok(event) => event.map_err(|e| trouble(&e))?,
            Err(RecvTimeoutError::Timeout) => return Ok(()),
            Err(RecvTimeoutError::Disconnected) => return Err(trouble(&"the system tells of no more changes")),
        };
        // Reading is no change; the program's own reading would keep it going for ever.
        if matches!(event.kind, EventKind::Access(kind) if kind != AccessKind::Close(AccessMode::Write)) {
            continue;
        }
        for path in event.paths.iter().map(|p| absolute(p)) {
            // A folder that is gone or moved is no longer watched, and must be anew when it is back.
            if matches!(event.kind, EventKind::Remove(_) | EventKind::Modify(notify::event::ModifyKind::Name(_))) {
                folders.remove(&path);
            }
            changed |= concerns(touched, &path);
        }
        changed |= event.need_rescan();
    }
}

/// Whether a changed path was read, leads to one that was to be read, or is a node file in a watched node folder.
fn concerns(touched: &BTreeMap<PathBuf, Option<Stamp>>, path: &Path) -> bool {
    let below = touched.range(path.to_path_buf()..).next().is_some_and(|(t, _)| t.starts_with(path));
    below || (path.extension().is_some_and(|e| e == "wgsl") && path.parent().is_some_and(|p| touched.contains_key(p)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stamp_tells_that_a_file_has_changed_since_it_was_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.ron");
        let loader = Loader::default();
        assert!(loader.bytes(&path).is_err());
        assert_eq!(loader.touched()[&path], Stamp::of(&path));
        std::fs::write(&path, "one").expect("written");
        assert_ne!(loader.touched()[&path], Stamp::of(&path), "it has appeared");
        loader.bytes(&path).expect("read");
        assert_eq!(loader.touched()[&path], Stamp::of(&path));
        std::fs::write(&path, "three").expect("written");
        assert_ne!(loader.touched()[&path], Stamp::of(&path), "it has changed");
    }

    #[test]
    fn what_leads_to_a_file_concerns_it_and_its_neighbours_do_not() {
        let touched = ["/a/b/c.ron", "/n"].map(|p| (PathBuf::from(p), None)).into_iter().collect();
        let concerns = |path: &str| concerns(&touched, Path::new(path));
        assert!(concerns("/a/b/c.ron") && concerns("/a/b") && concerns("/n/x.wgsl"));
        assert!(!concerns("/a/b/d.ron") && !concerns("/a/b/x.wgsl") && !concerns("/n/x.txt") && !concerns("/a/bc"));
    }
}
