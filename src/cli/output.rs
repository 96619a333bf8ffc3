//! Where results go: whole files or none, or stdout.

use std::io::{ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::exit::Failure;
use crate::diagnostic::{Diagnostic, Place};

/// The temporary file that is being written, to be removed on Ctrl-C.
static PENDING: Mutex<Option<PathBuf>> = Mutex::new(None);

fn set_pending(path: Option<PathBuf>) {
    *PENDING.lock().unwrap_or_else(PoisonError::into_inner) = path;
}

/// Makes Ctrl-C leave no partial file behind. Exit code 130 is the custom for it.
pub(super) fn handle_interrupt() {
    // It can only fail if a handler is there already; then Ctrl-C ends the program as it does anyway.
    let _ = ctrlc::set_handler(|| {
        if let Some(path) = PENDING.lock().unwrap_or_else(PoisonError::into_inner).take() {
            let _ = std::fs::remove_file(path);
        }
        std::process::exit(130);
    });
}

/// Whether the path stands for stdin or stdout.
pub(super) fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
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
    if is_dash(path) {
        return print(bytes);
    }
    write_file(path, bytes).map_err(|error| Failure::write(path, &error))
}

fn write_file(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let old = std::fs::metadata(path).ok();
    if let Some(old) = &old {
        if old.is_dir() {
            return Err(std::io::Error::new(ErrorKind::IsADirectory, "it is a folder"));
        }
        if !old.is_file() {
            // A device or pipe is written to, not replaced.
            return std::fs::write(path, bytes);
        }
        if old.permissions().readonly() {
            return Err(std::io::Error::new(ErrorKind::PermissionDenied, "it is read-only"));
        }
    }
    // A symbolic link stays; what it leads to is replaced.
    let target = if old.is_some() { std::fs::canonicalize(path)? } else { path.to_path_buf() };
    let folder = target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = tempfile::Builder::new().prefix(".shadetree-").suffix(".tmp").tempfile_in(folder)?;
    set_pending(Some(file.path().to_path_buf()));
    let written = file.write_all(bytes).and_then(|()| file.as_file().sync_all());
    let result = written.and_then(|()| {
        set_permissions(file.as_file(), old.as_ref())?;
        file.persist(&target).map(drop).map_err(|e| e.error)
    });
    set_pending(None);
    result
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
}
