//! Files that are written whole or not at all: to a temporary name beside them, then renamed.

use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

/// A file that could not be written. What was there before still is.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {error}", path.display())]
pub struct Unwritten {
    /// Its path.
    pub path: PathBuf,
    /// Why.
    pub error: std::io::Error,
}

/// The temporary files that are being written.
static PENDING: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn pending() -> MutexGuard<'static, Vec<PathBuf>> {
    PENDING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the temporary files that are being written, and runs `then` while none can be made.
pub fn abandon_all(then: impl FnOnce()) {
    let mut pending = pending();
    for path in pending.drain(..) {
        let _ = std::fs::remove_file(path);
    }
    then();
}

/// Writes a file whole.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Unwritten> {
    write_all(&[(path, bytes)])
}

/// Writes files whole, and none of them if one cannot be written.
pub fn write_all(files: &[(&Path, &[u8])]) -> Result<(), Unwritten> {
    let mut staged = Vec::new();
    let result = stage_all(files, &mut staged).and_then(|()| {
        let failed = |(path, error): (&Path, std::io::Error)| Unwritten { path: path.to_path_buf(), error };
        staged.drain(..).try_for_each(|s: Staged<'_>| s.commit().map_err(failed))
    });
    // What is renamed has another name now, and what is left is removed when it is dropped.
    let own: Vec<PathBuf> = staged.iter().filter_map(Staged::temporary).collect();
    drop(staged);
    pending().retain(|path| !own.contains(path) && path.exists());
    result
}

fn stage_all<'a>(files: &[(&'a Path, &'a [u8])], staged: &mut Vec<Staged<'a>>) -> Result<(), Unwritten> {
    for (path, bytes) in files {
        staged.push(Staged::new(path, bytes).map_err(|error| Unwritten { path: path.to_path_buf(), error })?);
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

    fn temporary(&self) -> Option<PathBuf> {
        match self {
            Self::File { file, .. } => Some(file.path().to_path_buf()),
            Self::Device(..) => None,
        }
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
