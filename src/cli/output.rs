//! Where results go: whole files or none, or stdout.

use std::io::{ErrorKind, IsTerminal, Write};
use std::path::Path;

use super::exit::Failure;
use crate::diagnostic::{Diagnostic, Place};
pub(super) use crate::studio::load::is_dash;
use crate::studio::write as whole;

/// Makes Ctrl-C (and being asked to end) leave no partial file behind. Exit code 130 is the custom for it.
pub(super) fn handle_interrupt() {
    // It can only fail if a handler is there already; then Ctrl-C ends the program as it does anyway.
    let _ = ctrlc::set_handler(|| whole::abandon_all(|| std::process::exit(130)));
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
    let real: Vec<(&Path, &[u8])> = files.iter().copied().filter(|(path, _)| !is_dash(path)).collect();
    whole::write_all(&real).map_err(|e| Failure::write(&e.path, &e.error))?;
    files.iter().filter(|(path, _)| is_dash(path)).try_for_each(|(_, bytes)| print(bytes))
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
