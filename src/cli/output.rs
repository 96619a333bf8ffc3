//! Where results go: whole files or none, or stdout.

use std::io::{ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

use super::exit::Failure;
use crate::diagnostic::{Diagnostic, Place};
pub(super) use crate::studio::load::is_dash;

/// The temporary files that are being written, to be removed on Ctrl-C.
static PENDING: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn pending() -> MutexGuard<'static, Vec<PathBuf>> {
    PENDING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes Ctrl-C (and being asked to end) leave no partial file behind. Exit code 130 is the custom for it.
pub(super) fn handle_interrupt() {
    // It can only fail if a handler is there already; then Ctrl-C ends the program as it does anyway.
    let _ = ctrlc::set_handler(|| {
        // The lock is kept to the end, so that nothing new is made.
        let mut pending = pending();
        for path in pending.drain(..) {
            let _ = std::fs::remove_file(path);
        }
        std::process::exit(130);
    });
}

/// Prints data. A reader that has gone away is not an error: `| head` is common.
pub(super) fn print(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::write(Path::new("-"), &error)),
        _ => Ok(()),
    }
}

/// Refuses to put binary data on a terminal.
pub(super) fn refuse_terminal(what: &str) -> Result<(), Failure> {
    if std::io::stdout().is_terminal() {
        let message = format!("{what} is binary and would garble the terminal");
        let place = Place::default();
        let diagnostic =
            Diagnostic::error("ST0506", message, place).help("name a file with -o, or redirect the output");
        return Err(Failure::new(super::Exit::Usage, diagnostic));
    }
    Ok(())
}

/// Writes a file whole or not at all: to a temporary name beside it, then renamed. `-` is stdout.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_all(&[(path, bytes)])
}

/// Writes files whole, and none of them if one cannot be written. `-` is stdout.
pub(super) fn write_all(files: &[(&Path, &[u8])]) -> Result<(), Failure> {
    let mut staged = Vec::new();
    let result = stage_all(files, &mut staged).and_then(|()| {
        staged.drain(..).try_for_each(|s: Staged<'_>| s.commit()).map_err(|(path, e)| Failure::write(path, &e))
    });
    // What is left is removed when it is dropped; what is renamed has another name now.
    drop(staged);
    pending().clear();
    result?;
    files.iter().filter(|(path, _)| is_dash(path)).try_for_each(|(_, bytes)| print(bytes))
}

fn stage_all<'a>(files: &[(&'a Path, &'a [u8])], staged: &mut Vec<Staged<'a>>) -> Result<(), Failure> {
    for (path, bytes) in files.iter().filter(|(path, _)| !is_dash(path)) {
        staged.push(Staged::new(path, bytes).map_err(|e| Failure::write(path, &e))?);
    }
    Ok(())
}

/// A file that is written but not in place yet.
enum Staged<'a> {
    /// A temporary file beside the target, and the name that was given.
    File { file: NamedTempFile, target: PathBuf, path: &'a Path },
    /// A device or pipe, which is written to, not replaced.
    Device(&'a Path, &'a [u8]),
}

impl<'a> Staged<'a> {
    fn new(path: &'a Path, bytes: &'a [u8]) -> std::io::Result<Self> {
        let old = std::fs::metadata(path).ok();
        if let Some(old) = &old {
            if old.is_dir() {
                return Err(std::io::Error::new(ErrorKind::IsADirectory, "it is a folder"));
            }
            if !old.is_file() {
                return Ok(Self::Device(path, bytes));
            }
            if old.permissions().readonly() {
                return Err(std::io::Error::new(ErrorKind::PermissionDenied, "it is read-only"));
            }
        }
        // A symbolic link stays; what it leads to is replaced.
        let target = if old.is_some() { std::fs::canonicalize(path)? } else { path.to_path_buf() };
        let folder = target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut file = {
            // Made and noted under one lock, so that Ctrl-C finds both or neither.
            let mut pending = pending();
            let file = tempfile::Builder::new().prefix(".shadetree-").suffix(".tmp").tempfile_in(folder)?;
            pending.push(file.path().to_path_buf());
            file
        };
        file.write_all(bytes)?;
        file.as_file().sync_all()?;
        set_permissions(file.as_file(), old.as_ref())?;
        Ok(Self::File { file, target, path })
    }

    fn commit(self) -> Result<(), (&'a Path, std::io::Error)> {
        match self {
            Self::File { file, target, path } => file.persist(target).map(drop).map_err(|e| (path, e.error)),
            Self::Device(path, bytes) => std::fs::write(path, bytes).map_err(|e| (path, e)),
        }
    }
}

/// As the file that is replaced, else as any new file: temporary files are private.
#[cfg(unix)]
fn set_permissions(file: &std::fs::File, old: Option<&std::fs::Metadata>) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    let permissions = old.map_or_else(|| std::fs::Permissions::from_mode(0o644), std::fs::Metadata::permissions);
    file.set_permissions(permissions)
}

#[cfg(not(unix))]
fn set_permissions(_: &std::fs::File, _: Option<&std::fs::Metadata>) -> std::io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_replaced_whole_and_folders_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.wgsl");
        write(&path, b"one").expect("written");
        write(&path, b"two").expect("replaced");
        assert_eq!(std::fs::read(&path).expect("there"), b"two");
        assert_eq!(std::fs::read_dir(folder.path()).expect("readable").count(), 1, "nothing else is left");
        let failure = write(folder.path(), b"x").expect_err("a folder");
        assert_eq!((failure.exit, failure.diagnostics[0].code), (super::super::Exit::Io, "ST0505"));
        assert!(write(&folder.path().join("no/such/b"), b"x").is_err());
    }

    #[test]
    fn several_files_are_written_all_or_none() {
        let folder = tempfile::tempdir().expect("a folder");
        let (good, bad) = (folder.path().join("a"), folder.path().join("no/such/b"));
        assert!(write_all(&[(&good, b"x"), (&bad, b"y")]).is_err());
        assert_eq!(std::fs::read_dir(folder.path()).expect("readable").count(), 0, "nothing is left");
    }
}
